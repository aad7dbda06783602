#include "gridcull/grid/outline_2d.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gridcull/grid/outline_parts.h"

namespace gridcull {
namespace {

/// Covers the orientation's 1e-9 off unit length and all roundings.
constexpr double rounded_up = 1.0 + 1e-8;

double area(std::span<const Vec2> points) {
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += cross2(points[i] - points[0], points[(i + 1) % points.size()] - points[0]);
  }
  return sum;
}

}  // namespace

Outline2D::Outline2D(const Shape& shape) : closed_(!is_thin(shape)), points_(world_outline(shape, Pose{})) {
  Vec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const Vec2& p : points_) low = glm::min(low, p), high = glm::max(high, p);
  middle_ = 0.5 * (low + high);
  for (const Vec2& p : points_) radius_ = std::max(radius_, glm::length(p - middle_));
  radius_ = radius_ * rounded_up + 1e-8 * glm::length(middle_);
  if (const auto* box = std::get_if<Rectangle>(&shape)) {
    clearance_ = std::min(box->size.x, box->size.y);
  } else if (closed_) {
    judge();
  } else {
    clearance_ = std::numeric_limits<double>::infinity();
  }
}

void Outline2D::judge() {
  const double least = 1e-5 * radius_;
  clearance_ = clearance_of(points_, 1e-2 * radius_);
  clean_ = clearance_ > least;
  counter_clockwise_ = area(points_) > 0.0;
  if (clean_) return;
  clearance_ = least;
  usable_parts(points_, least, parts_);
}

// The same operations as world_outline(), so the same points.
void Outline2D::place(const Pose& pose, Vec2* out) const {
  const Rotation r = rotation_of(pose.orientation);
  for (const Vec2& p : points_) *out++ = Vec2(to_world(pose, r, {p.x, p.y, 0.0}));
}

}  // namespace gridcull
