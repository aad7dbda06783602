#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

IdentifierMatrix::IdentifierMatrix(const Lattice& lattice, std::unique_ptr<StaticStore> statics)
    : opaque_(lattice.brick_count()), heads_(lattice.brick_count()), statics_(std::move(statics)) {}

std::uint32_t IdentifierMatrix::allocate() {
  if (free_ != none) {
    const std::uint32_t index = free_;
    free_ = entries_[index].next_of_object;
    return index;
  }
  if (entries_.size() == entries_.capacity()) entries_.reserve(entries_.size() + entries_.size() / 8 + 64);
  entries_.push_back({});
  return static_cast<std::uint32_t>(entries_.size() - 1);
}

void IdentifierMatrix::unlink(std::uint32_t index, bool is_static) {
  const Entry& entry = entries_[index];
  std::uint32_t before = first(entry.brick, is_static);
  if (before == index) return set_first(entry.brick, is_static, entry.next_in_brick);
  while (entries_[before].next_in_brick != index) before = entries_[before].next_in_brick;
  entries_[before].next_in_brick = entry.next_in_brick;
}

void IdentifierMatrix::change_opaque(std::uint32_t index, std::uint64_t opaque, bool is_static) {
  Entry& entry = entries_[index];
  const std::uint64_t lost = entry.opaque & ~opaque;
  entry.opaque = opaque;
  std::uint64_t word = 0;
  if (lost == 0) {
    word = (is_static ? statics_->opaque(entry.brick) : opaque_[entry.brick]) | opaque;
  } else {
    // Another object may fill a lost cell too: gather the brick's owners again.
    for (std::uint32_t i = first(entry.brick, is_static); i != none; i = entries_[i].next_in_brick) {
      word |= entries_[i].opaque;
    }
  }
  set_opaque(entry.brick, is_static, word);
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
    if (entries_[index].opaque != 0) change_opaque(index, 0, is_static);
    unlink(index, is_static);
    static_written_ += is_static;
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
      entries_[index] = {0, 0, slot, brick.brick, first(brick.brick, is_static), none};
      set_first(brick.brick, is_static, index);
    }
    append(index);
    entries_[index].touched = brick.touched;
    const std::uint64_t opaque = occludes ? brick.opaque : 0;
    if (entries_[index].opaque != opaque) change_opaque(index, opaque, is_static);
    static_written_ += is_static;
  }
  while (old != none) {
    const std::uint32_t next = entries_[old].next_of_object;
    drop(old);
    old = next;
  }
  (last == none ? head : entries_[last].next_of_object) = none;
}

void IdentifierMatrix::remove(bool is_static, std::uint32_t& head) { update(none, Cover{}, false, is_static, head); }

}  // namespace gridcull
