#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

IdentifierMatrix::IdentifierMatrix(const Lattice& lattice)
    : opaque_(lattice.brick_count(), 0),
      opaque_static_(lattice.brick_count(), 0),
      heads_(lattice.brick_count(), none) {}

std::uint32_t IdentifierMatrix::allocate() {
  if (free_ != none) {
    const std::uint32_t index = free_;
    free_ = entries_[index].next_of_object;
    return index;
  }
  if (entries_.size() == entries_.capacity()) entries_.reserve(entries_.size() + entries_.size() / 8 + 64);
  entries_.push_back({});
  static_.push_back(false);
  return static_cast<std::uint32_t>(entries_.size() - 1);
}

void IdentifierMatrix::unlink(std::uint32_t index) {
  std::uint32_t* link = &heads_[entries_[index].brick];
  while (*link != index) link = &entries_[*link].next_in_brick;
  *link = entries_[index].next_in_brick;
}

void IdentifierMatrix::change_opaque(std::uint32_t index, std::uint64_t opaque, bool is_static) {
  Entry& entry = entries_[index];
  const std::uint64_t lost = entry.opaque & ~opaque;
  entry.opaque = opaque;
  std::uint64_t& word = is_static ? opaque_static_[entry.brick] : opaque_[entry.brick];
  if (lost == 0) {
    word |= opaque;
    return;
  }
  // Another object may fill a lost cell too: gather the brick's owners again.
  word = 0;
  for (std::uint32_t i = heads_[entry.brick]; i != none; i = entries_[i].next_in_brick) {
    if (static_[i] == is_static) word |= entries_[i].opaque;
  }
}

void IdentifierMatrix::update(Slot slot, const Cover& cover, bool occludes, bool is_static, std::uint32_t& head) {
  // Merge the old chain and the new cover, both ascending by brick.
  std::uint32_t old = head;
  std::uint32_t last = none;
  const auto append = [&](std::uint32_t index) {
    (last == none ? head : entries_[last].next_of_object) = index;
    last = index;
  };
  const auto drop = [&](std::uint32_t index) {
    change_opaque(index, 0, is_static);
    unlink(index);
    entries_[index].next_of_object = free_;
    free_ = index;
  };
  for (const BrickCover& brick : cover.bricks) {
    while (old != none && entries_[old].brick < brick.brick) {
      const std::uint32_t next = entries_[old].next_of_object;
      drop(old);
      old = next;
    }
    std::uint32_t index = old;
    if (old != none && entries_[old].brick == brick.brick) {
      old = entries_[old].next_of_object;
    } else {
      index = allocate();
      entries_[index] = {0, 0, slot, brick.brick, heads_[brick.brick], none};
      static_[index] = is_static;
      heads_[brick.brick] = index;
    }
    append(index);
    entries_[index].touched = brick.touched;
    const std::uint64_t opaque = occludes ? brick.opaque : 0;
    if (entries_[index].opaque != opaque) change_opaque(index, opaque, is_static);
  }
  while (old != none) {
    const std::uint32_t next = entries_[old].next_of_object;
    drop(old);
    old = next;
  }
  (last == none ? head : entries_[last].next_of_object) = none;
}

void IdentifierMatrix::remove(bool is_static, std::uint32_t& head) { update(none, Cover{}, false, is_static, head); }

std::uint64_t IdentifierMatrix::matrix_bytes() const {
  return opaque_.size() * (2 * sizeof(std::uint64_t) + sizeof(std::uint32_t));
}

}  // namespace gridcull
