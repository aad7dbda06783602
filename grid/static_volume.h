// Volume files of static worlds (`.vdb`, format `gridcull.static/1`): what `gridcull bake static` writes and a scene's
// `static_volume` names. Other programs see three grids whose voxels are the cells: `opaque` and `touched` (bool), and
// `object` (int32: the number of the list of objects that share the cell, shared_cells.h). Lists, objects and what the
// file is good for are its metadata.
//
// Only openvdb_*.cpp see OpenVDB's headers. Without OpenVDB each function throws Error(usage).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gridcull/grid/static_cells.h"
#include "gridcull/grid/static_tiles.h"

namespace gridcull {

/// Written beside, held against a cut, sealed (file_seal.h), then renamed. Tiles of 2^tile_shift cells an edge, 3 ..
/// 20, may be read apart. Throws Error(io), and Error(limit) for what needs more than `max_memory` bytes, or more than
/// 2^31 cells along an axis.
void write_static_volume(const std::string& path, const StaticCells& cells, std::uint64_t max_memory,
                         int tile_shift = TileLayout::default_shift);

/// The lattice and the world that a file is for, without objects and bricks. Throws Error(io) for a file that cannot be
/// read, and Error(bad_scene) for one that is no volume file, cut short, or of another format or version.
StaticCells read_static_volume_head(const std::string& path);

/// All of it. Throws besides Error(limit) for more than `max_memory` bytes of bricks, and Error(bad_scene) for a file
/// that was altered.
StaticCells read_static_volume(const std::string& path, std::uint64_t max_memory);

/// The same, of which cells are read tile by tile; the file must stay as it is. Throws what read_static_volume_head()
/// throws; what was altered is found when its tile is read.
std::unique_ptr<TiledCells> open_static_volume_tiles(const std::string& path);

}  // namespace gridcull
