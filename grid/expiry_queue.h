// Which temporal bounding volumes expire by when: a calendar of buckets with intrusive lists, so that
// entering, leaving and popping cost a few stores each, whatever the number of hidden objects.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

class ExpiryQueue {
 public:
  /// Room for slots 0 .. count - 1.
  void reserve(std::size_t count) {
    if (count > links_.capacity()) links_.reserve(count + count / 8);
    if (count > links_.size()) links_.resize(count);
  }

  /// The slot's volume is valid up to and including `expiry` (seconds). Infinite: never popped.
  void push(Slot slot, double expiry) {
    links_[slot].expiry = expiry;
    if (std::isinf(expiry)) return;
    link(slot);
  }

  void erase(Slot slot) {
    Link& link = links_[slot];
    if (link.bucket == none) return;
    (link.before == none ? buckets_[link.bucket] : links_[link.before].after) = link.after;
    if (link.after != none) links_[link.after].before = link.before;
    link.bucket = none;
  }

  double expiry(Slot slot) const { return links_[slot].expiry; }

  /// Moves every slot whose volume is no longer valid at `now` (expiry < now) to the back of `out`.
  /// Times must not go back.
  void pop_expired(double now, std::vector<Slot>& out);

  std::uint64_t bytes() const { return links_.capacity() * sizeof(Link) + buckets_.capacity() * sizeof(std::uint32_t); }

 private:
  struct Link {
    double expiry = 0;
    std::uint32_t before = none, after = none, bucket = none;
  };
  static constexpr std::int64_t ring = 1024;

  static constexpr double most_days = 9e15;  // beyond it doubles do not tell neighbouring days apart

  std::int64_t day(double time) const;
  static std::uint32_t bucket_of(std::int64_t day);
  void link(Slot slot);
  /// Lays the calendar out anew with buckets of `width` seconds.
  void relay(double width);
  void drain(std::uint32_t bucket, double now, std::vector<Slot>& out);

  std::vector<Link> links_;
  std::vector<std::uint32_t> buckets_ = std::vector<std::uint32_t>(ring, none);
  double width_ = 0;  // seconds a bucket; 0 until a frame step is known
  double last_ = 0;   // time of the last pop
  bool started_ = false;
  int unsuited_ = 0;  // frame steps in a row that are far from the width
};

}  // namespace gridcull
