// Claim. The cone spanned by the rays holds every point of the true shape K.
// Let K+ be the pushed-out hull: the ball of radius slack about each point of K lies in it (convex_piece.h); half of
// slack pays for the truth's own rounding (sight_blur), half for what follows. Let e = view_error() bound how far
// computed rays and face planes lie from K+'s in the viewer's frame, h the height of the viewpoint over the highest
// face, L bound the distance of K's points. (a) All face planes farther than e from the viewpoint: the signs are K+'s,
// the loop is K+'s own but for e. Were p in K outside the computed cone, a plane through the viewpoint with unit normal
// m would have m.p > 0 >= m.r for all rays r, so m.r+ <= e for K+'s rays r+. As p + (slack / 2) m lies in K+, it is a
// sum of a_i r+_i with a_i >= 0, and with the highest face's normal n, -n.r+ >= h, so the sum of a_i is at most L / h:
// slack / 2 < L e / h. So it is asked that h slack / 2 >= L e. (b) Otherwise the loop is checked: every vertex of K+
// lies to the inner side of each plane through two consecutive rays, or at most slack / 4 outside it. So K lies
// strictly inside all these planes, the loop winds about each of its directions (piece_silhouette.cpp), which thus lie
// in the loop's hull.
//
// Slices. With m a unit direction, |p| <= far implies m.p <= far, and |p| >= near implies m.p >= near * c where c is
// the least cosine between m and a direction of K+ (of the hull's rays, for a cone). So the slice lies between two
// planes, and the part of the front faces between them is spanned by vertices and by points on edges of front faces.
// The planes are moved apart by slack, so that rounding of those points (e) is again paid for as in (a), with h
// replaced by near * c: asked for in the same way.
#include "gridcull/grid/outer_outline.h"

#include <algorithm>
#include <cmath>

#include "gridcull/grid/angular_hull.h"
#include "gridcull/grid/sight.h"
#include "gridcull/grid/silhouette_loop.h"

namespace gridcull {
namespace {

double sum_of_magnitudes(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// Greatest distance of a point of the hull, at least.
double longest(const PlacedPiece& hull) { return sum_of_magnitudes(hull.frame.origin) + hull.piece.reach; }

/// As sight_blur(), less what position and viewpoint add to both truth and computed points alike.
double view_error(const PlacedPiece& hull) { return 0x1p-47 * longest(hull); }

Vec3 world_vertex(const PlacedPiece& hull, std::size_t i) {
  return hull.frame.origin + hull.frame.rotation * hull.piece.vertex(i);
}

/// (b) of the claim.
bool holds_all(const PlacedPiece& hull, const Outline& out) {
  std::array<Vec3, ConvexPiece::max_vertices> points;
  const std::size_t n = hull.piece.vertex_count();
  for (std::size_t i = 0; i < n; ++i) points[i] = world_vertex(hull, i);
  for (int i = 0; i < out.count; ++i) {
    const Vec3& a = out.rays[static_cast<std::size_t>(i)];
    const Vec3& b = out.rays[static_cast<std::size_t>(i + 1 == out.count ? 0 : i + 1)];
    const Vec3 normal = glm::cross(a, b);
    // The product's rounding, for points up to longest(): below 2^-49 |a| |b| |p|.
    const double error = 0x1p-48 * glm::length(a) * glm::length(b) * longest(hull);
    const double least = error - 0.25 * hull.piece.slack * glm::length(normal);
    for (std::size_t k = 0; k < n; ++k) {
      if (!(glm::dot(normal, points[k]) >= least)) return false;
    }
  }
  return true;
}

bool can_be_seen_from(const PlacedPiece& hull) {
  return !hull.piece.empty() && sight_blur(hull.piece, hull.frame) <= 0.5 * hull.piece.slack;
}

/// (a)'s demand, with `height` for h.
bool high_enough(const PlacedPiece& hull, double height) {
  return 0.5 * height * hull.piece.slack >= longest(hull) * view_error(hull);
}

/// The distance of the hull itself, rounded down.
double distance_to(const PlacedPiece& hull, const VertexLoop& loop) {
  double distance = loop.height;
  if (hull.piece.kind == ConvexPiece::Kind::box) {
    Vec3 off = glm::abs(hull.frame.apex - hull.piece.centre) - hull.piece.half;
    off = {std::max(off.x, 0.0), std::max(off.y, 0.0), std::max(off.z, 0.0)};
    distance = glm::length(off);
  }
  return std::max(0.0, rounded_down(distance) - view_error(hull));
}

bool outline_of(const PlacedPiece& hull, Outline& out) {
  if (!can_be_seen_from(hull)) return false;
  VertexLoop loop;
  find_loop(hull.piece, hull.frame.apex, loop);
  if (loop.count == 0 || !high_enough(hull, loop.height)) return false;
  out.count = loop.count;
  double square = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(loop.count); ++i) {
    out.rays[i] = world_vertex(hull, loop.vertex[i]);
    square = std::max(square, glm::dot(out.rays[i], out.rays[i]));
  }
  out.nearest = distance_to(hull, loop);
  out.farthest = rounded_up(std::sqrt(square)) + view_error(hull);
  return loop.doubt > view_error(hull) || holds_all(hull, out);
}

/// Points that span the part of the front faces with low <= dot(m, p) <= high.
struct SlabPoints {
  std::array<SeenPoint, most_seen_points> points;
  std::size_t count = 0;
  bool full = false;

  void add(const Vec3& p) {
    if (count == points.size()) {
      full = true;
    } else {
      points[count++].point = p;
    }
  }
};

void clip_edge(const Vec3& a, const Vec3& b, double at_a, double at_b, double low, double high, SlabPoints& out) {
  for (const double limit : {low, high}) {
    if ((at_a < limit) != (at_b < limit)) out.add(a + ((limit - at_a) / (at_b - at_a)) * (b - a));
  }
}

bool sees_face(const PlacedPiece& hull, std::size_t face) {
  const ConvexPiece::Plane plane = hull.piece.plane(face);
  return glm::dot(plane.normal, hull.frame.apex) - plane.offset > -view_error(hull);
}

/// Vertices and cut edges of faces that see the viewpoint or may do so.
void slab_points(const PlacedPiece& hull, const Vec3& m, double low, double high, SlabPoints& out) {
  std::uint64_t seen = 0, used = 0;
  for (std::size_t f = 0; f < hull.piece.face_count(); ++f) seen |= std::uint64_t{sees_face(hull, f)} << f;
  std::array<Vec3, ConvexPiece::max_vertices> points;
  std::array<double, ConvexPiece::max_vertices> at;
  for (std::size_t i = 0; i < hull.piece.vertex_count(); ++i) {
    points[i] = world_vertex(hull, i);
    at[i] = glm::dot(m, points[i]);
  }
  for (const auto& edge : hull.piece.all_edges()) {
    if (((seen >> edge.left | seen >> edge.right) & 1) == 0) continue;
    used |= std::uint64_t{1} << edge.from | std::uint64_t{1} << edge.to;
    clip_edge(points[edge.from], points[edge.to], at[edge.from], at[edge.to], low, high, out);
  }
  for (std::size_t i = 0; i < hull.piece.vertex_count(); ++i) {
    if ((used >> i & 1) != 0 && low <= at[i] && at[i] <= high) out.add(points[i]);
  }
}

}  // namespace

bool outer_outline(const PlacedPiece& hull, Outline& out) { return outline_of(hull, out); }

Slice outer_slice(const PlacedPiece& hull, double near, double far, Outline& out) {
  Outline whole;
  if (!outline_of(hull, whole)) return Slice::unknown;
  const Vec3 towards = hull.frame.origin + hull.frame.rotation * hull.piece.centre;
  const double length = glm::length(towards);
  if (!(length > 0.0)) return Slice::unknown;
  const Vec3 m = towards / length;
  double cosine = 1.0;
  for (int i = 0; i < whole.count; ++i) {
    const Vec3& ray = whole.rays[static_cast<std::size_t>(i)];
    cosine = std::min(cosine, glm::dot(m, ray) / glm::length(ray));
  }
  const double low = rounded_down(near * (cosine - 0x1p-40)) - hull.piece.slack;
  const double high = rounded_up(far) * (1.0 + 0x1p-40) + hull.piece.slack;
  if (!(cosine > 0.25) || !high_enough(hull, cosine * whole.nearest)) return Slice::unknown;
  SlabPoints points;
  slab_points(hull, m, low, high, points);
  if (points.count < 3) return Slice::empty;
  if (points.full) return Slice::unknown;
  if (!angular_hull({points.points.data(), points.count}, m, out) || out.count < 3) return Slice::unknown;
  out.nearest = std::max(near, whole.nearest);
  out.farthest = std::min(far, whole.farthest);
  return Slice::outline;
}

}  // namespace gridcull
