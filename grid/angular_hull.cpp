// A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979, in the gnomonic projection,
// which takes cones to convex sets.
#include "gridcull/grid/angular_hull.h"

#include <algorithm>
#include <cmath>

namespace gridcull {
namespace {

/// Two axes that with `axis` make a right-handed frame; not normalised: a hull does not mind a linear map.
void frame_about(const Vec3& axis, Vec3& u, Vec3& v) {
  const Vec3 size = glm::abs(axis);
  const Vec3 least = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                     : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                          : Vec3(0, 0, 1);
  u = glm::cross(least, axis);
  v = glm::cross(axis, u);
}

}  // namespace

bool angular_hull(std::span<SeenPoint> points, const Vec3& axis, Outline& out) {
  out.count = 0;
  Vec3 u, v;
  frame_about(axis, u, v);
  for (SeenPoint& p : points) {
    const double depth = glm::dot(axis, p.point);
    p.seen = Vec2(glm::dot(u, p.point), glm::dot(v, p.point)) / depth;
  }
  std::sort(points.begin(), points.end(), [](const SeenPoint& a, const SeenPoint& b) {
    return a.seen.x < b.seen.x || (a.seen.x == b.seen.x && a.seen.y < b.seen.y);
  });
  std::array<std::uint8_t, most_seen_points + 1> hull;  // the first point twice
  std::size_t count = 0;
  const auto add = [&](std::size_t i, std::size_t base) {
    const auto turns = [&] {
      const Vec2 a = points[hull[count - 2]].seen, b = points[hull[count - 1]].seen;
      return cross2(b - a, points[i].seen - a) > 0.0;
    };
    while (count >= base + 2 && !turns()) --count;
    hull[count++] = static_cast<std::uint8_t>(i);
  };
  for (std::size_t i = 0; i < points.size(); ++i) add(i, 0);
  const std::size_t base = --count;
  for (std::size_t i = points.size(); i-- > 0;) add(i, base);
  --count;
  if (count > Outline::max_rays) return false;
  for (std::size_t i = 0; i < count; ++i) out.rays[i] = points[hull[i]].point;
  out.count = static_cast<int>(count);
  return true;
}

}  // namespace gridcull
