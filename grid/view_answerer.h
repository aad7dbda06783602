// Answers one view at a time on a frozen world. Each thread has one and reuses it.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/core/drawing.h"
#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

struct GridWorld;

/// What one view tells the engine beside its answer.
struct ViewResult {
  std::vector<Slot> seen;      ///< the answer, as slots
  std::vector<Slot> revealed;  ///< hidden objects whose temporal bounding volume this view found visible
  double traverse_us = 0, occlude_us = 0, collect_us = 0;
};

class ViewAnswerer {
 public:
  virtual ~ViewAnswerer() = default;
  /// Throws as ViewVolume does, and what the PositionSource throws. `draw` may be nullptr. Writes nothing that
  /// viewers share but poses that it reads and notes of what was seen.
  virtual void run(GridWorld& world, const View& view, Answer& answer, ViewResult& result, DrawSink* draw) = 0;
  virtual std::uint64_t bytes() const = 0;
};

}  // namespace gridcull
