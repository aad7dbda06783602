#include "gridcull/methods/shadow_frustum.h"

#include <algorithm>
#include <cmath>

namespace gridcull {

SightBox::SightBox(const Bounds& box, const Vec3& eye) {
  const Vec3 low = box.min - eye, high = box.max - eye;
  centre = 0.5 * (low + high);
  half = 0.5 * (high - low);
  // |centre| + |half| bounds every point; the sums above round by a few ulp of it, which `slope` pays for.
  reach = (glm::length(centre) + glm::length(half)) * (1.0 + 0x1p-40);
}

SightBall::SightBall(const Vec3& centre_in_world, double true_radius, const Vec3& eye)
    : centre(centre_in_world - eye), radius(true_radius + blur_of(centre_in_world, true_radius, eye)) {
  reach = (glm::length(centre) + radius) * (1.0 + 0x1p-40);
}

/// The near plane, or else all face planes. extent(n): by how much n.p varies about n.centre. `before`: surely outside.
template <class Extent>
bool ShadowFrustum::beyond_extent(const Vec3& centre, double reach, const Extent& extent, std::uint64_t& plane_tests,
                                  bool& before) const {
  before = false;
  if (has_near_) {
    ++plane_tests;
    const double at = glm::dot(near_.normal, centre) - near_.offset, around = extent(near_.normal);
    if (at - around >= near_.slope * reach + near_.base) return true;
    before = faces_.empty() && at + around < 0.0;
  }
  bool all = !faces_.empty();
  for (const ShadowPlane& face : faces_) {
    ++plane_tests;
    const double at = glm::dot(face.normal, centre) - face.offset, around = extent(face.normal);
    if (at + around < 0.0) before = true;
    if (at - around >= face.slope * reach + face.base) continue;
    all = false;
    if (before) break;
  }
  return all;
}

namespace {

/// By how much n.p varies over a box about n.centre.
struct BoxExtent {
  Vec3 half;
  double operator()(const Vec3& n) const {
    return std::fabs(n.x) * half.x + std::fabs(n.y) * half.y + std::fabs(n.z) * half.z;
  }
};

/// A little more than the radius: normals are unit up to 4 ulp.
struct BallExtent {
  double radius;
  double operator()(const Vec3&) const { return radius; }
};

template <class Extent>
Overlap against_sides(std::span<const ShadowPlane> sides, const Vec3& centre, double reach, const Extent& extent,
                      std::uint64_t& plane_tests) {
  bool inside = true;
  for (const ShadowPlane& side : sides) {
    ++plane_tests;
    const double at = glm::dot(side.normal, centre), around = extent(side.normal);
    if (at + around < 0.0) return Overlap::outside;
    inside = inside && at - around >= side.slope * reach;
  }
  return inside ? Overlap::inside : Overlap::partial;
}

}  // namespace

/// Signed distance of p from the cone's side, positive within.
double ShadowFrustum::beside_cone(const Vec3& p) const {
  return glm::dot(p, axis_) * sin_ - glm::length(glm::cross(p, axis_)) * cos_;
}

Overlap ShadowFrustum::overlap(const SightBall& ball, std::uint64_t& plane_tests) const {
  const BallExtent extent{ball.radius * (1.0 + 0x1p-48)};
  Overlap out = Overlap::partial;
  if (cone_) {
    ++plane_tests;
    const double beside = beside_cone(ball.centre);
    if (beside + extent.radius < 0.0) return Overlap::outside;
    if (beside - extent.radius >= cone_slope_ * ball.reach) out = Overlap::inside;
  } else {
    out = against_sides(sides_, ball.centre, ball.reach, extent, plane_tests);
    if (out == Overlap::outside) return out;
  }
  bool before = false;
  const bool beyond_all = beyond_extent(ball.centre, ball.reach, extent, plane_tests, before);
  if (before) return Overlap::outside;
  return beyond_all ? out : Overlap::partial;
}

Overlap ShadowFrustum::overlap(const SightBox& box, std::uint64_t& plane_tests) const {
  const BoxExtent extent{box.half};
  Overlap out = Overlap::inside;
  if (cone_) {
    ++plane_tests;
    if (beside_cone(box.centre) + glm::length(box.half) < 0.0) return Overlap::outside;
    for (int i = 0; i < 8 && out == Overlap::inside; ++i) {
      const Vec3 sign((i & 1) ? 1.0 : -1.0, (i & 2) ? 1.0 : -1.0, (i & 4) ? 1.0 : -1.0);
      ++plane_tests;
      if (beside_cone(box.centre + sign * box.half) < cone_slope_ * box.reach) out = Overlap::partial;
    }
  } else {
    out = against_sides(sides_, box.centre, box.reach, extent, plane_tests);
    if (out == Overlap::outside) return out;
  }
  bool before = false;
  const bool beyond_all = beyond_extent(box.centre, box.reach, extent, plane_tests, before);
  if (before) return Overlap::outside;
  return beyond_all ? out : Overlap::partial;
}

bool ShadowFrustum::beyond(const SightBall& ball, std::uint64_t& plane_tests) const {
  bool before = false;
  return beyond_extent(ball.centre, ball.reach, BallExtent{ball.radius * (1.0 + 0x1p-48)}, plane_tests, before);
}

bool ShadowFrustum::beyond(std::span<const Vec3> points, double blur, std::uint64_t& plane_tests) const {
  const auto all_beyond = [&](const ShadowPlane& plane) {
    ++plane_tests;
    return std::all_of(points.begin(), points.end(), [&](const Vec3& p) {
      return glm::dot(plane.normal, p) - plane.offset >= plane.slope * glm::length(p) + plane.base + 2.0 * blur;
    });
  };
  if (has_near_ && all_beyond(near_)) return true;
  return !faces_.empty() && std::all_of(faces_.begin(), faces_.end(), all_beyond);
}

bool ShadowFrustum::holds_ray(const Vec3& ray, double length, double error, std::uint64_t& plane_tests) const {
  if (cone_) {
    ++plane_tests;
    return beside_cone(ray) >= cone_slope_ * length + 2.0 * error;
  }
  return std::all_of(sides_.begin(), sides_.end(), [&](const ShadowPlane& side) {
    ++plane_tests;
    return glm::dot(side.normal, ray) >= side.slope * length + 2.0 * error;
  });
}

}  // namespace gridcull
