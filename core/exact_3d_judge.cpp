#include "gridcull/core/exact_3d_judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/trigonometry.h"

namespace gridcull::exact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check(const View& view) {
  const auto refuse = [&](const char* what) {
    throw Error(ErrorCode::bad_frame, "viewer " + std::to_string(view.viewer) + ": " + what);
  };
  const Vec3& p = view.pose.position;
  if (!(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= 1e9)) refuse("expected a finite position");
  if (!(view.range > 0.0)) refuse("expected a range above 0");
  if (!view.frustum) return;
  const Frustum& f = *view.frustum;
  if (!(f.fov_y > 0.0 && f.fov_y < std::numbers::pi)) refuse("expected fov_y of 0 .. 180 degrees");
  if (!(f.aspect > 0.0 && std::isfinite(f.aspect))) refuse("expected an aspect above 0");
  if (!(f.near >= 0.0 && f.far > f.near)) refuse("expected 0 <= near < far");
}

}  // namespace

ViewLimits::ViewLimits(const View& view)
    : eye_(view.pose.position),
      axes_(rotation_of(view.pose.orientation)),
      all_round_(!view.frustum),
      far_(infinity),
      range_(view.range),
      magnitude_(std::max({std::fabs(eye_.x), std::fabs(eye_.y), std::fabs(eye_.z)})) {
  check(view);
  if (all_round_) return;
  const SinCos half = stable_sincos(0.5 * view.frustum->fov_y);
  tangent_y_ = half.sin / half.cos;
  tangent_x_ = tangent_y_ * view.frustum->aspect;
  near_ = view.frustum->near;
  far_ = view.frustum->far;
}

bool ViewLimits::holds(const Vec3& ray) const {
  if (all_round_) return true;
  const double depth = glm::dot(axes_.x, ray);
  return depth > 0.0 && std::fabs(glm::dot(axes_.y, ray)) <= tangent_x_ * depth &&
         std::fabs(glm::dot(axes_.z, ray)) <= tangent_y_ * depth;
}

Stretch ViewLimits::part(const Vec3& ray) const {
  if (all_round_) return {0.0, range_};
  const double depth = glm::dot(axes_.x, ray);
  return {near_ / depth, std::min(range_, far_ / depth)};
}

namespace {

/// A closed mesh whose surface the eye touches hides from there on what the ray goes into: the tie is passed, and an
/// odd number of crossings lies ahead.
bool goes_inside(const Solid& solid, const std::vector<Stretch>& crossings, double tie) {
  if (!solid.closed) return false;
  const auto touched = [&](const Stretch& s) { return std::fabs(s.begin) <= tie; };
  const auto ahead = std::count_if(crossings.begin(), crossings.end(), [&](const Stretch& s) { return s.begin > tie; });
  return ahead % 2 != 0 && std::any_of(crossings.begin(), crossings.end(), touched);
}

}  // namespace

Along look_along(const ViewLimits& view, const Solid& solid, const Vec3& ray, std::vector<Stretch>& scratch) {
  scratch.clear();
  add_stretches(solid, view.eye(), ray, scratch);
  const Stretch part = view.part(ray);
  const bool thin = solid.kind == SolidKind::faces;
  Along along{infinity, infinity};
  if (thin && solid.occluder && goes_inside(solid, scratch, view.tie_at(0.0))) along.entry = 0.0;
  for (const Stretch& s : scratch) {
    // A thin face that the eye touches is not crossed by the open segment; a solid hides by its inside only.
    if (s.end <= (thin ? view.tie_at(0.0) : 0.0)) continue;
    const double begin = std::max(0.0, s.begin);
    if (s.end >= part.begin && std::max(begin, part.begin) <= part.end) {
      along.touch = std::min(along.touch, std::max(begin, part.begin));
    }
    if (solid.occluder && (thin || s.end - begin > view.tie_at(s.end))) along.entry = std::min(along.entry, begin);
  }
  return along;
}

bool seen_past(const ViewLimits& view, const Solid& target, std::span<const Solid* const> others, const Vec3& ray,
               std::vector<Stretch>& scratch) {
  if (!view.holds(ray)) return false;
  const double touch = look_along(view, target, ray, scratch).touch;
  if (!std::isfinite(touch)) return false;
  return std::none_of(others.begin(), others.end(), [&](const Solid* other) {
    return other != &target && other->occluder &&
           look_along(view, *other, ray, scratch).entry < touch - view.tie_at(touch);
  });
}

}  // namespace gridcull::exact
