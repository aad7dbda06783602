// An office building on the ground plan: corridors with rooms on both sides, doors, columns in the hall.
#pragma once

#include <vector>

#include <gridcull/core/vec.h>

/// An upright box that nobody walks or sees through; metres.
struct Wall {
  gridcull::Vec2 min, max;
  gridcull::Vec2 centre() const { return 0.5 * (min + max); }
  gridcull::Vec2 size() const { return max - min; }
};

struct FloorPlan {
  double width = 0.0, depth = 0.0;  ///< metres; from (0, 0)
  std::vector<Wall> walls{};
  std::vector<gridcull::Vec2> rooms{};  ///< the middle of each
};

/// `corridors` run along x with `rooms` on either side; a hall in the west and a corridor in the east join them.
FloorPlan make_floor_plan(int corridors, int rooms);
