#include "gridcull/methods/image_polygon.h"

#include <algorithm>
#include <cmath>

#include "gridcull/methods/turn_sign.h"

namespace gridcull {
namespace {

/// Points nearer to the image plane's horizon than this share of their distance are not projected.
constexpr double least_depth = 0x1p-6;

/// A. M. Andrew's monotone chain, counter-clockwise; the signs are exact. Two points in 2D.
void hull_of(std::vector<Vec2>& points, std::vector<Vec2>& hull) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  hull.clear();
  const auto add = [&hull](const Vec2& p, std::size_t least) {
    while (hull.size() > least && turn_sign(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2& p : points) add(p, 1);
  const std::size_t low = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], low);
  if (hull.size() > 1) hull.pop_back();
}

/// What of the polygon has `side` at least `level` (sign 1) or at most (sign -1): Sutherland and Hodgman.
void clip(std::span<const Vec3> polygon, const Vec3& side, double level, double sign, std::vector<Vec3>& out) {
  out.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = sign * (glm::dot(side, a) - level), at_b = sign * (glm::dot(side, b) - level);
    if (at_a >= 0.0) out.push_back(a);
    if ((at_a >= 0.0) == (at_b >= 0.0)) continue;
    // Both cuts of an edge, for either sign, must be the same point.
    const bool forwards = sign > 0.0 ? at_a >= 0.0 : at_a < 0.0;
    const Vec3 &from = forwards ? a : b, &to = forwards ? b : a;
    const double f = std::fabs(forwards ? at_a : at_b), t = std::fabs(forwards ? at_b : at_a);
    out.push_back(from + f / (f + t) * (to - from));
  }
}

}  // namespace

void ImagePolygon::set_axes(const Vec3& towards, bool flat) {
  axis_ = glm::normalize(towards);
  if (flat) {
    across_ = Vec3(-axis_.y, axis_.x, 0.0);
    up_ = Vec3(0.0, 0.0, 1.0);
    return;
  }
  const Vec3 helper = std::fabs(axis_.z) < 0.75 ? Vec3(0.0, 0.0, 1.0) : Vec3(1.0, 0.0, 0.0);
  across_ = glm::normalize(glm::cross(helper, axis_));
  up_ = glm::cross(axis_, across_);
}

void ImagePolygon::finish(double relative_error) {
  hull_of(flat_, hull_);
  rays_.clear();
  length_ = 0.0;
  for (const Vec2& p : hull_) {
    rays_.push_back(axis_ + p.x * across_ + p.y * up_);
    length_ = std::max(length_, glm::length(rays_.back()));
  }
  // Projecting and the axes (orthonormal up to 8 ulp): below 32 ulp of the ray.
  error_ = (relative_error + 0x1p-47) * length_;
}

bool ImagePolygon::build(std::span<const Vec3> points, const Vec3& towards, double blur, bool flat) {
  if (points.empty() || points.size() > most_points || !(glm::dot(towards, towards) > 0.0)) return false;
  set_axes(towards, flat);
  flat_.clear();
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) {
    const double depth = glm::dot(axis_, p);
    if (!(depth > least_depth * glm::length(p)) || !(depth > 64.0 * blur)) return false;
    nearest = std::min(nearest, depth);
    flat_.emplace_back(glm::dot(across_, p) / depth, flat ? 0.0 : glm::dot(up_, p) / depth);
  }
  // A point off by blur moves its ray by blur (1 + |r|) / depth, |r| >= 1; twice for second order.
  finish(4.0 * blur / nearest);
  return true;
}

bool ImagePolygon::build(const SightBall& ball, bool flat) {
  const double d = glm::length(ball.centre);
  const double sine = ball.radius / d;
  if (!(sine < 0.875)) return false;
  set_axes(ball.centre, flat);
  // The tangent of the ball's angle as seen from the viewpoint, a little large: axis and sine are off by some ulp.
  const double tangent = sine / std::sqrt((1.0 - sine) * (1.0 + sine)) * (1.0 + 0x1p-40) + 0x1p-46;
  constexpr double corner = 0.41421356237309515;  // tan 22.5 degrees, rounded up: the octagon's corners
  flat_.clear();
  if (flat) {
    for (const double x : {-tangent, tangent}) flat_.emplace_back(x, 0.0);
  } else {
    const double t = tangent, c = corner * tangent;
    for (const Vec2& p :
         {Vec2(t, c), Vec2(c, t), Vec2(-c, t), Vec2(-t, c), Vec2(-t, -c), Vec2(-c, -t), Vec2(c, -t), Vec2(t, -c)}) {
      flat_.push_back(p);
    }
  }
  finish(0.0);
  return true;
}

Overlap overlap(const ImagePolygon& polygon, const ShadowFrustum& frustum, std::uint64_t& plane_tests) {
  const std::span<const Vec3> rays = polygon.rays();
  const auto within = [&](const Vec3& ray) {
    return frustum.holds_ray(ray, polygon.length(), polygon.error(), plane_tests);
  };
  if (std::all_of(rays.begin(), rays.end(), within)) return Overlap::inside;
  // Cyrus and Beck: each edge of the polygon against all sides; what of it is within?
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Vec3 &a = rays[i], &b = rays[(i + 1) % rays.size()];
    double begin = 0.0, end = 1.0;
    for (const ShadowPlane& side : frustum.sides()) {
      ++plane_tests;
      const double at_a = glm::dot(side.normal, a), at_b = glm::dot(side.normal, b);
      if (at_a < 0.0 && at_b < 0.0) end = -1.0;
      if (at_a < 0.0 && at_b >= 0.0) begin = std::max(begin, at_a / (at_a - at_b));
      if (at_a >= 0.0 && at_b < 0.0) end = std::min(end, at_a / (at_a - at_b));
      if (!(begin <= end)) break;
    }
    if (begin <= end) return Overlap::partial;
  }
  // No edge overlaps: apart, or the occluder lies wholly within the occludee. A common point tells: where two sides of
  // the occluder meet, against the polygon's edges.
  const std::span<const ShadowPlane> sides = frustum.sides();
  if (sides.size() < 2 || rays.size() < 3) return Overlap::partial;
  Vec3 corner = glm::cross(sides[0].normal, sides[1].normal);
  if (glm::dot(corner, rays[0]) < 0.0) corner = -corner;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ++plane_tests;
    if (glm::dot(glm::cross(rays[i], rays[(i + 1) % rays.size()]), corner) < 0.0) return Overlap::outside;
  }
  return Overlap::partial;
}

std::uint64_t rays_within(const ImagePolygon& polygon, const ShadowFrustum& frustum, std::uint64_t& plane_tests) {
  std::uint64_t out = 0;
  const std::span<const Vec3> rays = polygon.rays();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    bool within = true;
    for (const ShadowPlane& side : frustum.sides()) {
      ++plane_tests;
      if (glm::dot(side.normal, rays[i]) < 0.0) {
        within = false;
        break;
      }
    }
    if (within && !frustum.sides().empty()) out |= std::uint64_t{1} << i;
  }
  return out;
}

bool inside_union(const ImagePolygon& polygon, const ShadowFrustum& a, const ShadowFrustum& b, UnionScratch& scratch,
                  std::uint64_t& plane_tests) {
  if (a.sides().empty() || b.sides().empty() || a.sides().size() > 64) return false;
  const double length = polygon.length(), error = polygon.error();
  const double level = ImagePolygon::cut_margin * length + 4.0 * error;
  const double pass = ImagePolygon::pass_margin * length + 2.0 * error;
  scratch.rest.assign(polygon.rays().begin(), polygon.rays().end());
  for (const ShadowPlane& side : a.sides()) {
    ++plane_tests;
    const double cut = level + 2.0 * side.slope * length;
    clip(scratch.rest, side.normal, cut, -1.0, scratch.piece);
    for (const Vec3& ray : scratch.piece) {
      for (const ShadowPlane& other : b.sides()) {
        ++plane_tests;
        if (glm::dot(other.normal, ray) < pass + other.slope * length) return false;
      }
    }
    clip(scratch.rest, side.normal, cut, 1.0, scratch.next);
    std::swap(scratch.rest, scratch.next);
    if (scratch.rest.empty()) break;
  }
  return true;
}

}  // namespace gridcull
