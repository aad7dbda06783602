// Static cells in tiles, square columns of the lattice, for worlds whose cells are not all to be in memory at once:
// what is where is known beforehand, the cells are read a tile at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/grid/static_cells.h"

namespace gridcull {

/// Where the tiles lie: edge x edge cells each, over the lattice's whole height; x fastest.
class TileLayout {
 public:
  static constexpr int default_shift = 8;

  TileLayout() = default;
  /// Tiles of 2^shift cells an edge, shift 3 .. 20: whole bricks.
  TileLayout(const Cell& cells, int shift);

  int shift() const { return shift_; }
  std::size_t count() const { return static_cast<std::size_t>(along_x_ * along_y_); }
  std::size_t tile_of(const Cell& cell) const {
    return static_cast<std::size_t>((cell.y >> shift_) * along_x_ + (cell.x >> shift_));
  }
  /// Lowest cell, and the one behind the highest.
  Cell low(std::size_t tile) const;
  Cell high(std::size_t tile) const;

 private:
  Cell cells_{};
  int shift_ = default_shift;
  std::int64_t along_x_ = 0, along_y_ = 0;
};

/// What a tile holds.
struct StaticTile {
  std::vector<std::uint32_t> members;  ///< who touches a cell of it, ascending: indices into StaticCells::members
  std::uint64_t covers = 0;            ///< bricks of all of them
  std::uint64_t blocks = 0;  ///< of 8 x 8 x 8 bricks, in which somebody touches one: leaves of OpenVDB's trees
  std::uint64_t hash = 0;    ///< tile_hash() of them
};

/// Of all tiles, in the order of the layout.
std::vector<StaticTile> make_tiles(const StaticCells& cells, const TileLayout& layout);

/// The same in whatever order they come.
std::uint64_t tile_hash(std::span<const MemberBrick> covers);

/// A line for each tile that holds something: its number, covers, blocks, hash in hexadecimal digits, ids.
std::string tiles_text(std::span<const StaticTile> tiles, const StaticCells& cells);
/// Throws Error(bad_scene) for what tiles_text() would not write.
std::vector<StaticTile> parse_tiles(std::string_view text, const StaticCells& cells, const TileLayout& layout);

/// A static world whose cells are read tile by tile.
class TiledCells {
 public:
  virtual ~TiledCells() = default;
  /// Lattice and members, without bricks.
  virtual const StaticCells& head() const = 0;
  virtual const TileLayout& layout() const = 0;
  virtual std::span<const StaticTile> tiles() const = 0;
  /// The tile's cells, by member and brick, ascending. Throws Error(bad_scene) where they are not what tiles() says.
  virtual void read(std::size_t tile, std::vector<MemberBrick>& out) = 0;
  /// Bytes held while no tile is being read.
  virtual std::uint64_t bytes() const = 0;
};

/// Tiles of cells that are in memory.
std::unique_ptr<TiledCells> tiled(StaticCells cells, int shift);

}  // namespace gridcull
