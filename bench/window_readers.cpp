#include "window_readers.h"

#include <algorithm>

#if GRIDCULL_BENCH_OPENVDB
#include <openvdb/openvdb.h>
#endif
#if GRIDCULL_BENCH_NANOVDB
#include <nanovdb/util/OpenToNanoVDB.h>
#endif

namespace gridcull {
namespace {

class StoreReader final : public WindowReader {
 public:
  StoreReader(const Lattice& lattice, const StaticStore& store) : lattice_(lattice), store_(store) {}
  void add_row(const Cell& first, std::span<std::uint64_t> out) const override {
    store_.add_opaque_row(lattice_.brick_index(first), out);
  }

 private:
  const Lattice& lattice_;
  const StaticStore& store_;
};

#if GRIDCULL_BENCH_OPENVDB

openvdb::Int64Grid::Ptr grid_of(const Lattice& lattice, const StaticStore& store) {
  openvdb::initialize();
  auto grid = openvdb::Int64Grid::create(0);
  auto accessor = grid->getAccessor();
  const Cell bricks = lattice.bricks();
  for (std::int64_t z = 0; z < bricks.z; ++z) {
    for (std::int64_t y = 0; y < bricks.y; ++y) {
      for (std::int64_t x = 0; x < bricks.x; ++x) {
        const std::uint64_t word = store.opaque(lattice.brick_index({x, y, z}));
        const openvdb::Coord at(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
        if (word != 0) accessor.setValueOn(at, static_cast<std::int64_t>(word));
      }
    }
  }
  return grid;
}

template <class Accessor, class Coord>
void read_row(const Accessor& accessor, const Cell& first, std::span<std::uint64_t> out) {
  Coord at(static_cast<int>(first.x), static_cast<int>(first.y), static_cast<int>(first.z));
  for (std::uint64_t& word : out) {
    word |= static_cast<std::uint64_t>(accessor.getValue(at));
    ++at[0];
  }
}

class AccessorReader final : public WindowReader {
 public:
  AccessorReader(const Lattice& lattice, const StaticStore& store) : grid_(grid_of(lattice, store)) {}
  void add_row(const Cell& first, std::span<std::uint64_t> out) const override {
    const openvdb::tree::ValueAccessor<const openvdb::Int64Tree, false> accessor(grid_->constTree());
    read_row<decltype(accessor), openvdb::Coord>(accessor, first, out);
  }

 private:
  openvdb::Int64Grid::Ptr grid_;
};

class TreeReader final : public WindowReader {
 public:
  TreeReader(const Lattice& lattice, const StaticStore& store) : grid_(grid_of(lattice, store)) {}
  void add_row(const Cell& first, std::span<std::uint64_t> out) const override {
    read_row<openvdb::Int64Tree, openvdb::Coord>(grid_->constTree(), first, out);
  }

 private:
  openvdb::Int64Grid::Ptr grid_;
};

#endif
#if GRIDCULL_BENCH_NANOVDB

class NanoReader : public WindowReader {
 public:
  NanoReader(const Lattice& lattice, const StaticStore& store) {
    const openvdb::GridBase::Ptr grid = grid_of(lattice, store);
    handle_ = nanovdb::openToNanoVDB(grid);
    grid_ = handle_.grid<std::int64_t>();
  }
  void add_row(const Cell& first, std::span<std::uint64_t> out) const override {
    const auto accessor = grid_->getAccessor();
    read_row<decltype(accessor), nanovdb::Coord>(accessor, first, out);
  }

 private:
  nanovdb::GridHandle<> handle_;

 protected:
  const nanovdb::NanoGrid<std::int64_t>* grid_ = nullptr;
};

/// Leaf by leaf, as the store reads OpenVDB's.
class NanoLeafReader final : public NanoReader {
 public:
  using NanoReader::NanoReader;
  void add_row(const Cell& first, std::span<std::uint64_t> out) const override {
    constexpr int edge = 8, step = 64;
    const auto accessor = grid_->getAccessor();
    nanovdb::Coord at(static_cast<int>(first.x), static_cast<int>(first.y), static_cast<int>(first.z));
    for (std::size_t i = 0; i < out.size();) {
      const int inside = at[0] & (edge - 1);
      const std::size_t count = std::min(out.size() - i, static_cast<std::size_t>(edge - inside));
      if (const auto* leaf = accessor.probeLeaf(at)) {
        const std::uint32_t offset = leaf->CoordToOffset(at);
        for (std::size_t k = 0; k < count; ++k) {
          out[i + k] |= static_cast<std::uint64_t>(leaf->getValue(offset + static_cast<std::uint32_t>(k) * step));
        }
      }
      i += count;
      at[0] += static_cast<int>(count);
    }
  }
};

#endif

template <class Reader>
std::unique_ptr<WindowReader> make(const Lattice& lattice, const StaticStore& store) {
  return std::make_unique<Reader>(lattice, store);
}

}  // namespace

std::unique_ptr<WindowReader> make_store_reader(const Lattice& lattice, const StaticStore& store) {
  return make<StoreReader>(lattice, store);
}

std::vector<NamedReader> tree_readers() {
  return {
#if GRIDCULL_BENCH_OPENVDB
    {"openvdb_accessor", make<AccessorReader>}, {"openvdb_tree", make<TreeReader>},
#endif
#if GRIDCULL_BENCH_NANOVDB
        {"nanovdb_accessor", make<NanoReader>}, {"nanovdb_leaves", make<NanoLeafReader>},
#endif
  };
}

}  // namespace gridcull
