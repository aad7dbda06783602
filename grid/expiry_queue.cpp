// A calendar queue (Brown 1988): bucket = floor(expiry / width) modulo the ring. A bucket may hold slots of a
// later round; they are skipped when drained. The width is the first frame step, so that a steady frame
// drains one or two buckets.
#include "gridcull/grid/expiry_queue.h"

#include <algorithm>

namespace gridcull {

std::int64_t ExpiryQueue::day(double time) const {
  // Before the first step is known everything waits in bucket 0.
  if (width_ <= 0) return 0;
  const double days = std::floor(time / width_);
  return std::abs(days) < 9e15 ? static_cast<std::int64_t>(days) : 0;
}

void ExpiryQueue::link(Slot slot) {
  Link& l = links_[slot];
  const auto bucket = static_cast<std::uint32_t>(((day(l.expiry) % ring) + ring) % ring);
  l.bucket = bucket;
  l.before = none;
  l.after = buckets_[bucket];
  if (l.after != none) links_[l.after].before = slot;
  buckets_[bucket] = slot;
}

void ExpiryQueue::drain(std::uint32_t bucket, double now, std::vector<Slot>& out) {
  for (std::uint32_t slot = buckets_[bucket]; slot != none;) {
    const std::uint32_t next = links_[slot].after;
    if (links_[slot].expiry < now) {
      erase(slot);
      out.push_back(slot);
    }
    slot = next;
  }
}

void ExpiryQueue::pop_expired(double now, std::vector<Slot>& out) {
  const std::size_t before = out.size();
  if (!started_ || width_ <= 0) {
    drain(0, now, out);
    if (started_ && now > last_) {
      // The first step is known: spread what waits over the calendar.
      std::vector<Slot> waiting;
      for (std::uint32_t slot = buckets_[0]; slot != none; slot = links_[slot].after) waiting.push_back(slot);
      for (const Slot slot : waiting) erase(slot);
      width_ = now - last_;
      for (const Slot slot : waiting) link(slot);
    }
  } else {
    const std::int64_t first = day(last_), last = day(now);
    const std::int64_t days = std::min(last - first + 1, ring);
    for (std::int64_t d = 0; d < days; ++d) {
      drain(static_cast<std::uint32_t>((((first + d) % ring) + ring) % ring), now, out);
    }
  }
  last_ = now;
  started_ = true;
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
}

}  // namespace gridcull
