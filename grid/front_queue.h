// One queue, front to back, for everything that a view of method `silhouette` meets: cells, objects, slices of
// objects, and occluders that wait to enter the mask (DESIGN section 5.3).
//
// Claim. Keys are distances. A test has the distance of the nearest point that it asks about, rounded down; an
// occluder the distance by which every ray of its cone has met its interior, rounded up. Buckets are taken in order
// and within a bucket all tests, also those that tests of that bucket add, come before any occluder. So when a test
// of key t meets the mask, every occluder in it has a key below t, strictly: what lies at t is behind it, and never
// only beside it. A test with a key below the bucket in hand is put there: it meets a mask that holds only
// occluders of lower buckets, and its points lie no nearer than its cell's key, which was at least as great (the
// ball of a child lies in its node's box up to rounding; that is why every key is rounded outward).
// Cost: a few stores an entry; buckets are found by a bit scan.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace gridcull {

class FrontQueue {
 public:
  enum class Kind : std::uint8_t { node, group, volume, object, slice, occluder };
  struct Item {
    std::uint64_t what;  ///< meaning depends on the kind
    std::uint32_t next;
    Kind kind;
  };

  FrontQueue() : tests_(buckets, none), occluders_(buckets, none) {}

  /// Starts a walk over distances from `nearest` to `farthest` (metres, finite; nearer and farther keys share the
  /// first and last bucket).
  void begin(double nearest, double farthest) {
    items_.clear();
    used_.assign(words, 0);
    nearest_ = nearest;
    const double extent = farthest - nearest;
    per_metre_ = extent > 0.0 ? static_cast<double>(buckets - 1) / extent : 0.0;
    at_ = 0;
    tests_left_ = 0;
  }

  void push(Kind kind, double key, std::uint64_t what) {
    const std::uint32_t bucket = std::max(at_, bucket_of(key));
    std::vector<std::uint32_t>& heads = kind == Kind::occluder ? occluders_ : tests_;
    if (kind != Kind::occluder) ++tests_left_;
    const std::uint64_t bit = std::uint64_t{1} << (bucket % 64);
    if ((used_[bucket / 64] & bit) == 0) {
      used_[bucket / 64] |= bit;
      tests_[bucket] = occluders_[bucket] = none;
    }
    items_.push_back({what, heads[bucket], kind});
    heads[bucket] = static_cast<std::uint32_t>(items_.size() - 1);
  }

  /// Takes the next item; false when there is none. `what` of an item stays valid until begin().
  bool pop(Item& item) {
    for (;;) {
      std::uint64_t word = used_[at_ / 64] >> (at_ % 64);
      if (word == 0) {
        std::uint32_t w = at_ / 64 + 1;
        while (w < words && used_[w] == 0) ++w;
        if (w == words) return false;
        at_ = w * 64 + static_cast<std::uint32_t>(std::countr_zero(used_[w]));
      } else {
        at_ += static_cast<std::uint32_t>(std::countr_zero(word));
      }
      std::uint32_t& head = tests_[at_] != none ? tests_[at_] : occluders_[at_];
      if (head == none) {
        used_[at_ / 64] &= ~(std::uint64_t{1} << (at_ % 64));
        continue;
      }
      item = items_[head];
      head = item.next;
      if (item.kind != Kind::occluder) --tests_left_;
      return true;
    }
  }

  /// Whether anything but occluders is left: those alone change no answer any more.
  bool any_tests() const { return tests_left_ != 0; }

  std::uint64_t bytes() const {
    return items_.capacity() * sizeof(Item) + 2 * buckets * sizeof(std::uint32_t) + words * sizeof(std::uint64_t);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFF'FFFFu;
  static constexpr std::uint32_t buckets = 2048;
  static constexpr std::uint32_t words = buckets / 64;

  // Subtracting, multiplying and truncating all keep the order of keys, so no rounding can swap two of them.
  std::uint32_t bucket_of(double key) const {
    const double t = (key - nearest_) * per_metre_;
    if (!(t > 0.0)) return 0;
    return t < static_cast<double>(buckets - 1) ? static_cast<std::uint32_t>(t) : buckets - 1;
  }

  std::vector<Item> items_;
  std::vector<std::uint32_t> tests_, occluders_;  // heads; valid where the bucket's bit is set
  std::vector<std::uint64_t> used_;
  double nearest_ = 0.0, per_metre_ = 0.0;
  std::uint32_t at_ = 0;
  std::uint64_t tests_left_ = 0;
};

}  // namespace gridcull
