// Static worlds in OpenVDB's trees: openvdb_store.h.
#include "gridcull/grid/openvdb_store.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include <openvdb/openvdb.h>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

using WordTree = openvdb::Int64Tree;
using HeadTree = openvdb::Int32Tree;

using Leaf = WordTree::LeafNodeType;

/// Reads without the tree's list of accessors: any number of threads may, each with its own.
using Reader = openvdb::tree::ValueAccessor<const WordTree, false>;

/// A voxel is a brick: its word of O_s, and the head of its list. Empty bricks are background.
class OpenVdbStore final : public StaticStore {
 public:
  explicit OpenVdbStore(const Lattice& lattice) : lattice_(lattice), words_(0), heads_(-1) {}

  std::uint64_t opaque(std::size_t brick) const override {
    return static_cast<std::uint64_t>(words_.getValue(place(brick)));
  }
  /// Leaf by leaf, those that are not there skipped: three times as fast as an accessor for each word (bench_static).
  void add_opaque_row(std::size_t brick, std::span<std::uint64_t> out) const override {
    constexpr int edge = Leaf::DIM, step = edge * edge;  // x is a leaf's slowest axis
    const Reader words(words_);
    openvdb::Coord at = place(brick);
    for (std::size_t i = 0; i < out.size();) {
      const int inside = at.x() & (edge - 1);
      const std::size_t count = std::min(out.size() - i, static_cast<std::size_t>(edge - inside));
      if (const Leaf* leaf = words.probeConstLeaf(at)) {
        const std::int64_t* value = leaf->buffer().data() + Leaf::coordToOffset(at);
        for (std::size_t k = 0; k < count; ++k) out[i + k] |= static_cast<std::uint64_t>(value[k * step]);
      }
      i += count;
      at.x() += static_cast<int>(count);
    }
  }
  std::uint32_t first(std::size_t brick) const override {
    return static_cast<std::uint32_t>(heads_.getValue(place(brick)));
  }
  void set_opaque(std::size_t brick, std::uint64_t cells) override {
    set(words_, place(brick), static_cast<std::int64_t>(cells));
  }
  void set_first(std::size_t brick, std::uint32_t entry) override {
    set(heads_, place(brick), static_cast<std::int32_t>(entry));
  }
  std::uint64_t bytes() const override { return words_.memUsage() + heads_.memUsage(); }

 private:
  openvdb::Coord place(std::size_t brick) const {
    const Cell corner = lattice_.brick_corner(brick);
    const int shift = lattice_.brick_shift();
    return {static_cast<int>(corner.x >> shift), static_cast<int>(corner.y >> shift),
            lattice_.dimension() == 2 ? 0 : static_cast<int>(corner.z >> shift)};
  }
  template <class Tree, class Value>
  static void set(Tree& tree, const openvdb::Coord& at, Value value) {
    if (value != tree.background()) return tree.setValueOn(at, value);
    auto* leaf = tree.probeLeaf(at);
    if (leaf == nullptr) return;
    leaf->setValueOff(at, value);
    // What nobody is in any longer goes back to a tile.
    if (leaf->isEmpty()) tree.addTile(1, at, tree.background(), false);
  }

  const Lattice& lattice_;
  WordTree words_;
  HeadTree heads_;
};

}  // namespace

bool has_openvdb() { return true; }

void check_openvdb_lattice(const Lattice& lattice) {
  const Cell cells = lattice.cells();
  const std::int64_t most = std::max({cells.x, cells.y, cells.z});
  if (most <= std::numeric_limits<std::int32_t>::max()) return;
  throw Error(ErrorCode::limit, "OpenVDB: expected at most 2^31 cells along an axis, found " + std::to_string(most));
}

std::unique_ptr<StaticStore> make_openvdb_store(const Lattice& lattice) {
  check_openvdb_lattice(lattice);
  openvdb::initialize();
  return std::make_unique<OpenVdbStore>(lattice);
}

}  // namespace gridcull
