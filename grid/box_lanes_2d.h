// Boxes with sides along the axes, and eight of them side by side, as a loop over lanes takes them.
#pragma once

#include <array>
#include <cstddef>

#include "gridcull/core/vec.h"

namespace gridcull {

/// Metres; low <= high.
struct Box2D {
  Vec2 low{0.0}, high{0.0};
};

struct BoxLanes {
  static constexpr std::size_t count = 8;
  using Lanes = std::array<double, count>;
  Lanes low_x{}, low_y{}, high_x{}, high_y{};

  Box2D box(std::size_t lane) const { return {{low_x[lane], low_y[lane]}, {high_x[lane], high_y[lane]}}; }
  void set(std::size_t lane, const Box2D& box) {
    low_x[lane] = box.low.x, low_y[lane] = box.low.y;
    high_x[lane] = box.high.x, high_y[lane] = box.high.y;
  }
};

}  // namespace gridcull
