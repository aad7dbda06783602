// Claim (sections). A ray at the angle t from the centre enters the ball of radius r at distance D at
// D cos t - sqrt(r^2 - D^2 sin^2 t), which grows with t. On the tangent cone of the concentric ball of radius f r,
// D sin t = f r, it is sqrt(D^2 - f^2 r^2) - r sqrt(1 - f^2): the greatest within that cone, so every ray of the cone
// has entered by then. The radius is taken a little less (2^-40 relative: D and r may be off by 2^-50), the key a
// little more: it is a difference of two numbers up to D with a relative error of some 2^-50 each; 2^-40 D covers both,
// and what the truth's rounding of r inside the second root makes, sqrt(2^-49) r when f = 1: so the root is not taken
// there. For f < 1: d sqrt(1 - f^2) = f / sqrt(1 - f^2) df, below 2^-40 for f <= 1 - 2^-20.
//
// Claim (slices). Entrance at distance k and angle t: r^2 = D^2 + k^2 - 2 D k cos t, so cos t = (D^2 + k^2 - r^2) / (2
// D k) for k from D - r to sqrt(D^2 - r^2); D sin t is the radius asked for. With c = D cos t = ((D - r)(D + r) + k^2)
// / (2 k), D sin t = sqrt((D - c)(D + c)), and D - c = (r^2 - (D - k)^2) / (2 k) = (r - D + k)(r + D - k) / (2 k)
// without cancellation but in r - D + k, whose absolute error is some 2^-50 D: it is raised by 2^-44 D.
#include "gridcull/grid/ball_sections.h"

#include <algorithm>
#include <cmath>

#include "gridcull/grid/sight.h"

namespace gridcull {
namespace {

/// Nearer than this to the surface, relative to the distance, the cone is too open to be drawn.
constexpr double least_gap = 0x1p-16;

}  // namespace

int ball_sections(double distance, double radius, std::span<const double> fractions, std::span<BallSection> out) {
  if (!(radius > 0.0 && distance - radius > least_gap * distance)) return 0;
  int count = 0;
  for (const double fraction : fractions) {
    const double f = fraction < 1.0 - 0x1p-20 ? fraction : 1.0;
    const double inner = f * radius;
    const double tangent = std::sqrt((distance - inner) * (distance + inner));
    const double depth = radius * std::sqrt((1.0 - f) * (1.0 + f));
    out[static_cast<std::size_t>(count++)] = {inner * (1.0 - 0x1p-40), tangent - depth + 0x1p-40 * distance};
  }
  return count;
}

double ball_slice_radius(double distance, double radius, double far) {
  if (!(distance > radius)) return radius * (1.0 + 0x1p-40);
  const double tangent_square = (distance - radius) * (distance + radius);
  if (!(far * far < tangent_square)) return radius * (1.0 + 0x1p-40);
  const double past = radius - distance + far + 0x1p-44 * distance;  // beyond the nearest point
  if (!(past > 0.0 && far > 0.0)) return 0.0;
  const double short_of = past * (radius + distance - far) / (2.0 * far);  // D - c
  const double square = short_of * (2.0 * distance - short_of);
  return std::min(std::sqrt(std::max(0.0, square)) * (1.0 + 0x1p-40), radius * (1.0 + 0x1p-40));
}

std::array<double, 2> ball_entrance(double distance, double radius) {
  if (!(distance > radius)) return {0.0, 0.0};
  const double tangent = std::sqrt((distance - radius) * (distance + radius));
  return {std::max(0.0, distance - radius - 0x1p-48 * distance), rounded_up(tangent) + 0x1p-40 * distance};
}

}  // namespace gridcull
