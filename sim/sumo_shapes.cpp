#include "gridcull/sim/sumo_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gridcull/core/trigonometry.h"

namespace gridcull {

double sumo_heading(double angle) {
  double turned = std::fmod(90.0 - angle, 360.0);
  if (turned <= -180.0) turned += 360.0;
  if (turned > 180.0) turned -= 360.0;
  return turned * (std::numbers::pi / 180.0);
}

Vec3 vehicle_middle(const Vec3& front, double heading, double length) {
  const SinCos turn = stable_sincos(heading);
  return front - 0.5 * length * Vec3(turn.cos, turn.sin, 0.0);
}

bool is_sumo_building(std::string_view type) { return type.starts_with("building"); }

std::size_t distinct_points(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(), [](auto& a, auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  return static_cast<std::size_t>(std::unique(points.begin(), points.end()) - points.begin());
}

std::optional<SceneObject> sumo_building(const std::vector<Vec2>& outline, const std::string& name) {
  std::vector<Vec2> vertices = merged_outline(outline);
  if (distinct_points(vertices) < 3) return std::nullopt;
  Bounds around;
  for (const Vec2& p : vertices) around.add({p.x, p.y, 0.0});
  // Vertices about a position of whole metres in the middle: near the origin's size the differences, and the
  // sums that give them back, are then exact, so shared walls stay shared.
  SceneObject out;
  const Vec3 middle = around.centre();
  out.object.pose.position = {std::floor(middle.x), std::floor(middle.y), 0.0};
  for (Vec2& p : vertices) p -= Vec2(out.object.pose.position);
  out.object.shape = Polygon{std::move(vertices)};
  out.object.is_static = true;
  out.name = name;
  return out;
}

}  // namespace gridcull
