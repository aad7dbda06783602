// SUMO's polygons (poly.xml) as static objects.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gridcull/sim/scene.h"

namespace gridcull {

/// The polygons whose type begins with "building", ids from 0 in file order, names SUMO's. A polygon with
/// fewer than three distinct points is skipped with a line in `notes`, one whose bounding box does not meet
/// `box` (x0, y0, x1, y1) silently. Throws Error(io), Error(bad_message).
/// `heights`: for each object the polygon's <param key="height" value="metres"/>, 0 without one.
std::vector<SceneObject> read_sumo_buildings(const std::string& path, const std::optional<std::array<double, 4>>& box,
                                             std::vector<std::string>& notes, std::vector<double>& heights);

}  // namespace gridcull
