// Wall-clock microseconds of a phase, added up over its parts.
#pragma once

#include <chrono>

namespace gridcull {

class Stopwatch {
 public:
  void start() { begin_ = std::chrono::steady_clock::now(); }
  void stop() { sum_ += std::chrono::steady_clock::now() - begin_; }
  void clear() { sum_ = {}; }
  double microseconds() const { return std::chrono::duration<double, std::micro>(sum_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_{};
  std::chrono::steady_clock::duration sum_{};
};

}  // namespace gridcull
