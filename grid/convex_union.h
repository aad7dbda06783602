// The union of two flat convex polygons where it is one again.
#pragma once

#include <optional>

#include "gridcull/grid/flat_polygons.h"

namespace gridcull {

/// Exactly in one plane, and each point a corner of the hull of all.
bool is_flat_and_convex(const FlatPolygon& polygon);

/// The union of two such when they lie in one plane, it is convex, and neither holds the other; decided exactly on the
/// points as given. The corners are corners of the two.
std::optional<FlatPolygon> convex_union(const FlatPolygon& a, const FlatPolygon& b);

}  // namespace gridcull
