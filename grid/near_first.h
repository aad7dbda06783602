// A queue about by distance, for walks whose order is a matter of cost only, but must be the same in every run: equal
// buckets of distance; within a bucket nodes before objects, objects by their number. A few stores an item; buckets
// are found by a bit scan. Small enough to stay in the first-level cache.
//
// Claim: what is popped does not depend on the order of pushes. Nodes of a bucket are taken in any order, but all of
// them, with those that they add, before the first object; so a test of a node meets what came before the bucket.
#pragma once

#include <algorithm>
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

  void push_node(double distance, std::uint32_t node) { push(nodes_, bucket_of(distance), node, 0); }
  /// `place` is handed back with the object.
  void push_object(double distance, std::uint32_t object, std::uint32_t place) {
    push(objects_, bucket_of(distance), object, place);
  }

  /// Calls node(number), which may push, and object(number, place), which must not, for all.
  template <class Node, class Object>
  void take_all(Node&& node, Object&& object) {
    for (std::uint32_t w = 0; w < used_.size(); ++w) {
      while (used_[w] != 0) {
        const auto bit = static_cast<std::uint32_t>(std::countr_zero(used_[w]));
        at_ = 64 * w + bit;
        while (nodes_[at_] != end) {
          const Item item = items_[nodes_[at_]];
          nodes_[at_] = item.next;
          node(item.what);
        }
        take_objects(objects_[at_], object);
        used_[w] &= used_[w] - 1;
      }
    }
  }

  std::uint64_t bytes() const {
    return sizeof(*this) + items_.capacity() * sizeof(Item) + batch_.capacity() * sizeof(Met);
  }

 private:
  static constexpr std::uint32_t buckets = 256;
  static constexpr std::uint32_t end = 0xFFFF'FFFFu;
  struct Item {
    std::uint32_t what, next, place;
  };
  struct Met {
    std::uint32_t number, place;
  };
  using Heads = std::array<std::uint32_t, buckets>;

  /// Never before the bucket in hand.
  std::uint32_t bucket_of(double distance) const {
    const double place = distance * per_metre_;
    const std::uint32_t bucket =
        place < buckets - 1 ? (place > 0.0 ? static_cast<std::uint32_t>(place) : 0) : buckets - 1;
    return std::max(bucket, at_);
  }
  template <class Object>
  void take_objects(std::uint32_t first, Object&& object) {
    if (first == end) return;
    if (items_[first].next == end) return object(items_[first].what, items_[first].place);
    batch_.clear();
    for (std::uint32_t i = first; i != end; i = items_[i].next) batch_.push_back({items_[i].what, items_[i].place});
    std::sort(batch_.begin(), batch_.end(), [](const Met& a, const Met& b) { return a.number < b.number; });
    for (const Met& o : batch_) object(o.number, o.place);
  }
  void push(Heads& heads, std::uint32_t bucket, std::uint32_t what, std::uint32_t place) {
    const std::uint64_t bit = std::uint64_t{1} << (bucket % 64);
    std::uint64_t& word = used_[bucket / 64];
    if ((word & bit) == 0) {
      word |= bit;
      nodes_[bucket] = objects_[bucket] = end;
    }
    items_.push_back({what, heads[bucket], place});
    heads[bucket] = static_cast<std::uint32_t>(items_.size() - 1);
  }

  std::array<std::uint64_t, buckets / 64> used_{};
  Heads nodes_{}, objects_{};  // valid where the bucket's bit is set
  std::vector<Item> items_;
  std::vector<Met> batch_;
  double per_metre_ = 0.0;
  std::uint32_t at_ = 0;
};

}  // namespace gridcull
