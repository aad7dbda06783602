// Wall-clock time of the phases of a frame.
#pragma once

#include <chrono>
#include <utility>

namespace gridcull {

class Lap {
 public:
  /// Microseconds since it was last asked, or made.
  double next() {
    const auto now = Clock::now();
    return std::chrono::duration<double, std::micro>(now - std::exchange(last_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace gridcull
