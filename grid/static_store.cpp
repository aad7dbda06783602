#include "gridcull/grid/static_store.h"

#include "gridcull/core/error.h"
#include "gridcull/grid/lazy_array.h"
#include "gridcull/grid/openvdb_store.h"

namespace gridcull {
namespace {

/// Heads are kept plus one, so that an empty list is 0, as untouched memory is.
class DenseStore final : public StaticStore {
 public:
  explicit DenseStore(const Lattice& lattice) : opaque_(lattice.brick_count()), heads_(lattice.brick_count()) {}

  std::uint64_t opaque(std::size_t brick) const override { return opaque_[brick]; }
  void add_opaque_row(std::size_t brick, std::span<std::uint64_t> out) const override {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] |= opaque_[brick + i];
  }
  std::uint32_t first(std::size_t brick) const override { return heads_[brick] - 1; }
  void set_opaque(std::size_t brick, std::uint64_t cells) override { opaque_[brick] = cells; }
  void set_first(std::size_t brick, std::uint32_t entry) override { heads_[brick] = entry + 1; }
  std::uint64_t bytes() const override { return opaque_.bytes() + heads_.bytes(); }

 private:
  LazyArray<std::uint64_t> opaque_;
  LazyArray<std::uint32_t> heads_;
};

}  // namespace

std::string_view name_of(StoreKind kind) { return kind == StoreKind::dense ? "dense" : "openvdb"; }

bool has_store(StoreKind kind) { return kind == StoreKind::dense || has_openvdb(); }

std::unique_ptr<StaticStore> make_static_store(StoreKind kind, const Lattice& lattice) {
  if (kind == StoreKind::openvdb) return make_openvdb_store(lattice);
  return std::make_unique<DenseStore>(lattice);
}

}  // namespace gridcull
