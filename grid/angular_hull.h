// Convex hull of directions.
#pragma once

#include <span>

#include "gridcull/grid/piece_silhouette.h"

namespace gridcull {

/// A point and where it is seen in the plane dot(axis, p) = 1.
struct SeenPoint {
  Vec3 point;
  Vec2 seen;
};

inline constexpr std::size_t most_seen_points = 3 * Outline::max_rays;

/// The loop of those points whose directions span the cone of all, turned as Outline says; fewer than three when the
/// cone is flat. False, and no loop, when it has more than Outline::max_rays. `axis` has dot(axis, p) > 0 for all
/// points; at most most_seen_points of them. The points are reordered. Rounded: a direction left out lies outside the
/// loop by at most some 2^-48 of the points' spread. `nearest` and `farthest` are left to the caller.
bool angular_hull(std::span<SeenPoint> points, const Vec3& axis, Outline& out);

}  // namespace gridcull
