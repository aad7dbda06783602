// Slices of concave occluders (paper section 3.3).
#pragma once

#include <vector>

#include "gridcull/core/pose.h"
#include "gridcull/methods/extended_cell.h"
#include "gridcull/methods/extended_map.h"
#include "gridcull/methods/extended_plane.h"

namespace gridcull::extended {

/// A prism over an outline that is not convex, as the shape has it.
struct ConcavePrism {
  std::vector<Vec2> outline{};  ///< merged; empty: none
  double height = 0.0;
  Vec3 position{0.0};
  Rotation turn{};
};

/// Covers, with the plane's depth, the pixels that lie wholly inside the prism: no view is shrunk and no seam between
/// convex pieces is left open. `error`: metres by which coordinates may be off. True when it covered a pixel.
bool cover_slice(const ViewCell& cell, const Facing& facing, const Plane& plane, const ConcavePrism& prism,
                 double error, DepthMap& map);

}  // namespace gridcull::extended
