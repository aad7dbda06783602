// Claim. A placed volume contains every world point t of its shape.
// t = fl(p + R k), k a local point of the shape, and each vertex is w = fl(p + R v), with the same doubles p and R.
// With exact sums A(x) = p + R x, both are off by less than place_error() each: a sum of three products and one more
// sum, 2^-50 (|p|_1 + 2 size). R's columns are within 2e-9 of an orthonormal matrix's (unit quaternions to 1e-9), so A
// shrinks no distance by more than 2^-27 of itself.
//   Polyhedra: the ball of radius grown - 2^-44 size about k lies in hull(v) (core/slab_boundary.cpp,
//   core/oriented_box.cpp; hulls below), so one of radius (1 - 2^-27) times that about A(k) lies in hull(A(v)); where
//   that exceeds twice place_error(), t lies in hull(w). It is made to exceed it: grown is that large, or the boundary
//   is made again. Ball: |t - w| <= |k - c| (1 + 2^-27) + 2 place_error() <= the placed radius, which is rounded up.
// Hulls. Let K be the exact hull (core/quick_hull.cpp) and B(c, r) a ball in it. K scaled about c by 1 + s,
// s = grown / r, is K + s (K - c), K being convex, and holds K + B(0, s r). Where K is too flat for that, the hull of
// the corners of cubes with half edge `grown` about K's vertices is K + that cube. Vertices are rounded by 2^-50 size.
// A sphere or disc is turned without effect, its polyhedra are: A moves a point at distance r by at most
// 2^-27 r off where an orthonormal matrix would, so round shapes are grown by 2^-26 r more.
#include "gridcull/core/bounding_volume.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "gridcull/core/quick_hull.h"
#include "gridcull/core/simplex.h"
#include "gridcull/core/world_points.h"

namespace gridcull {
namespace {

/// Against rounding, relative to `size`. Small enough to be seen in no count, large enough for poses at 2^14 times the
/// size. The least value keeps single points apart from nothing.
constexpr double growth = 0x1p-30, least_growth = 0x1p-200;

double magnitude(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

double place_error(const BoundingVolume& bound, const Pose& pose) {
  return 0x1p-50 * (magnitude(pose.position) + 2.0 * bound.size);
}

bool has_slabs(BoundKind kind) {
  return kind != BoundKind::sphere && kind != BoundKind::obb && kind != BoundKind::hull;
}

void write_hull(BoundingVolume& bound) {
  if (bound.inner.radius > 0.0) {
    const double s = bound.grown / bound.inner.radius;
    bound.boundary = bound.bare;
    for (Vec3& v : bound.boundary.vertices) v += s * (v - bound.inner.centre);
    return;
  }
  std::vector<Vec3> points;
  for (const Vec3& v : bound.bare.vertices) {
    for (int i = 0; i < (bound.dimension == 2 ? 4 : 8); ++i) {
      const Vec3 corner((i & 1) ? 1.0 : -1.0, (i & 2) ? 1.0 : -1.0, bound.dimension == 2 ? 0.0 : (i & 4) ? 1.0 : -1.0);
      points.push_back(v + bound.grown * corner);
    }
  }
  bound.boundary = hull_boundary(points, bound.dimension);
}

/// The boundary with `bound.grown`.
void write_boundary(BoundingVolume& bound) {
  if (bound.round) return;
  if (bound.kind == BoundKind::hull) {
    write_hull(bound);
  } else if (bound.kind == BoundKind::obb) {
    oriented_boundary(bound.obb, bound.grown, bound.dimension, bound.boundary);
  } else {
    slab_boundary(bound.slabs, bound.grown, bound.boundary);
  }
}

BoundingVolume start(BoundKind kind, int dimension, double size) {
  BoundingVolume bound;
  bound.kind = kind;
  bound.dimension = dimension;
  bound.size = size;
  bound.grown = growth * size + least_growth;
  return bound;
}

double size_of(std::span<const Vec3> points) {
  double size = 0.0;
  for (const Vec3& p : points) size = std::max(size, magnitude(p));
  return size * (1.0 + 0x1p-50);
}

/// About the points, for turns by matrices that are orthonormal to 2e-9 only.
Ball wide_ball(std::span<const Vec3> points, double more) {
  Ball ball = ball_around(points);
  ball.radius = (ball.radius + more) * (1.0 + 0x1p-26);
  return ball;
}

BoundingVolume bound_of_ball(double radius, BoundKind kind, int dimension) {
  BoundingVolume bound = start(kind, dimension, 3.0 * radius);
  bound.round = kind == BoundKind::sphere || kind == BoundKind::hull;
  if (bound.round) {
    bound.ball = {Vec3(0.0), radius};
    return bound;
  }
  bound.grown += 0x1p-26 * radius;
  if (kind == BoundKind::obb) {
    bound.obb.half = dimension == 2 ? Vec3(radius, radius, 0.0) : Vec3(radius);
    bound.obb.size = radius;
  } else {
    bound.slabs = slabs_of_ball(Vec3(0.0), radius, kind, dimension);
  }
  write_boundary(bound);
  return bound;
}

std::vector<Vec3> points_of(const Shape& shape) {
  std::vector<Vec3> points;
  for_each_local_point(shape, [&](const Vec3& p) { points.push_back(p); });
  return points;
}

}  // namespace

BoundingVolume bound_of(const Shape& shape, BoundKind kind) {
  if (const auto* disc = std::get_if<Disc>(&shape)) return bound_of_ball(disc->radius, kind, 2);
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return bound_of_ball(sphere->radius, kind, 3);
  return bound_of(points_of(shape), kind, dimension_of(shape));
}

BoundingVolume bound_of(std::span<const Vec3> points, BoundKind kind, int dimension) {
  BoundingVolume bound = start(kind, dimension, 0.0);
  if (has_slabs(kind)) {
    bound.slabs = slabs_of(points, kind, dimension);
    bound.size = bound.slabs.size;
  } else {
    bound.size = size_of(points);
  }
  bound.grown = growth * bound.size + least_growth;
  bound.round = kind == BoundKind::sphere;
  if (kind == BoundKind::obb) bound.obb = oriented_box_around(points, dimension);
  if (kind == BoundKind::hull) {
    bound.bare = hull_boundary(points, dimension);
    bound.inner = ball_inside(points, dimension);
  }
  if (bound.round) bound.ball = wide_ball(points, 0x1p-44 * bound.size);
  write_boundary(bound);
  return bound;
}

ConvexBoundary grown_boundary(const BoundingVolume& bound, double metres) {
  BoundingVolume copy = bound;
  copy.grown += metres;
  write_boundary(copy);
  return std::move(copy.boundary);
}

void place(const BoundingVolume& bound, const Pose& pose, PlacedBound& out) {
  const Rotation r = rotation_of(pose.orientation);
  const double error = place_error(bound, pose);
  out.round = bound.round;
  if (bound.round) {
    out.ball = {to_world(pose, r, bound.ball.centre), bound.ball.radius + 4.0 * error};
    return out.boundary.clear();
  }
  const double paid = (bound.grown - 0x1p-44 * bound.size) * (1.0 - 0x1p-26);
  out.boundary = paid > 2.0 * error ? bound.boundary : grown_boundary(bound, 4.0 * error);
  for (Vec3& v : out.boundary.vertices) v = to_world(pose, r, v);
  if (bound.dimension == 2) {
    for (Vec3& v : out.boundary.vertices) v.z = 0.0;
    return;
  }
  for (auto& face : out.boundary.faces) face.normal = r * face.normal;
}

BoundingVolume refit(const BoundingVolume& bound, const Pose& pose) {
  PlacedBound placed;
  place(bound, pose, placed);
  if (placed.round) {
    BoundingVolume out = bound;
    out.ball = placed.ball;
    out.size = magnitude(placed.ball.centre) + 3.0 * placed.ball.radius;
    return out;
  }
  if (has_slabs(bound.kind)) return bound_of(placed.boundary.vertices, bound.kind, bound.dimension);
  BoundingVolume out = start(bound.kind, bound.dimension, size_of(placed.boundary.vertices));
  const Rotation r = rotation_of(pose.orientation);
  if (bound.kind == BoundKind::hull) {
    // The old faces; the ball inside pays for the turn and for what moved its vertices.
    const double radius = bound.inner.radius * (1.0 - 0x1p-20) - 4.0 * place_error(bound, pose);
    if (radius > 0x1p-20 * out.size) out.inner = {to_world(pose, r, bound.inner.centre), radius};
    out.bare = std::move(placed.boundary);
    write_boundary(out);
    return out;
  }
  Rotation axes{glm::normalize(r * bound.obb.axes.x), {}, {}};
  axes.z = r * bound.obb.axes.z;
  axes.z = glm::normalize(axes.z - glm::dot(axes.z, axes.x) * axes.x);
  axes.y = glm::normalize(glm::cross(axes.z, axes.x));
  out.obb = box_along(placed.boundary.vertices, axes);
  write_boundary(out);
  return out;
}

double volume_of(const BoundingVolume& bound) {
  if (bound.dimension == 2)
    return bound.round ? std::numbers::pi * bound.ball.radius * bound.ball.radius : area_of(bound.boundary);
  const double r = bound.ball.radius;
  return bound.round ? 4.0 / 3.0 * std::numbers::pi * r * r * r : volume_of(bound.boundary);
}

double surface_of(const BoundingVolume& bound) {
  const double r = bound.ball.radius;
  if (bound.dimension == 3) return bound.round ? 4.0 * std::numbers::pi * r * r : area_of(bound.boundary);
  if (bound.round) return 2.0 * std::numbers::pi * r;
  return length_of(bound.boundary, bound.boundary.faces[0]);
}

}  // namespace gridcull
