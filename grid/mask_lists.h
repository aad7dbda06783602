// Lists of (slot, bits) hanging on bricks, with a chain through each slot's entries: how outlines of
// temporal bounding volumes are kept.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lazy_array.h"

namespace gridcull {

class MaskLists {
 public:
  struct Entry {
    std::uint64_t bits;
    Slot slot;
    std::uint32_t brick;
    std::uint32_t before, after;  // in the brick's list
    std::uint32_t next_of_slot;
  };

  explicit MaskLists(std::size_t bricks) : heads_(bricks) {}

  void reserve(std::size_t slots) {
    if (slots > chains_.size()) chains_.resize(slots, none);
  }

  void insert(Slot slot, std::uint32_t brick, std::uint64_t bits) {
    std::uint32_t index = free_;
    if (index == none) {
      index = static_cast<std::uint32_t>(entries_.size());
      entries_.push_back({});
    } else {
      free_ = entries_[index].next_of_slot;
    }
    entries_[index] = {bits, slot, brick, none, first(brick), chains_[slot]};
    if (any(brick)) entries_[first(brick)].before = index;
    heads_[brick] = index + 1;
    chains_[slot] = index;
  }

  void erase(Slot slot) {
    for (std::uint32_t i = chains_[slot]; i != none;) {
      const Entry entry = entries_[i];
      if (entry.before == none) {
        heads_[entry.brick] = entry.after + 1;
      } else {
        entries_[entry.before].after = entry.after;
      }
      if (entry.after != none) entries_[entry.after].before = entry.before;
      entries_[i].next_of_slot = free_;
      free_ = i;
      i = entry.next_of_slot;
    }
    chains_[slot] = none;
  }

  bool any(std::size_t brick) const { return heads_[brick] != 0; }
  std::uint32_t first(std::size_t brick) const { return heads_[brick] - 1; }
  const Entry& entry(std::uint32_t index) const { return entries_[index]; }

  /// The slot's bits in a brick, 0 where it has none. Walks the slot's chain: outlines are short.
  std::uint64_t bits(Slot slot, std::uint32_t brick) const {
    for (std::uint32_t i = chains_[slot]; i != none; i = entries_[i].next_of_slot) {
      if (entries_[i].brick == brick) return entries_[i].bits;
    }
    return 0;
  }

  std::uint64_t matrix_bytes() const { return heads_.bytes(); }
  std::uint64_t entry_bytes() const {
    return entries_.capacity() * sizeof(Entry) + chains_.capacity() * sizeof(std::uint32_t);
  }

 private:
  LazyArray<std::uint32_t> heads_;     // per brick: the first entry plus one, 0: none
  std::vector<std::uint32_t> chains_;  // per slot
  std::vector<Entry> entries_;
  std::uint32_t free_ = none;
};

}  // namespace gridcull
