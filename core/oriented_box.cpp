// Claim (oriented_boundary). Let A have the axes as columns, square to each other and of length 1 to 2^-49, so that the
// inverse of A differs from its transpose by less than 2^-48 in norm. A point x is centre + A t with
// t = A^-1 (x - centre), |t_k - a_k.(x - centre)| < 2^-48 |x - centre|, and computed a_k.(x - centre) are off by less
// than 2^-50 of the coordinates' size: for a point that went in |t_k| <= half_k + 2^-46 size. Corners as stored are off
// by less than 2^-49 size + 2^-48 (half + grown), so their hull contains what lies that far within the parallelepiped
// |t_k| <= half_k + grown (core/slab_boundary.cpp, claim 2). Together below 2^-44 size.
#include "gridcull/core/oriented_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/quick_hull.h"
#include "gridcull/core/slabs.h"

namespace gridcull {
namespace {

/// Sizes along the axes.
Vec3 extent(std::span<const Vec3> points, const Rotation& axes) {
  Bounds box;
  for (const Vec3& p : points) box.add(axes.inverse(p));
  return box.size();
}

/// Half the surface: also tells boxes apart that are flat.
double cost(const Vec3& size) { return size.x * size.y + size.y * size.z + size.z * size.x; }

/// Keeps the cheapest frame on the points farthest out.
class FrameChoice {
 public:
  explicit FrameChoice(std::span<const Vec3> points) : points_(points), least_(cost(extent(points, best_))) {}

  /// The frame with x along u and z square to u and v, where they span a plane.
  void offer(const Vec3& u, const Vec3& v) {
    const Vec3 n = glm::cross(u, v);
    const double lu = glm::length(u), ln = glm::length(n);
    // Below that the axes would not be square to 2^-49 any more, after one refinement of each.
    if (!(lu > 0.0) || !(ln > 1e-6 * lu * glm::length(v))) return;
    Rotation axes;
    axes.x = u / lu;
    axes.z = n / ln;
    axes.z = glm::normalize(axes.z - glm::dot(axes.z, axes.x) * axes.x);
    axes.y = glm::normalize(glm::cross(axes.z, axes.x));
    const double now = cost(extent(points_, axes));
    if (now < least_) least_ = now, best_ = axes;
  }
  void offer_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    offer(b - a, c - a);
    offer(c - b, a - b);
    offer(a - c, b - c);
  }

  const Rotation& best() const { return best_; }

 private:
  std::span<const Vec3> points_;
  Rotation best_{};
  double least_;
};

std::vector<Vec3> farthest_out(std::span<const Vec3> points, const Extremes& ends) {
  std::vector<Vec3> few;
  for (std::size_t j = 0; j < ends.lowest.size(); ++j) {
    few.push_back(points[ends.lowest[j]]);
    few.push_back(points[ends.highest[j]]);
  }
  return few;
}

/// Index of the point with the greatest measure.
template <class Measure>
Vec3 farthest(const std::vector<Vec3>& points, const Measure& measure) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vec3& a, const Vec3& b) { return measure(a) < measure(b); });
}

/// The large base triangle, and the two tetrahedra over and under it: seven triangles.
Rotation best_frame(std::span<const Vec3> points) {
  const std::vector<Vec3> few = farthest_out(points, extremes_of(points));
  FrameChoice choice(few);
  Vec3 a = few[0], b = few[1];
  for (std::size_t j = 0; j < few.size(); j += 2) {
    if (glm::length(few[j + 1] - few[j]) > glm::length(b - a)) a = few[j], b = few[j + 1];
  }
  const double length = glm::length(b - a);
  if (!(length > 0.0)) return choice.best();
  const Vec3 along = (b - a) / length;
  const Vec3 c = farthest(few, [&](const Vec3& p) { return glm::length(glm::cross(along, p - a)); });
  choice.offer_triangle(a, b, c);
  const Vec3 normal = glm::cross(b - a, c - a);
  for (const double side : {1.0, -1.0}) {
    const Vec3 d = farthest(few, [&](const Vec3& p) { return side * glm::dot(normal, p - a); });
    choice.offer_triangle(a, b, d);
    choice.offer_triangle(b, c, d);
    choice.offer_triangle(c, a, d);
  }
  return choice.best();
}

Rotation best_frame_2d(std::span<const Vec3> points) {
  const std::vector<std::uint32_t> ring = planar_hull(points, 0, 1);
  std::vector<Vec3> corners;
  for (const std::uint32_t i : ring) corners.push_back(points[i]);
  const auto area = [&](const Rotation& axes) {
    const Vec3 size = extent(corners, axes);
    return size.x * size.y;
  };
  Rotation best{};
  double least = area(best);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 side = corners[i + 1 == corners.size() ? 0 : i + 1] - corners[i];
    if (!(glm::length(side) > 0.0)) continue;
    Rotation axes;
    axes.x = glm::normalize(glm::normalize(side));
    axes.y = {-axes.x.y, axes.x.x, 0.0};
    const double now = area(axes);
    if (now < least || (corners.size() < 3 && i == 0)) least = now, best = axes;
  }
  return best;
}

}  // namespace

OrientedBox box_along(std::span<const Vec3> points, const Rotation& axes) {
  OrientedBox out;
  out.axes = axes;
  // About a point among them, so that their distances count and not their coordinates.
  const Vec3 base = points[0];
  Bounds box;
  for (const Vec3& p : points) {
    box.add(axes.inverse(p - base));
    out.size = std::max({out.size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  out.centre = base + axes * box.centre();
  for (const Vec3& p : points) out.half = glm::max(out.half, glm::abs(axes.inverse(p - out.centre)));
  return out;
}

OrientedBox oriented_box_around(std::span<const Vec3> points, int dimension) {
  return box_along(points, dimension == 2 ? best_frame_2d(points) : best_frame(points));
}

void oriented_boundary(const OrientedBox& box, double grown, int dimension, ConvexBoundary& out) {
  out.clear();
  const Vec3 half = box.half + Vec3(grown, grown, dimension == 2 ? 0.0 : grown);
  const auto corner = [&](double x, double y, double z) {
    out.vertices.push_back(box.centre + box.axes * (half * Vec3(x, y, z)));
  };
  if (dimension == 2) {
    corner(-1, -1, 0), corner(1, -1, 0), corner(1, 1, 0), corner(-1, 1, 0);
    out.loops = {0, 1, 2, 3};
    out.faces = {{{0.0, 0.0, 1.0}, 0, 4}};
    return;
  }
  for (int i = 0; i < 8; ++i) corner((i & 1) ? 1.0 : -1.0, (i & 2) ? 1.0 : -1.0, (i & 4) ? 1.0 : -1.0);
  out.loops = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  for (std::uint32_t f = 0; f < 6; ++f) {
    const Vec3& axis = f < 2 ? box.axes.x : f < 4 ? box.axes.y : box.axes.z;
    out.faces.push_back({f % 2 == 0 ? -axis : axis, 4 * f, 4});
  }
}

}  // namespace gridcull
