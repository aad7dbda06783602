#include "gridcull/grid/static_tiles.h"

#include <algorithm>
#include <utility>

#include "gridcull/core/hash.h"

namespace gridcull {
namespace {

std::int64_t tiles_along(std::int64_t cells, int shift) { return (cells + (std::int64_t{1} << shift) - 1) >> shift; }

std::uint64_t cover_hash(const MemberBrick& at) {
  StableHash hash;
  for (const std::uint64_t word :
       {std::uint64_t{at.member} << 32 | at.cover.brick, at.cover.touched, at.cover.opaque}) {
    hash.add64(word);
  }
  return hash.value();
}

/// The first brick of the 8 x 8 x 8 that the brick is in.
std::size_t block_of(const Lattice& lattice, std::size_t brick) {
  const Cell corner = lattice.brick_corner(brick);
  const int shift = lattice.brick_shift();
  const auto first = [&](std::int64_t cell) { return cell >> (shift + 3) << 3; };
  return lattice.brick_index({first(corner.x), first(corner.y), lattice.dimension() == 2 ? 0 : first(corner.z)});
}

class CellsInMemory final : public TiledCells {
 public:
  CellsInMemory(StaticCells cells, int shift)
      : cells_(std::move(cells)),
        lattice_(lattice_of(cells_, 0, Room::where_needed)),
        layout_(cells_.cells, shift),
        tiles_(make_tiles(cells_, layout_)) {}

  const StaticCells& head() const override { return cells_; }
  const TileLayout& layout() const override { return layout_; }
  std::span<const StaticTile> tiles() const override { return tiles_; }
  void read(std::size_t tile, std::vector<MemberBrick>& out) override {
    out.clear();
    for (const std::uint32_t member : tiles_[tile].members) {
      for (const BrickCover& cover : cells_.of(cells_.members[member])) {
        if (layout_.tile_of(lattice_.brick_corner(cover.brick)) == tile) out.push_back({member, cover});
      }
    }
  }
  std::uint64_t bytes() const override { return cells_.bytes(); }

 private:
  StaticCells cells_;
  Lattice lattice_;
  TileLayout layout_;
  std::vector<StaticTile> tiles_;
};

}  // namespace

TileLayout::TileLayout(const Cell& cells, int shift)
    : cells_(cells), shift_(shift), along_x_(tiles_along(cells.x, shift)), along_y_(tiles_along(cells.y, shift)) {}

Cell TileLayout::low(std::size_t tile) const {
  const auto at = static_cast<std::int64_t>(tile);
  return {(at % along_x_) << shift_, (at / along_x_) << shift_, 0};
}

Cell TileLayout::high(std::size_t tile) const {
  const Cell from = low(tile);
  const std::int64_t edge = std::int64_t{1} << shift_;
  return {std::min(from.x + edge, cells_.x), std::min(from.y + edge, cells_.y), cells_.z};
}

std::vector<StaticTile> make_tiles(const StaticCells& cells, const TileLayout& layout) {
  const Lattice lattice = lattice_of(cells, 0, Room::where_needed);
  std::vector<StaticTile> tiles(layout.count());
  std::vector<std::pair<std::size_t, std::size_t>> blocks;  // tile, and the block's first brick
  for (std::uint32_t m = 0; m < cells.members.size(); ++m) {
    for (const BrickCover& cover : cells.of(cells.members[m])) {
      StaticTile& tile = tiles[layout.tile_of(lattice.brick_corner(cover.brick))];
      if (tile.members.empty() || tile.members.back() != m) tile.members.push_back(m);
      ++tile.covers;
      tile.hash += cover_hash({m, cover});
      blocks.push_back({layout.tile_of(lattice.brick_corner(cover.brick)), block_of(lattice, cover.brick)});
    }
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  for (const auto& [tile, block] : blocks) ++tiles[tile].blocks;
  return tiles;
}

std::uint64_t tile_hash(std::span<const MemberBrick> covers) {
  std::uint64_t hash = 0;
  for (const MemberBrick& cover : covers) hash += cover_hash(cover);
  return hash;
}

std::unique_ptr<TiledCells> tiled(StaticCells cells, int shift) {
  return std::make_unique<CellsInMemory>(std::move(cells), shift);
}

}  // namespace gridcull
