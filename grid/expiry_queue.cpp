// A calendar queue (Brown 1988): bucket = floor(expiry / width) modulo the ring. A bucket may hold slots of a
// later round; they are skipped when drained. The width is the first frame step, so that a steady frame
// drains one or two buckets.
#include "gridcull/grid/expiry_queue.h"

#include <algorithm>

#include "gridcull/grid/bits.h"

namespace gridcull {

std::int64_t ExpiryQueue::day(double time) const {
  // Before the first step is known everything waits in bucket 0.
  if (width_ <= 0) return 0;
  const double days = std::floor(time / width_);
  return std::fabs(days) < most_days ? static_cast<std::int64_t>(days) : 0;
}

std::uint32_t ExpiryQueue::bucket_of(std::int64_t day) {
  return static_cast<std::uint32_t>(((day % ring) + ring) % ring);
}

// Every bucket has at most one chunk that is not full.
void ExpiryQueue::reserve(std::size_t count) {
  if (count > links_.capacity()) {
    links_.reserve(count + count / 8);
    chunks_.reserve(links_.capacity() / chunk_slots + static_cast<std::size_t>(ring) + 1);
    popped_.resize(links_.capacity() / 64 + 1);
  }
  if (count > links_.size()) links_.resize(count);
}

// What has expired already (it went back after a frame that failed) waits in the bucket that is drained next.
void ExpiryQueue::link(Slot slot) {
  Link& l = links_[slot];
  l.bucket = bucket_of(std::max(day(l.expiry), day(last_)));
  std::uint32_t& first = buckets_[l.bucket];
  if (first == none || chunks_[first].count == chunk_slots) {
    std::uint32_t chunk = free_;
    if (chunk == none) {
      chunk = static_cast<std::uint32_t>(chunks_.size());
      chunks_.emplace_back();
    } else {
      free_ = chunks_[chunk].next;
    }
    chunks_[chunk].next = first;
    chunks_[chunk].count = 0;
    first = chunk;
  }
  Chunk& chunk = chunks_[first];
  l.place = first * chunk_slots + chunk.count;
  chunk.slots[chunk.count++] = slot;
}

// The bucket's youngest takes its place.
void ExpiryQueue::erase(Slot slot) {
  Link& l = links_[slot];
  if (l.bucket == none) return;
  std::uint32_t& first = buckets_[l.bucket];
  Chunk& chunk = chunks_[first];
  const Slot last = chunk.slots[--chunk.count];
  if (last != slot) {
    chunks_[l.place / chunk_slots].slots[l.place % chunk_slots] = last;
    links_[last].place = l.place;
  }
  if (chunk.count == 0) {
    const std::uint32_t empty = first;
    first = chunk.next;
    chunks_[empty].next = free_;
    free_ = empty;
  }
  l.bucket = none;
}

// Backwards through each chunk: who takes a place is then of those that were looked at, or of the first chunk, which is
// looked at first. (A chunk that empties goes; its rest is read from a copy.)
void ExpiryQueue::drain(std::uint32_t bucket, double now) {
  for (std::uint32_t at = buckets_[bucket]; at != none;) {
    const Chunk chunk = chunks_[at];
    for (std::uint32_t i = 0; i < chunk.count; ++i) prefetch(chunk.slots[i]);
    if (chunk.next != none) __builtin_prefetch(&chunks_[chunk.next]);
    for (std::uint32_t i = chunk.count; i-- > 0;) {
      const Slot slot = chunk.slots[i];
      if (!(links_[slot].expiry < now)) continue;
      erase(slot);
      popped_[slot / 64] |= std::uint64_t{1} << (slot % 64);
    }
    at = chunk.next;
  }
}

void ExpiryQueue::list(std::vector<Slot>& out) {
  for (std::size_t w = 0; w < popped_.size(); ++w) {
    for_each_bit(popped_[w], [&](int bit) { out.push_back(static_cast<Slot>(64 * w) + static_cast<Slot>(bit)); });
    popped_[w] = 0;
  }
}

void ExpiryQueue::relay(double width) {
  std::vector<Slot> waiting;
  for (const std::uint32_t first : buckets_) {
    for (std::uint32_t at = first; at != none; at = chunks_[at].next) {
      waiting.insert(waiting.end(), chunks_[at].slots.begin(), chunks_[at].slots.begin() + chunks_[at].count);
    }
  }
  for (const Slot slot : waiting) erase(slot);
  width_ = width;
  unsuited_ = 0;
  for (const Slot slot : waiting) link(slot);
}

void ExpiryQueue::pop_expired(double now, std::vector<Slot>& out) {
  if (!started_ || width_ <= 0) {
    drain(0, now);
    if (started_ && now > last_) {
      relay(now - last_);  // the first step is known: spread what waits over the calendar
    }
  } else {
    // A long pause, or times so far from 0 that days cannot be told apart, drains the whole calendar.
    const double first = std::floor(last_ / width_), last = std::floor(now / width_);
    if (last - first + 1.0 >= static_cast<double>(ring) || !(std::max(std::fabs(first), std::fabs(last)) < most_days)) {
      for (std::uint32_t bucket = 0; bucket < ring; ++bucket) drain(bucket, now);
    } else {
      for (std::int64_t d = day(last_); d <= day(now); ++d) drain(bucket_of(d), now);
    }
  }
  const double step = now - last_;
  last_ = now;
  started_ = true;
  // The calendar suits steps near its width. Where steps have changed for good it is laid out anew.
  const bool suits = width_ <= 0 || (step > width_ / 16.0 && step < width_ * 16.0);
  unsuited_ = suits ? 0 : unsuited_ + 1;
  if (unsuited_ >= 8) relay(step);
  list(out);
}

}  // namespace gridcull
