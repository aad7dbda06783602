// Worlds that go to a limit, for `gridcull bench --stability`: where does a method miss, go loose, go slow?
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull {

/// What moves in one frame, and who asks.
struct LimitFrame {
  double time = 0.0;  ///< seconds
  std::vector<std::pair<ObjectId, Pose>> moved{};
  std::vector<View> views{};
};

/// A small world, played out.
struct LimitWorld {
  int dimension = 2;
  std::vector<Object> objects{};
  std::vector<LimitFrame> frames{};
  Bounds bounds{};
  double cell = 1.0;  ///< metres
};

/// Something that goes to its limit, value by value.
struct Limit {
  std::string name{};            ///< "wall thickness"
  std::string quantity{};        ///< what the values are, with their unit: "metres"
  std::vector<double> values{};  ///< from harmless to extreme
  LimitWorld (*make)(double value, int dimension) = nullptr;
  bool flicker = false;  ///< answers that change from frame to frame are the question here
};

/// All of them, two at once behind those alone; each takes 2D and 3D.
std::span<const Limit> stability_limits();

}  // namespace gridcull
