// The matrices I, O and O_s (Batagelo and Wu 2002, sections 3, 4.1 and 4.5).
//
// The paper keeps a list of ids in every cell. Here a list hangs on every brick of 64 cells and each entry
// carries the bits of the cells it touches and of those it fills: the same matrix at a fraction of the
// memory, and a whole brick is tested with one AND. Each opaque cell therefore also knows its owners, which
// many viewers need: one viewer's vehicle is another viewer's occluder.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/grid/cover.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

/// Index into the engine's object table.
using Slot = std::uint32_t;
inline constexpr std::uint32_t none = 0xFFFF'FFFFu;

class IdentifierMatrix {
 public:
  struct Entry {
    std::uint64_t touched;
    std::uint64_t opaque;
    Slot slot;
    std::uint32_t brick;
    std::uint32_t next_in_brick;
    std::uint32_t next_of_object;  ///< bricks ascend along an object's chain
  };

  explicit IdentifierMatrix(const Lattice& lattice);

  /// Makes the object's entries those of `cover`; `head` is the object's chain (none: not in the matrix).
  /// Entries in bricks it covered before are changed in place: a small move touches little. `occludes`
  /// false keeps its opaque bits out of O. `is_static` puts them into O_s.
  void update(Slot slot, const Cover& cover, bool occludes, bool is_static, std::uint32_t& head);
  void remove(bool is_static, std::uint32_t& head);

  /// O with O_s: opaque cells of a brick.
  std::uint64_t opaque(std::size_t brick) const { return opaque_static_[brick] | opaque_[brick]; }

  const Entry& entry(std::uint32_t index) const { return entries_[index]; }
  std::uint32_t first_in_brick(std::size_t brick) const { return heads_[brick]; }

  std::uint64_t matrix_bytes() const;
  std::uint64_t entry_bytes() const { return entries_.capacity() * sizeof(Entry); }

 private:
  std::uint32_t allocate();
  void unlink(std::uint32_t index);
  void change_opaque(std::uint32_t index, std::uint64_t opaque, bool is_static);

  std::vector<std::uint64_t> opaque_;         // O of moving objects
  std::vector<std::uint64_t> opaque_static_;  // O_s
  std::vector<std::uint32_t> heads_;          // I, per brick
  std::vector<Entry> entries_;
  std::vector<bool> static_;  // per entry: counts for O_s
  std::uint32_t free_ = none;
};

}  // namespace gridcull
