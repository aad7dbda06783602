// The matrices I, O and O_s (Batagelo and Wu 2002, sections 3, 4.1 and 4.5).
//
// The paper keeps a list of ids in every cell. Here a list hangs on every brick of 64 cells and each entry
// carries the bits of the cells it touches and of those it fills: the same matrix at a fraction of the
// memory, and a whole brick is tested with one AND. Each opaque cell therefore also knows its owners, which
// many viewers need: one viewer's vehicle is another viewer's occluder.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gridcull/grid/cover.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/lazy_array.h"
#include "gridcull/grid/static_store.h"

namespace gridcull {

/// Index into the engine's object table.
using Slot = std::uint32_t;
inline constexpr std::uint32_t none = StaticStore::nobody;

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

  /// `statics`: where static objects are kept.
  IdentifierMatrix(const Lattice& lattice, std::unique_ptr<StaticStore> statics);

  /// Makes the object's entries those of `cover`; `head` is the object's chain (none: not in the matrix).
  /// Entries in bricks it covered before are changed in place: a small move touches little. `occludes`
  /// false keeps its opaque bits out of O. `is_static` puts them into O_s.
  void update(Slot slot, const Cover& cover, bool occludes, bool is_static, std::uint32_t& head);
  void remove(bool is_static, std::uint32_t& head);

  /// O with O_s: opaque cells of a brick.
  std::uint64_t opaque(std::size_t brick) const { return statics_->opaque(brick) | opaque_[brick]; }
  /// The same of neighbours along x, the first `brick`, in one row of the lattice.
  void opaque_row(std::size_t brick, std::span<std::uint64_t> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = opaque_[brick + i];
    statics_->add_opaque_row(brick, out);
  }

  const Entry& entry(std::uint32_t index) const { return entries_[index]; }
  /// Calls f(entry) for everyone in the brick.
  template <class F>
  void each_in_brick(std::size_t brick, F&& f) const {
    for (std::uint32_t i = heads_[brick] - 1; i != none; i = entries_[i].next_in_brick) f(entries_[i]);
    for (std::uint32_t i = statics_->first(brick); i != none; i = entries_[i].next_in_brick) f(entries_[i]);
  }

  std::uint64_t matrix_bytes() const { return opaque_.bytes() + heads_.bytes() + statics_->bytes(); }
  std::uint64_t entry_bytes() const { return entries_.capacity() * sizeof(Entry); }
  /// Bricks of static objects that were written so far: an edit costs in proportion to what it changes.
  std::uint64_t static_bricks_written() const { return static_written_; }

 private:
  std::uint32_t allocate();
  std::uint32_t first(std::size_t brick, bool is_static) const {
    return is_static ? statics_->first(brick) : heads_[brick] - 1;
  }
  void set_first(std::size_t brick, bool is_static, std::uint32_t index) {
    if (is_static) return statics_->set_first(brick, index);
    heads_[brick] = index + 1;
  }
  void unlink(std::uint32_t index, bool is_static);
  void change_opaque(std::uint32_t index, std::uint64_t opaque, bool is_static);
  void set_opaque(std::size_t brick, bool is_static, std::uint64_t cells) {
    if (is_static) return statics_->set_opaque(brick, cells);
    opaque_[brick] = cells;
  }

  LazyArray<std::uint64_t> opaque_;       // O of moving objects
  LazyArray<std::uint32_t> heads_;        // I of moving objects, per brick: the first entry plus one, 0: nobody
  std::unique_ptr<StaticStore> statics_;  // O_s, and I of static objects
  std::vector<Entry> entries_;
  std::uint32_t free_ = none;
  std::uint64_t static_written_ = 0;
};

}  // namespace gridcull
