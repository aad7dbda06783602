#include "gridcull/service/slice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "gridcull/core/view_volume.h"

namespace gridcull {
namespace {

/// Andrew's monotone chain; counter-clockwise.
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= base + 2 && cross2(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// Where the segment meets the plane; nothing when it lies on one side.
std::optional<Vec2> cut(const Vec3& a, const Vec3& b, double z) {
  if ((a.z < z) == (b.z < z)) return std::nullopt;
  const double t = (z - a.z) / (b.z - a.z);
  return Vec2(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
}

std::vector<Vec2> cut_hull(const std::vector<Vec3>& points, double z) {
  std::vector<Vec2> cuts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (const auto p = cut(points[i], points[j], z)) cuts.push_back(*p);
    }
  }
  return hull_of(std::move(cuts));
}

/// A prism that stands upright shows its outline, concave or not.
std::optional<std::vector<Vec2>> upright_outline(const std::vector<Vec3>& points, double z) {
  const std::size_t half = points.size() / 2;
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < half; ++i) {
    const Vec3 &low = points[i], &high = points[half + i];
    if (std::hypot(low.x - high.x, low.y - high.y) > 1e-9 * std::abs(high.z - low.z)) return std::nullopt;
    if ((low.z < z) == (high.z < z)) return std::vector<Vec2>{};
    outline.emplace_back(low.x, low.y);
  }
  return outline;
}

Slice cut_faces(const Faces& faces, const std::vector<Vec3>& points, double z) {
  Slice slice;
  for (const auto& triangle : faces.triangles) {
    std::vector<Vec2> ends;
    for (int i = 0; i < 3; ++i) {
      const auto corner = static_cast<std::size_t>(i);
      if (const auto p = cut(points[triangle[corner]], points[triangle[(corner + 1) % 3]], z)) ends.push_back(*p);
    }
    if (ends.size() == 2) slice.chains.push_back(std::move(ends));
  }
  return slice;
}

Slice slice_2d(const Object& object) {
  Slice slice;
  slice.centre = {object.pose.position.x, object.pose.position.y};
  if (const auto* disc = std::get_if<Disc>(&object.shape)) {
    slice.radius = disc->radius;
  } else if (is_thin(object.shape)) {
    slice.chains.push_back(world_outline(object.shape, object.pose));
  } else {
    slice.rings.push_back(world_outline(object.shape, object.pose));
  }
  return slice;
}

std::vector<Vec2> clip(const std::vector<Vec2>& polygon, const Vec2& normal, double offset) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(normal, a) - offset, db = glm::dot(normal, b) - offset;
    if (da >= 0.0) out.push_back(a);
    if ((da >= 0.0) != (db >= 0.0)) out.push_back(a + (da / (da - db)) * (b - a));
  }
  return out;
}

/// From angle `from` over `turn` radians, counter-clockwise.
std::vector<Vec2> arc(const Vec2& centre, double radius, double from, double turn) {
  const int steps = std::max(2, static_cast<int>(std::ceil(turn * 90.0 / std::numbers::pi)));
  std::vector<Vec2> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + turn * i / steps;
    points.emplace_back(centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle));
  }
  return points;
}

}  // namespace

Slice slice_of(const Object& object, double z) {
  if (dimension_of(object.shape) == 2) return slice_2d(object);
  Slice slice;
  slice.centre = {object.pose.position.x, object.pose.position.y};
  if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
    const double height = z - object.pose.position.z;
    const double squared = sphere->radius * sphere->radius - height * height;
    if (squared > 0.0) slice.radius = std::sqrt(squared);
    return slice;
  }
  const std::vector<Vec3> points = world_vertices(object.shape, object.pose);
  if (const auto* faces = std::get_if<Faces>(&object.shape)) return cut_faces(*faces, points, z);
  std::optional<std::vector<Vec2>> ring;
  if (std::holds_alternative<Prism>(object.shape)) ring = upright_outline(points, z);
  if (!ring) ring = cut_hull(points, z);
  if (ring->size() >= 3) slice.rings.push_back(std::move(*ring));
  return slice;
}

std::vector<Vec2> view_outline(const View& view, int dimension, double reach) {
  const Vec2 eye(view.pose.position.x, view.pose.position.y);
  const double radius = std::min(view.range, reach);
  constexpr double turn = 2.0 * std::numbers::pi;
  if (dimension == 2) {
    if (view.fov >= turn) return arc(eye, radius, 0.0, turn);
    std::vector<Vec2> sector = arc(eye, radius, heading_of(view.pose.orientation) - 0.5 * view.fov, view.fov);
    sector.push_back(eye);
    return sector;
  }
  std::vector<Vec2> outline = arc(eye, radius, 0.0, turn);
  if (!view.frustum) return outline;
  const ViewVolume volume(view, 3);
  const double z = view.pose.position.z;
  for (const HalfSpace& side : volume) {
    outline = clip(outline, {side.normal.x, side.normal.y}, side.offset - side.normal.z * z);
  }
  const Vec2 axis(volume.axis().x, volume.axis().y);
  const double at_eye = glm::dot(axis, eye);
  if (view.frustum->near > 0.0) outline = clip(outline, axis, at_eye + view.frustum->near);
  if (std::isfinite(view.frustum->far)) outline = clip(outline, -axis, -(at_eye + view.frustum->far));
  return outline;
}

}  // namespace gridcull
