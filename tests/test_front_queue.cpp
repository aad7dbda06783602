// The order that the conservative walk in 3D rests on (grid/front_queue.h): whatever a test asks about, all occluders
// that were taken before it lie nearer, strictly.
#include <algorithm>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/grid/front_queue.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

using Kind = FrontQueue::Kind;

/// A walk as the engine's: tests push tests that are no nearer, and occluders behind themselves.
class Walk {
 public:
  Walk(std::uint64_t seed, double nearest, double farthest) : dice_(seed), nearest_(nearest), farthest_(farthest) {
    queue_.begin(nearest, farthest);
    for (int i = 0; i < 40; ++i) push(Kind::node, key_from(nearest));
  }

  void run() {
    FrontQueue::Item item;
    double deepest = -std::numeric_limits<double>::infinity();  // occluder taken so far
    while (queue_.pop(item)) {
      const double key = keys_.at(item.what);
      REQUIRE(!taken_[item.what]);
      taken_[item.what] = true;
      if (item.kind == Kind::occluder) {
        deepest = std::max(deepest, key);
        continue;
      }
      REQUIRE(deepest < key);
      if (keys_.size() < 3000) spawn(key);
    }
    for (const bool taken : taken_) CHECK(taken);
    CHECK(!queue_.any_tests());
  }

 private:
  // Few different steps: many keys are equal, or lie in one bucket, or beyond the last one.
  double key_from(double key) {
    static constexpr double steps[] = {0.0, 0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.5};
    return key + steps[dice_.below(8)] * (farthest_ - nearest_);
  }
  void spawn(double key) {
    static constexpr Kind tests[] = {Kind::node, Kind::group, Kind::volume, Kind::object, Kind::slice};
    for (std::uint32_t i = dice_.below(4); i > 0; --i) push(tests[dice_.below(5)], key_from(key));
    for (std::uint32_t i = dice_.below(3); i > 0; --i) push(Kind::occluder, key_from(key));
  }
  void push(Kind kind, double key) {
    queue_.push(kind, key, keys_.size());
    keys_.push_back(key);
    taken_.push_back(false);
  }

  Random dice_;
  FrontQueue queue_;
  double nearest_, farthest_;
  std::vector<double> keys_;
  std::vector<bool> taken_;
};

}  // namespace

TEST_CASE("no test meets an occluder that is not nearer than what it asks about") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Walk(seed, 0.0, 100.0).run();
    Walk(seed, 37.25, 37.5).run();
    Walk(seed, 5.0, 5.0).run();  // one bucket holds all
  }
}

TEST_CASE("an occluder waits for the tests of its own bucket, those that come last too") {
  FrontQueue queue;
  queue.begin(0.0, 2047.0);  // a bucket a metre
  queue.push(Kind::occluder, 10.0, 1);
  queue.push(Kind::object, 10.9, 2);
  FrontQueue::Item item;
  REQUIRE(queue.pop(item));
  CHECK(item.what == 2);
  queue.push(Kind::slice, 10.95, 3);
  queue.push(Kind::object, 3.0, 4);  // nearer than the bucket in hand: at once
  for (const std::uint64_t what : {4, 3, 1}) {
    REQUIRE(queue.pop(item));
    CHECK(item.what == what);
  }
  CHECK(!queue.pop(item));
}

}  // namespace gridcull::test
