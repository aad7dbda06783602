// Margins: every dot product here is a sum of at most three products of doubles, so its rounding error is
// below 4 ulp of (sum of the magnitudes) <= 1e-15 * (|normal| |p| + |offset|); slack() is ten times that.
#include "gridcull/core/view_volume.h"

#include <cmath>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/hull.h"
#include "gridcull/core/mesh.h"
#include "gridcull/core/trigonometry.h"
#include "gridcull/core/volume.h"
#include "gridcull/core/world_points.h"

namespace gridcull {
namespace {

double slack(const Vec3& a, const Vec3& b) {
  return 1e-14 * (std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z) + std::fabs(b.x) + std::fabs(b.y) + std::fabs(b.z));
}

[[noreturn]] void refuse(const View& view, const char* what) {
  throw Error(ErrorCode::bad_frame, "viewer " + std::to_string(view.viewer) + ": " + what);
}

void check(const View& view, int dimension) {
  const Vec3& p = view.pose.position;
  if (!(std::fabs(p.x) <= 1e9 && std::fabs(p.y) <= 1e9 && std::fabs(p.z) <= 1e9)) {
    refuse(view, "expected a finite position of magnitude at most 1e9");
  }
  const Quat& q = view.pose.orientation;
  if (!(std::fabs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 1e-9)) {
    refuse(view, "expected an orientation of length 1");
  }
  if (!(view.range > 0.0)) refuse(view, "expected a range above 0");
  if (dimension == 2) {
    if (p.z != 0.0) refuse(view, "expected z = 0 in 2D");
    if (!(view.fov > 0.0 && view.fov <= 2.0 * std::numbers::pi))
      refuse(view, "expected a field of view above 0 and at most 360 degrees");
    return;
  }
  if (!view.frustum) return;
  const Frustum& f = *view.frustum;
  if (!(f.fov_y > 0.0 && f.fov_y < std::numbers::pi)) refuse(view, "expected fov_y above 0 and below 180 degrees");
  // Flatter or steeper pyramids would leave the doubles' range in the normals of their sides.
  if (!(f.aspect >= 1e-6 && f.aspect <= 1e6)) refuse(view, "expected an aspect of 1e-6 to 1e6");
  if (!(f.near >= 0.0 && std::isfinite(f.near))) refuse(view, "expected near at least 0");
  if (!(f.far > f.near)) refuse(view, "expected far above near");
}

}  // namespace

ViewVolume::ViewVolume(const View& view, int dimension)
    : dimension_(dimension),
      apex_(view.pose.position),
      range_(view.range),
      far_(std::numeric_limits<double>::infinity()) {
  check(view, dimension);
  const Rotation r = rotation_of(view.pose.orientation);
  axis_ = r.x;
  const auto side = [&](const Vec3& local) {
    const Vec3 n = glm::normalize(r * local);
    side_[static_cast<std::size_t>(sides_++)] = {n, glm::dot(n, apex_)};
  };
  if (dimension == 2) {
    if (view.fov >= 2.0 * std::numbers::pi) return;
    const SinCos half = stable_sincos(0.5 * view.fov);
    side({half.sin, half.cos, 0.0});
    side({half.sin, -half.cos, 0.0});
    convex_ = view.fov <= std::numbers::pi;
    return;
  }
  if (!view.frustum) return;
  const SinCos half = stable_sincos(0.5 * view.frustum->fov_y);
  const double tangent_y = half.sin / half.cos;
  const double tangent_x = tangent_y * view.frustum->aspect;
  side({tangent_x, 1.0, 0.0});
  side({tangent_x, -1.0, 0.0});
  side({tangent_y, 0.0, 1.0});
  side({tangent_y, 0.0, -1.0});
  near_ = view.frustum->near;
  far_ = view.frustum->far;
}

template <class Support>
bool ViewVolume::may_touch_support(const Support& support) const {
  // support(n): an upper bound of dot(n, p - apex) over the shape's points.
  bool outside_all = sides_ > 0;
  for (const HalfSpace& h : *this) {
    const bool outside = support(h.normal) < 0.0;
    if (outside && convex_) return false;
    outside_all = outside_all && outside;
  }
  if (outside_all) return false;
  if (near_ > 0.0 && support(axis_) < near_) return false;
  if (std::isfinite(far_) && -support(-axis_) > far_) return false;
  return true;
}

bool ViewVolume::may_touch_ball(const Vec3& centre, double radius) const {
  const Vec3 d = centre - apex_;
  const double margin = slack(centre, apex_) + 1e-14 * radius;
  if (std::isfinite(range_) && glm::length(d) - radius > range_ * (1.0 + 1e-14) + margin) return false;
  return may_touch_support([&](const Vec3& n) { return glm::dot(n, d) + radius + margin; });
}

bool ViewVolume::may_touch(const Shape& shape, const Pose& pose) const {
  if (!may_touch_ball(pose.position, reach_of(shape))) return false;
  if (std::holds_alternative<Disc>(shape) || std::holds_alternative<Sphere>(shape)) return true;
  const Rotation r = rotation_of(pose.orientation);
  const bool touches = may_touch_support([&](const Vec3& n) {
    double best = -std::numeric_limits<double>::infinity();
    for_each_local_point(shape, [&](const Vec3& local) {
      Vec3 p = to_world(pose, r, local);
      if (dimension_ == 2) p.z = 0.0;
      best = std::max(best, glm::dot(n, p - apex_) + slack(p, apex_));
    });
    return best;
  });
  if (!touches) return false;
  if (dimension_ == 3 || !std::isfinite(range_)) return true;
  const double margin = slack(pose.position, apex_) + 1e-14 * reach_of(shape);
  return distance_2d({apex_.x, apex_.y}, shape, pose) <= range_ * (1.0 + 1e-14) + margin;
}

namespace {

double distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 e = b - a;
  const double square = glm::dot(e, e);
  const double t = square > 0.0 ? std::fmin(1.0, std::fmax(0.0, glm::dot(p - a, e) / square)) : 0.0;
  return glm::length(p - (a + t * e));
}

/// Even-odd rule, edge by edge; points on the outline count as either.
struct EvenOdd {
  Vec2 point;
  bool inside = false;
  bool on_outline = false;  ///< judged on the rounded points

  void add(const Vec2& a, const Vec2& b) {
    const Vec2 from = a - point, to = b - point;
    on_outline = on_outline || (cross2(from, to) == 0.0 && glm::dot(from, to) <= 0.0);
    if ((a.y > point.y) == (b.y > point.y)) return;
    const double side = cross2(b - a, point - a);
    if ((b.y > a.y) ? side > 0.0 : side < 0.0) inside = !inside;
  }
};

/// Whether the closed outline's interior holds the point; `points` as in for_each_edge().
template <class Points>
bool outline_holds(const Points& points, const Vec2& p) {
  EvenOdd rule{p};
  for_each_edge(points, false, [&](const Vec2& a, const Vec2& b) { rule.add(a, b); });
  return rule.inside && !rule.on_outline;
}

auto world_points(const Shape& shape, const Pose& pose) {
  return [&](auto&& f) { for_each_world_point(shape, pose, [&](const Vec3& p) { f(Vec2(p)); }); };
}

}  // namespace

double distance_2d(const Vec2& point, const Shape& shape, const Pose& pose) {
  if (const auto* disc = std::get_if<Disc>(&shape)) {
    return std::fmax(0.0, glm::length(point - Vec2(pose.position)) - disc->radius);
  }
  const bool open = is_thin(shape);
  EvenOdd rule{point};
  double best = std::numeric_limits<double>::infinity();
  for_each_edge(world_points(shape, pose), open, [&](const Vec2& a, const Vec2& b) {
    rule.add(a, b);
    best = std::fmin(best, distance_to_segment(point, a, b));
  });
  return !open && rule.inside ? 0.0 : best;
}

bool interior_holds(const Shape& shape, const Pose& pose, const Vec3& point) {
  if (const auto* disc = std::get_if<Disc>(&shape)) {
    const Vec2 d = Vec2(point) - Vec2(pose.position);
    return glm::dot(d, d) < disc->radius * disc->radius;
  }
  if (std::holds_alternative<Rectangle>(shape) || std::holds_alternative<Polygon>(shape)) {
    return outline_holds(world_points(shape, pose), Vec2(point));
  }
  const Vec3 d = point - pose.position;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return glm::dot(d, d) < sphere->radius * sphere->radius;
  const Vec3 local = rotation_of(pose.orientation).inverse(d);
  if (const auto* box = std::get_if<Cuboid>(&shape)) {
    return std::fabs(local.x) < 0.5 * box->size.x && std::fabs(local.y) < 0.5 * box->size.y &&
           std::fabs(local.z) < 0.5 * box->size.z;
  }
  if (const auto* prism = std::get_if<Prism>(&shape)) {
    const auto points = [&](auto&& f) { for_each_merged(prism->vertices, f); };
    return local.z > 0.0 && local.z < prism->height && outline_holds(points, Vec2(local));
  }
  if (const auto* convex = std::get_if<Convex>(&shape)) return hull_holds(convex->vertices, local);
  if (const auto* volume = std::get_if<Volume>(&shape)) {
    if (glm::dot(d, d) > reach_of(shape) * reach_of(shape)) return false;
    return depth_at(*volume, LatticeMap(volume->field->frame(), pose).to_lattice(point)) < 0.0;
  }
  const auto* mesh = std::get_if<Faces>(&shape);
  return mesh != nullptr && mesh->closed && side_of_mesh(mesh->vertices, mesh->triangles, local) == MeshSide::inside;
}

}  // namespace gridcull
