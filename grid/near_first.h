// A queue about by distance, for walks whose order is a matter of cost only: equal buckets of distance, last in first
// out within a bucket, nothing ever put before the bucket in hand. A few stores an item; buckets are found by a bit
// scan. Small enough to stay in the first-level cache.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace gridcull {

class NearFirst {
 public:
  /// For distances from 0 to `extent` (metres); farther ones share the last bucket.
  void begin(double extent) {
    items_.clear();
    used_.fill(0);
    per_metre_ = extent > 0.0 ? buckets / extent : 0.0;
    at_ = 0;
  }

  void push(double distance, std::uint32_t what) {
    const double place = distance * per_metre_;
    std::uint32_t bucket = place < buckets - 1 ? (place > 0.0 ? static_cast<std::uint32_t>(place) : 0) : buckets - 1;
    if (bucket < at_) bucket = at_;
    const std::uint64_t bit = std::uint64_t{1} << (bucket % 64);
    std::uint64_t& word = used_[bucket / 64];
    items_.push_back({what, (word & bit) != 0 ? heads_[bucket] : end});
    word |= bit;
    heads_[bucket] = static_cast<std::uint32_t>(items_.size() - 1);
  }

  /// False when it is empty.
  bool pop(std::uint32_t& what) {
    std::uint32_t w = at_ / 64;
    while (used_[w] == 0) {
      if (++w == used_.size()) return false;
    }
    at_ = 64 * w + static_cast<std::uint32_t>(std::countr_zero(used_[w]));
    const Item& item = items_[heads_[at_]];
    what = item.what;
    heads_[at_] = item.next;
    if (item.next == end) used_[w] &= used_[w] - 1;
    return true;
  }

  std::uint64_t bytes() const { return sizeof(*this) + items_.capacity() * sizeof(Item); }

 private:
  static constexpr std::uint32_t buckets = 256;
  static constexpr std::uint32_t end = 0xFFFF'FFFFu;
  struct Item {
    std::uint32_t what, next;
  };

  std::array<std::uint64_t, buckets / 64> used_{};
  std::array<std::uint32_t, buckets> heads_{};
  std::vector<Item> items_;
  double per_metre_ = 0.0;
  std::uint32_t at_ = 0;
};

}  // namespace gridcull
