// Occluders behind which `voxel` hides nothing: those that hold no whole cell of a lattice.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

struct CellLess {
  std::uint64_t occluders = 0;  ///< that have an interior
  /// Those that have none (is_thin()) and hold no cell of any size; ids ascend.
  std::vector<ObjectId> thin{};
  /// By lattice: those with an interior and without a whole cell where they stand, ascending. What lies outside the
  /// lattice is among them.
  std::vector<std::vector<ObjectId>> without{};
};

/// Discretises as the engine does (grid/cover.h), on all cores. Throws Stopped on Ctrl-C.
CellLess find_cell_less(std::span<const Lattice> lattices, std::span<const Object> objects);

/// "3, 7 (b-17), ...": the first `most`, with the names that the scene gives them.
std::string ids_text(std::span<const ObjectId> ids, const Scene& scene, std::size_t most);

}  // namespace gridcull
