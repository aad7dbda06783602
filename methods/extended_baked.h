// Potentially visible sets of viewing cells, as a file keeps them (paper section 6.1: adaptive cells, delta-PVS).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gridcull/core/ids.h"
#include "gridcull/methods/extended_cell.h"
#include "gridcull/methods/extended_regions.h"

namespace gridcull {
class ByteReader;
class ByteWriter;
}  // namespace gridcull

namespace gridcull::extended {

/// Cubes side by side, each halved in all three axes up to `levels` times; turned about the vertical, so that they lie
/// along the streets. Corners are whole steps of the smallest cell's edge from the origin, so that neighbours share
/// them.
struct CellLattice {
  Vec3 origin{0.0};
  double heading = 0.0;  ///< radians
  double step = 1.0;     ///< edge of a smallest cell, metres
  std::uint32_t levels = 0;
  std::array<std::uint32_t, 3> count{};  ///< of largest cells

  Rotation axes() const { return rotation_of(turn_about_z(heading)); }
  std::uint32_t roots() const { return count[0] * count[1] * count[2]; }
  /// The cell of `level` (0: largest) whose lower corner is `at` smallest cells from the origin; grown by the roundings
  /// of its corners.
  ViewCell cell(const std::array<std::uint64_t, 3>& at, std::uint32_t level) const;
  /// The largest cell's lower corner.
  std::array<std::uint64_t, 3> corner(std::uint32_t root) const;
};

/// What a node of a cell's tree is, in preorder; children by bits +x +y +z.
enum class NodeKind : std::uint8_t { none = 0, leaf = 1, split = 2 };

/// What is visible from one leaf.
struct LeafSet {
  std::vector<std::uint32_t> visible{};   ///< ascending: places of static objects (by id), then regions
  std::vector<std::uint32_t> touching{};  ///< ascending: places of occluders that the cell touches
};

/// One largest cell.
struct RootCells {
  std::vector<NodeKind> nodes{};
  std::vector<LeafSet> leaves{};
};

void write_root(const RootCells& root, ByteWriter& out);
RootCells read_root(ByteReader& in, std::uint32_t levels, std::uint32_t items);

/// Sizes of the same sets, bytes.
struct SetSizes {
  std::uint64_t leaves = 0, entries = 0;
  std::uint64_t plain = 0;  ///< four bytes an entry
  std::uint64_t bits = 0;   ///< one bit an object and region
  std::uint64_t delta = 0;  ///< as stored
};

/// All cells of a bake. Each leaf stores what it sees more and less than the leaf before it in preorder, mostly a
/// neighbour; every so many leaves one stores all.
class BakedCells {
 public:
  /// `objects`: number of static objects.
  BakedCells(const CellLattice& lattice, const MotionRegions& regions, std::uint32_t objects,
             std::span<const RootCells> roots);
  /// Throws Error(bad_scene) for bytes that write() did not write.
  explicit BakedCells(ByteReader& in);
  void write(ByteWriter& out) const;

  const MotionRegions& regions() const { return regions_; }
  const CellLattice& lattice() const { return lattice_; }
  std::uint32_t objects() const { return objects_; }
  SetSizes sizes() const;

  /// The leaf that holds a point; nothing outside all cells.
  std::optional<std::uint32_t> find(const Vec3& point) const;
  /// What is visible from it; `out` is overwritten.
  void decode(std::uint32_t leaf, LeafSet& out) const;

 private:
  struct Tree {
    std::uint32_t node = 0;  ///< first in nodes_
    std::uint32_t leaf = 0;  ///< first of its leaves
  };
  void read_starts(std::uint64_t leaves);
  void index();
  std::uint32_t items() const { return objects_ + regions_.size(); }

  CellLattice lattice_{};
  Rotation axes_{};  ///< the lattice's
  MotionRegions regions_{};
  std::uint32_t objects_ = 0;
  std::vector<NodeKind> nodes_{};
  std::vector<Tree> trees_{};               ///< by root
  std::vector<std::uint32_t> skip_{};       ///< by node: the node after its subtree
  std::vector<std::uint32_t> leaf_rank_{};  ///< by node: leaves before it
  std::vector<std::byte> sets_{};
  std::vector<std::uint64_t> starts_{};  ///< by leaf: its bytes in sets_
};

}  // namespace gridcull::extended
