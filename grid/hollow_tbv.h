// temporary
#pragma once
#include <span>
#include "gridcull/grid/mask_lists.h"
#include "gridcull/grid/tbv_matrix.h"
namespace gridcull {
class HollowTbv {
 public:
  explicit HollowTbv(const Lattice&) {}
  void reserve(std::size_t) {}
  bool insert(Slot, const TbvMatrix::Ball&, std::span<const Cell>) { return false; }
  void erase(Slot) {}
  std::uint64_t size() const { return 0; }
  bool may_touch(std::size_t) const { return false; }
  template <class F> std::uint64_t touching(std::size_t, std::uint64_t, F&&) const { return 0; }
  void enclosing(std::span<const Cell>, std::vector<Slot>&) const {}
  std::uint64_t matrix_bytes() const { return 0; }
  std::uint64_t entry_bytes() const { return 0; }
};
}
