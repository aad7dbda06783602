// Short rows of balls in a common pool: what hangs in one node of the loose index lies side by side in memory, so that
// a walk that opens the node waits for memory once, not once an object.
//
// A row is a chain of chunks of two cache lines; only its first chunk may have room. Adding and removing a ball
// touch that one and the ball's own; what is removed is replaced by the row's youngest.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/vec.h"
#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

/// A ball (2D: disc), metres.
struct LooseBall {
  Vec3 centre{0.0};
  double radius = 0.0;
};

class BallRows {
 public:
  struct Item {
    LooseBall ball{};
    Slot slot = none;
    // The caller's own.
    std::uint8_t marks = 0;
    std::uint8_t wide = 255, tall = 255;  ///< 255ths of the radius
  };
  static constexpr std::uint32_t chunk_items = 3;
  struct alignas(64) Chunk {
    std::array<Item, chunk_items> items{};
    std::uint32_t next = none;
    std::uint32_t count = 0;
  };
  static_assert(sizeof(Chunk) == 128);
  /// Place of an item: its chunk and its number there.
  using Place = std::uint32_t;

  /// Room for so many balls, each in a row of its own.
  void reserve(std::size_t balls) { chunks_.reserve(balls); }

  /// Adds to the row that begins at chunk `first` (none: empty), which changes.
  Place add(std::uint32_t& first, const Item& item) {
    if (first == none || chunks_[first].count == chunk_items) first = new_chunk(first);
    Chunk& chunk = chunks_[first];
    chunk.items[chunk.count] = item;
    return first * chunk_items + chunk.count++;
  }

  /// Takes the item at `place` out of the row; moved(slot) stands at `place` from now on (none: nobody).
  Slot remove(std::uint32_t& first, Place place) {
    Chunk& chunk = chunks_[first];
    const Item last = chunk.items[--chunk.count];
    const bool itself = place == first * chunk_items + chunk.count;
    if (!itself) (*this)[place] = last;
    if (chunk.count == 0) {
      const std::uint32_t empty = first;
      first = chunk.next;
      chunks_[empty].next = free_;
      free_ = empty;
    }
    return itself ? none : last.slot;
  }

  Item& operator[](Place place) { return chunks_[place / chunk_items].items[place % chunk_items]; }
  const Item& operator[](Place place) const { return chunks_[place / chunk_items].items[place % chunk_items]; }
  const Chunk& chunk(std::uint32_t index) const { return chunks_[index]; }
  /// A hint that the chunk is needed soon; none is fine.
  void prefetch(std::uint32_t index) const {
    if (index == none) return;
    const auto* chunk = reinterpret_cast<const char*>(&chunks_[index]);
    __builtin_prefetch(chunk);
    __builtin_prefetch(chunk + 64);
  }
  void prefetch_item(Place place) const { __builtin_prefetch(&(*this)[place]); }

  std::uint64_t bytes() const { return chunks_.size() * sizeof(Chunk); }

 private:
  std::uint32_t new_chunk(std::uint32_t next) {
    std::uint32_t index = free_;
    if (index == none) {
      index = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    } else {
      free_ = chunks_[index].next;
    }
    chunks_[index].next = next;
    chunks_[index].count = 0;
    return index;
  }

  std::vector<Chunk> chunks_;
  std::uint32_t free_ = none;  // chain of chunks that are in no row
};

}  // namespace gridcull
