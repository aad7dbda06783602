#include "gridcull/core/exact_2d_walls.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/predicates.h"
#include "gridcull/core/trigonometry.h"

namespace gridcull::exact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Throws Error(bad_frame) unless the view's numbers are as core/view.h says.
void check(const View& view) {
  const auto refuse = [&](const char* what) {
    throw Error(ErrorCode::bad_frame, "viewer " + std::to_string(view.viewer) + ": " + what);
  };
  const Vec3& p = view.pose.position;
  if (!(std::fabs(p.x) <= 1e9 && std::fabs(p.y) <= 1e9)) refuse("expected a position of magnitude at most 1e9");
  if (!(view.range > 0.0)) refuse("expected a range above 0");
  if (!(view.fov > 0.0 && view.fov <= 2.0 * std::numbers::pi)) refuse("expected a field of view of 0 .. 360 degrees");
}

Sector sector_of(const View& view) {
  if (view.fov >= 2.0 * std::numbers::pi) return {};
  const Vec3 axis = rotation_of(view.pose.orientation).x;
  const SinCos half = stable_sincos(0.5 * view.fov);
  const Vec2 clockwise(axis.x * half.cos + axis.y * half.sin, axis.y * half.cos - axis.x * half.sin);
  const Vec2 counter(axis.x * half.cos - axis.y * half.sin, axis.y * half.cos + axis.x * half.sin);
  const double from = turn_of(clockwise);
  return {from, turns_between(from, turn_of(counter))};
}

/// Neither without width (tiny and far) nor, by rounding, with an end a bit before its beginning: no wall spans more
/// than half a turn.
bool has_width(const Sector& span) { return span.width > 0.0 && span.width <= 2.0 + 1e-9; }

double distance_to_segment(const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double square = glm::dot(along, along);
  if (!(square > 0.0)) return glm::length(a);
  const double t = std::clamp(-glm::dot(a, along) / square, 0.0, 1.0);
  return std::min({glm::length(a + t * along), glm::length(a), glm::length(b)});
}

class Builder {
 public:
  explicit Builder(const View& view) : view_(view), eye_(view.pose.position) {
    out_.sector = sector_of(view);
    out_.range = view.range;
    out_.magnitude = std::max(std::fabs(eye_.x), std::fabs(eye_.y));
  }

  void add(const Object& object) {
    if (object.id == view_.rides) return;
    if (dimension_of(object.shape) != 2) {
      throw Error(ErrorCode::bad_scene, "object " + std::to_string(object.id) + ": expected a 2D shape");
    }
    const Vec2 middle = Vec2(object.pose.position) - eye_;
    const double reach = reach_of(object.shape);
    if (glm::length(middle) - reach > out_.range * (1.0 + tie) + tie * out_.magnitude) return;
    if (const auto* disc = std::get_if<Disc>(&object.shape)) {
      add_disc(object, middle, disc->radius);
    } else {
      add_outline(object, world_outline(object.shape, object.pose));
    }
  }

  Surroundings finish() { return std::move(out_); }

 private:
  void add_disc(const Object& object, const Vec2& centre, double radius) {
    const double distance = glm::length(centre);
    const double gap = distance - radius;
    if (gap < -tie * (out_.magnitude + radius)) {
      out_.containers.push_back(object.id);
      return;
    }
    Wall wall{};
    wall.a = centre;
    wall.radius = radius;
    wall.power = std::max(0.0, gap) * (distance + radius);
    wall.slack = rounding * (out_.magnitude + distance + radius) * radius;
    wall.nearest = std::max(0.0, gap);
    if (wall.nearest > out_.range) return;
    // Tangents: the centre's direction turned by asin(radius / distance), without trigonometry.
    const double tangent = std::sqrt(wall.power);
    const Vec2 left(-centre.y, centre.x);
    const double from = turn_of(tangent * centre - radius * left);
    wall.span = {from, turns_between(from, turn_of(tangent * centre + radius * left))};
    if (!has_width(wall.span) || !out_.sector.meets(wall.span)) return;
    wall.body = open_body(object, BodyKind::disc, wall.nearest);
    out_.walls.push_back(wall);
  }

  void add_outline(const Object& object, const std::vector<Vec2>& outline) {
    const bool thin = is_thin(object.shape);
    const std::uint32_t body = open_body(object, thin ? BodyKind::thin : BodyKind::solid, infinity);
    const std::size_t walls_before = out_.walls.size();
    double extent = 0.0;
    bool inside = false;
    Body& b = out_.bodies.back();
    for (std::size_t i = thin ? 1 : 0; i < outline.size(); ++i) {
      const Vec2 &p = outline[i == 0 ? outline.size() - 1 : i - 1], &q = outline[i];
      const double nearest = distance_to_segment(p - eye_, q - eye_);
      const int side = orientation(p, q, eye_);
      const double size = glm::length(q - eye_);
      extent = std::max(extent, size);
      b.nearest = std::min(b.nearest, nearest);
      // Even-odd: the ray to +x crosses walls that pass from below the viewer (or level) to above.
      if ((p.y > eye_.y) != (q.y > eye_.y) && side == (q.y > p.y ? 1 : -1)) inside = !inside;
      if (side != 0) add_straight(side > 0 ? p - eye_ : q - eye_, side > 0 ? q - eye_ : p - eye_, nearest, body);
    }
    const double blur = tie * (out_.magnitude + extent);
    if (!thin && inside && b.nearest > blur) out_.containers.push_back(object.id);
    if ((!thin && inside && b.nearest > blur) || b.nearest > out_.range || out_.walls.size() == walls_before) {
      out_.walls.resize(walls_before);
      out_.bodies.pop_back();
      return;
    }
  }

  /// From a to b counter-clockwise about the viewer.
  void add_straight(const Vec2& a, const Vec2& b, double nearest, std::uint32_t body) {
    Wall wall{};
    wall.a = a;
    wall.along = b - a;
    wall.power = std::max(0.0, cross2(a, wall.along));
    wall.slack = rounding * (out_.magnitude + std::max(glm::length(a), glm::length(b))) * glm::length(wall.along);
    wall.nearest = nearest;
    wall.span.from = turn_of(a);
    wall.span.width = turns_between(wall.span.from, turn_of(b));
    wall.body = body;
    if (has_width(wall.span) && out_.sector.meets(wall.span)) out_.walls.push_back(wall);
  }

  std::uint32_t open_body(const Object& object, BodyKind kind, double nearest) {
    out_.bodies.push_back({object.id, kind, object.occluder, nearest});
    return static_cast<std::uint32_t>(out_.bodies.size() - 1);
  }

  const View& view_;
  Vec2 eye_;
  Surroundings out_{};
};

}  // namespace

Surroundings look_around(std::span<const Object> world, const View& view) {
  check(view);
  Builder builder(view);
  for (const Object& object : world) builder.add(object);
  return builder.finish();
}

}  // namespace gridcull::exact
