// Which temporal bounding volumes expire by when: a calendar of buckets, rows of slots side by side in memory, so that
// entering, leaving and popping cost a few stores each, whatever the number of hidden objects, and what a bucket holds
// can be asked for ahead.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

class ExpiryQueue {
 public:
  /// Room for slots 0 .. count - 1: nothing is allocated until there are more.
  void reserve(std::size_t count);

  /// The slot's volume is valid up to and including `expiry` (seconds). Infinite: never popped.
  void push(Slot slot, double expiry) {
    links_[slot].expiry = expiry;
    if (std::isinf(expiry)) return;
    link(slot);
  }

  void erase(Slot slot);

  double expiry(Slot slot) const { return links_[slot].expiry; }
  /// Hints that the slot will be pushed or erased soon.
  void prefetch(Slot slot) const { __builtin_prefetch(&links_[slot]); }

  /// Moves every slot whose volume is no longer valid at `now` (expiry < now) to the back of `out`, ascending.
  /// Times must not go back.
  void pop_expired(double now, std::vector<Slot>& out);

  std::uint64_t bytes() const {
    return links_.capacity() * sizeof(Link) + chunks_.capacity() * sizeof(Chunk) +
           buckets_.capacity() * sizeof(std::uint32_t) + popped_.capacity() * sizeof(std::uint64_t);
  }

 private:
  struct Link {
    double expiry = 0;
    std::uint32_t bucket = none;
    std::uint32_t place = none;  // chunk_slots * its chunk + its place there
  };
  static constexpr std::uint32_t chunk_slots = 14;
  /// Part of a bucket's row; only the first may have room.
  struct alignas(64) Chunk {
    std::array<Slot, chunk_slots> slots{};
    std::uint32_t next = none;
    std::uint32_t count = 0;
  };
  static constexpr std::int64_t ring = 1024;

  static constexpr double most_days = 9e15;  // beyond it doubles do not tell neighbouring days apart

  std::int64_t day(double time) const;
  static std::uint32_t bucket_of(std::int64_t day);
  void link(Slot slot);
  /// Lays the calendar out anew with buckets of `width` seconds.
  void relay(double width);
  /// Takes what has expired out of a bucket and notes it in popped_.
  void drain(std::uint32_t bucket, double now);
  /// Appends what popped_ says, ascending, and clears it.
  void list(std::vector<Slot>& out);

  std::vector<Link> links_;
  std::vector<Chunk> chunks_;
  std::uint32_t free_ = none;                                                    // chain of chunks in no row
  std::vector<std::uint64_t> popped_;                                            // a bit a slot, all 0 between calls
  std::vector<std::uint32_t> buckets_ = std::vector<std::uint32_t>(ring, none);  // their first chunks
  double width_ = 0;  // seconds a bucket; 0 until a frame step is known
  double last_ = 0;   // time of the last pop
  bool started_ = false;
  int unsuited_ = 0;  // frame steps in a row that are far from the width
};

}  // namespace gridcull
