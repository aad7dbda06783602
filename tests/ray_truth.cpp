#include "ray_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gridcull/core/hull.h"

namespace gridcull::test {
namespace {

constexpr long double infinity = std::numeric_limits<long double>::infinity();

/// Rows of the inverse rotation, from the quaternion in long doubles.
std::array<Long3, 3> local_axes(const Quat& q) {
  const long double w = q.w, x = q.x, y = q.y, z = q.z, n = w * w + x * x + y * y + z * z;
  return {Long3{1 - 2 * (y * y + z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n},
          Long3{2 * (x * y - w * z) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z + w * x) / n},
          Long3{2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n, 1 - 2 * (x * x + y * y) / n}};
}

}  // namespace

long double length(const Long3& v) { return std::sqrt(dot(v, v)); }

RayTruth::RayTruth(const Shape& shape, const Pose& pose, const Vec3& eye)
    : shape_(&shape), axes_(local_axes(pose.orientation)) {
  const Long3 off = longer(eye) - longer(pose.position);
  eye_ = {dot(axes_[0], off), dot(axes_[1], off), dot(axes_[2], off)};
  if (const auto* box = std::get_if<Cuboid>(&shape)) {
    for (const double s : {1.0, -1.0}) {
      planes_.push_back({{s, 0, 0}, box->size.x / 2.0L});
      planes_.push_back({{0, s, 0}, box->size.y / 2.0L});
      planes_.push_back({{0, 0, s}, box->size.z / 2.0L});
    }
  } else if (const auto* convex = std::get_if<Convex>(&shape)) {
    for (const auto& t : convex_hull(convex->vertices).triangles) {
      const Long3 a = longer(convex->vertices[t[0]]), b = longer(convex->vertices[t[1]]);
      const Long3 normal = cross(b - a, longer(convex->vertices[t[2]]) - a);
      const long double size = length(normal);
      if (size > 0) planes_.push_back({(1 / size) * normal, dot(normal, a) / size});
    }
  } else if (std::holds_alternative<Faces>(shape)) {
    triangles_ = world_vertices(shape, pose);
    eye_ = longer(eye);
  }
}

std::vector<RayTruth::Stretch> RayTruth::prism_stretches(const Long3& d) const {
  const auto& prism = std::get<Prism>(*shape_);
  Stretch slab{-infinity, infinity};
  for (const auto& [at, along] : {std::pair(eye_.z, d.z), std::pair(prism.height - eye_.z, -d.z)}) {
    if (along == 0) {
      if (!(at > 0)) return {};
    } else if (along > 0) {
      slab.begin = std::max(slab.begin, -at / along);
    } else {
      slab.end = std::min(slab.end, -at / along);
    }
  }
  // Even-odd along the ray: crossings of the outline, sorted.
  std::vector<long double> cuts;
  const auto& v = prism.vertices;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++) {
    const long double ax = v[j].x - eye_.x, ay = v[j].y - eye_.y, bx = v[i].x - eye_.x, by = v[i].y - eye_.y;
    const long double side_a = d.x * ay - d.y * ax, side_b = d.x * by - d.y * bx;
    if ((side_a > 0) == (side_b > 0)) continue;
    cuts.push_back((ax * (by - ay) - ay * (bx - ax)) / (d.x * (by - ay) - d.y * (bx - ax)));
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<Stretch> out;
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
    const Stretch s{std::max(slab.begin, cuts[i]), std::min(slab.end, cuts[i + 1])};
    if (s.begin < s.end) out.push_back(s);
  }
  return out;
}

Long3 RayTruth::local(const Long3& d) const { return {dot(axes_[0], d), dot(axes_[1], d), dot(axes_[2], d)}; }

bool RayTruth::runs_along_a_wall(const Long3& direction) const {
  const auto* prism = std::get_if<Prism>(shape_);
  if (prism == nullptr) return false;
  const Long3 d = local(direction);
  const auto& v = prism->vertices;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++) {
    const long double ex = v[i].x - v[j].x, ey = v[i].y - v[j].y;
    if (std::fabs(d.x * ey - d.y * ex) <= 1e-9L * std::hypot(d.x, d.y) * std::hypot(ex, ey)) return true;
  }
  return false;
}

std::vector<RayTruth::Stretch> RayTruth::stretches(const Long3& world) const {
  const Long3 d = local(world);
  if (std::holds_alternative<Prism>(*shape_)) return prism_stretches(d);
  Stretch s{-infinity, infinity};
  for (const Plane& plane : planes_) {
    const long double gap = plane.offset - dot(plane.normal, eye_), along = dot(plane.normal, d);
    if (along == 0) {
      if (!(gap > 0)) return {};
    } else if (along > 0) {
      s.end = std::min(s.end, gap / along);
    } else {
      s.begin = std::max(s.begin, gap / along);
    }
  }
  if (s.begin < s.end) return {s};
  return {};
}

std::optional<long double> RayTruth::faces_entrance(const Long3& d) const {
  std::optional<long double> first;
  for (const auto& t : std::get<Faces>(*shape_).triangles) {
    const Long3 a = longer(triangles_[t[0]]) - eye_, b = longer(triangles_[t[1]]) - eye_;
    const Long3 c = longer(triangles_[t[2]]) - eye_;
    const long double ab = dot(d, cross(a, b)), bc = dot(d, cross(b, c)), ca = dot(d, cross(c, a));
    if (!((ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0))) continue;
    const long double sum = ab + bc + ca;
    // Seen edge-on: rounding, not a crossing.
    if (std::fabs(sum) <= 1e-12L * (length(cross(a, b)) + length(cross(b, c)) + length(cross(c, a)))) continue;
    const long double at = dot(a, cross(b, c)) / sum;
    if (at > 0 && (!first || at < *first)) first = at;
  }
  return first;
}

std::optional<long double> RayTruth::entrance(const Long3& direction) const {
  const Long3 d = (1 / length(direction)) * direction;
  if (std::holds_alternative<Faces>(*shape_)) return faces_entrance(d);
  for (const Stretch& s : stretches(d)) {
    if (s.end > 0) return std::max(s.begin, 0.0L);
  }
  return std::nullopt;
}

bool RayTruth::holds_eye() const {
  if (std::holds_alternative<Faces>(*shape_)) return false;
  const auto any = stretches({0.3L, 0.5L, 0.81L});
  return std::any_of(any.begin(), any.end(), [](const Stretch& s) { return s.begin < 0 && s.end > 0; });
}

}  // namespace gridcull::test
