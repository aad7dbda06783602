#include "gridcull/core/simplex.h"

#include <algorithm>
#include <cmath>

#include "gridcull/core/predicates.h"

namespace gridcull {
namespace {

constexpr std::uint32_t nothing = 0xFFFF'FFFFu;

/// Coordinates in which three points are not on one line; x == y where they are.
std::array<int, 2> spread_axes(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (const auto& [x, y] : {std::array{0, 1}, std::array{1, 2}, std::array{2, 0}}) {
    if (orientation(planar(a, x, y), planar(b, x, y), planar(c, x, y)) != 0) return {x, y};
  }
  return {0, 0};
}

/// The point with the greatest measure.
template <class Measure>
std::uint32_t farthest(std::span<const Vec3> points, const Measure& measure) {
  std::uint32_t best = 0;
  double most = -1.0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double m = measure(points[i]);
    if (m > most) most = m, best = i;
  }
  return best;
}

/// The first of a likely point and all points for which `good` holds.
template <class Good>
std::uint32_t likely_or_any(std::span<const Vec3> points, std::uint32_t likely, const Good& good) {
  if (good(likely)) return likely;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (good(i)) return i;
  }
  return nothing;
}

}  // namespace

Simplex simplex_of(std::span<const Vec3> points) {
  Simplex s;
  const Vec3 a = points[0];
  const std::uint32_t b = farthest(points, [&](const Vec3& p) { return glm::length(p - a); });
  if (points[b] == a) return s;
  const Vec3 along = glm::normalize(points[b] - a);
  const std::uint32_t c =
      likely_or_any(points, farthest(points, [&](const Vec3& p) { return glm::length(glm::cross(along, p - a)); }),
                    [&](std::uint32_t i) {
                      const auto axes = spread_axes(a, points[b], points[i]);
                      return axes[0] != axes[1];
                    });
  s.at = {0, b, c, 0};
  s.rank = 1;
  if (c == nothing) return s;
  s.axes = spread_axes(a, points[b], points[c]);
  const Vec3 normal = glm::cross(points[b] - a, points[c] - a);
  const std::uint32_t d =
      likely_or_any(points, farthest(points, [&](const Vec3& p) { return std::fabs(glm::dot(normal, p - a)); }),
                    [&](std::uint32_t i) { return orientation(a, points[b], points[c], points[i]) != 0; });
  s.rank = 2;
  if (d == nothing) return s;
  s.rank = 3;
  s.at = orientation(a, points[b], points[c], points[d]) < 0 ? std::array<std::uint32_t, 4>{0, b, c, d}
                                                             : std::array<std::uint32_t, 4>{0, c, b, d};
  return s;
}

// About the centroid: heights over the sides are off by some 2^-48 of the coordinates, so 2^-20 of a radius that is at
// least 2^-20 of them is more than enough.
Ball ball_inside(std::span<const Vec3> points, int dimension) {
  const Simplex s = simplex_of(points);
  if (s.rank < dimension) return {};
  const auto corners = static_cast<std::size_t>(dimension + 1);
  Ball ball;
  double size = 0.0;
  for (std::size_t i = 0; i < corners; ++i) ball.centre += points[s.at[i]] / static_cast<double>(corners);
  for (const Vec3& p : points) size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  ball.radius = size;
  for (std::size_t i = 0; i < corners; ++i) {
    const Vec3 &a = points[s.at[i]], &b = points[s.at[(i + 1) % corners]];
    const Vec3 side = dimension == 2 ? Vec3(0.0, 0.0, 1.0) : points[s.at[(i + 2) % corners]] - a;
    ball.radius = std::min(ball.radius, std::fabs(glm::dot(unit(glm::cross(b - a, side)), ball.centre - a)));
  }
  ball.radius *= 1.0 - 0x1p-20;
  return ball.radius > 0x1p-20 * size ? ball : Ball{};
}

}  // namespace gridcull
