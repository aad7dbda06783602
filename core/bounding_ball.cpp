// Rounding: a distance is off by less than 2^-50 of itself and 2^-52 of the coordinates that went in; `radius` is
// rounded up by 2^-48 of both.
#include "gridcull/core/bounding_ball.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/slabs.h"

namespace gridcull {
namespace {

constexpr int steps = 200;

double square(const Vec3& v) { return glm::dot(v, v); }

/// Square of the greatest distance.
double reach(std::span<const Vec3> points, const Vec3& centre) {
  double most = 0.0;
  for (const Vec3& p : points) most = std::max(most, square(p - centre));
  return most;
}

/// Each step goes to the farthest point, by a smaller part each time.
Vec3 centre_of_few(std::span<const Vec3> points, Vec3 centre) {
  for (int i = 0; i < steps; ++i) {
    const auto far = std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
      return square(a - centre) < square(b - centre);
    });
    centre += (*far - centre) / static_cast<double>(i + 2);
  }
  return centre;
}

}  // namespace

Ball ball_around(std::span<const Vec3> points) {
  const Extremes ends = extremes_of(points);
  std::vector<Vec3> few;
  for (const std::uint32_t i : ends.lowest) few.push_back(points[i]);
  for (const std::uint32_t i : ends.highest) few.push_back(points[i]);
  Bounds box;
  for (const Vec3& p : few) box.add(p);
  const Vec3 middle = box.centre(), better = centre_of_few(few, middle);
  const double at_middle = reach(points, middle), at_better = reach(points, better);
  Ball ball{at_better < at_middle ? better : middle, std::sqrt(std::min(at_middle, at_better))};
  const Vec3 low = glm::abs(box.min), high = glm::abs(box.max);
  const double size = std::max({low.x, low.y, low.z, high.x, high.y, high.z});
  ball.radius += 0x1p-48 * (ball.radius + size);
  return ball;
}

}  // namespace gridcull
