// Edges of a shadow from plane to plane: value * n / k for n = k + 1, k + 2, ..., rounded to whole cells, a
// step at a time and without dividing (Bresenham's error term).
#pragma once

#include <cstdint>

#include "gridcull/grid/division.h"

namespace gridcull {

/// floor(value * n / k), k > 0.
class ScaledDown {
 public:
  ScaledDown(std::int64_t value, std::int64_t k)
      : k_(k), at_(value), step_(floor_div(value, k)), part_(value - step_ * k) {}

  /// For n = k + 1 at the first call.
  std::int64_t next() {
    at_ += step_;
    rest_ += part_;
    if (rest_ >= k_) {
      rest_ -= k_;
      ++at_;
    }
    return at_;
  }

 protected:
  bool whole() const { return rest_ == 0; }

 private:
  std::int64_t k_, at_, step_, part_, rest_ = 0;
};

/// ceil(value * n / k), k > 0.
class ScaledUp : private ScaledDown {
 public:
  using ScaledDown::ScaledDown;

  std::int64_t next() {
    const std::int64_t down = ScaledDown::next();
    return down + (whole() ? 0 : 1);
  }
};

}  // namespace gridcull
