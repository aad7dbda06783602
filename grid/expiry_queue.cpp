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
  return std::fabs(days) < most_days ? static_cast<std::int64_t>(days) : 0;
}

std::uint32_t ExpiryQueue::bucket_of(std::int64_t day) {
  return static_cast<std::uint32_t>(((day % ring) + ring) % ring);
}

// What has expired already (it went back after a frame that failed) waits in the bucket that is drained next.
void ExpiryQueue::link(Slot slot) {
  Link& l = links_[slot];
  const std::uint32_t bucket = bucket_of(std::max(day(l.expiry), day(last_)));
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

void ExpiryQueue::relay(double width) {
  std::vector<Slot> waiting;
  for (const std::uint32_t head : buckets_) {
    for (std::uint32_t slot = head; slot != none; slot = links_[slot].after) waiting.push_back(slot);
  }
  for (const Slot slot : waiting) erase(slot);
  width_ = width;
  unsuited_ = 0;
  for (const Slot slot : waiting) link(slot);
}

void ExpiryQueue::pop_expired(double now, std::vector<Slot>& out) {
  const std::size_t before = out.size();
  if (!started_ || width_ <= 0) {
    drain(0, now, out);
    if (started_ && now > last_) {
      relay(now - last_);  // the first step is known: spread what waits over the calendar
    }
  } else {
    // A long pause, or times so far from 0 that days cannot be told apart, drains the whole calendar.
    const double first = std::floor(last_ / width_), last = std::floor(now / width_);
    if (last - first + 1.0 >= static_cast<double>(ring) || !(std::max(std::fabs(first), std::fabs(last)) < most_days)) {
      for (std::uint32_t bucket = 0; bucket < ring; ++bucket) drain(bucket, now, out);
    } else {
      for (std::int64_t d = day(last_); d <= day(now); ++d) drain(bucket_of(d), now, out);
    }
  }
  const double step = now - last_;
  last_ = now;
  started_ = true;
  // The calendar suits steps near its width. Where steps have changed for good it is laid out anew.
  const bool suits = width_ <= 0 || (step > width_ / 16.0 && step < width_ * 16.0);
  unsuited_ = suits ? 0 : unsuited_ + 1;
  if (unsuited_ >= 8) relay(step);
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
}

}  // namespace gridcull
