// The calendar of expiries against a plain list, with frame steps that change by orders of magnitude.
#include <algorithm>
#include <map>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/grid/expiry_queue.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {

TEST_CASE("the calendar pops what has expired, whatever the steps") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    ExpiryQueue queue;
    constexpr Slot slots = 300;
    queue.reserve(slots);
    std::map<Slot, double> waiting;
    double now = random.uniform(-1e3, 1e6);
    double step = 0.1;
    for (int frame = 0; frame < 200; ++frame) {
      // Steps stay for a while, then change: from a nanosecond to months.
      if (frame % 25 == 24) step = std::ldexp(1.0, static_cast<int>(random.uniform(-30, 24)));
      now += step;
      std::vector<Slot> popped;
      queue.pop_expired(now, popped);
      std::vector<Slot> truth;
      for (const auto& [slot, expiry] : waiting) {
        if (expiry < now) truth.push_back(slot);
      }
      REQUIRE(popped == truth);
      for (const Slot slot : popped) waiting.erase(slot);
      for (int i = 0; i < 8; ++i) {
        const Slot slot = static_cast<Slot>(random.uniform(0, slots - 1e-9));
        if (waiting.contains(slot)) {
          queue.erase(slot);
          waiting.erase(slot);
        }
        const double expiry = now + step * random.uniform(0, 40);
        queue.push(slot, expiry);
        waiting[slot] = expiry;
      }
    }
  }
}

}  // namespace gridcull::test
