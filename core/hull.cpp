// Incremental convex hull with exact orientation signs: M. de Berg et al., "Computational Geometry", chapter 11,
// without its conflict graph (hulls here have at most some 1,000 points). A facet is replaced only when the new
// point lies strictly beyond it; the signs being exact, the replaced facets always form a disc, and coplanar,
// collinear and repeated points need no special case.
//
// Planes are rounded, so they come afterwards: facets by falling area share the first plane they all but lie in,
// and each plane is pushed out until it holds every input point.
//
// Why `margin` suffices. Let T be the closed surface of the triangles, K the hull, and let q satisfy
// dot(n, q) >= offset + margin for every side n, where every vertex v of every triangle of that side has
// dot(n, v) < offset + margin. On T there is a continuous field N: the side's normal inside each triangle, blended
// over edges and about vertices; every blend is a convex combination of normals of sides that hold that point of
// T, so dot(N(x), q - x) > 0 everywhere. N is therefore never zero and turns into q - x without vanishing: T winds
// about q as often as N winds about 0, the same for every such q. T encloses the first tetrahedron's volume once,
// so that number is 1, and a point that T winds about lies in K. (Were K so thin that no enclosed point satisfied
// the condition, no point would.) Nothing was assumed about how facets were merged.
#include "gridcull/core/hull.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/core/predicates.h"

namespace gridcull {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Flat: no point farther from a plane than this times the set's extent (as core/shape.h's validate()).
constexpr double flatness = 1e-9;
/// Facets this near a side's plane, relative to the coordinates' size, share it.
constexpr double merge_tolerance = 1e-12;

double largest_coordinate(const std::vector<Vec3>& points) {
  double size = 0.0;
  for (const Vec3& p : points) size = std::max({size, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return size;
}

/// Index of the point with the greatest measure.
template <class Measure>
std::uint32_t farthest(const std::vector<Vec3>& points, const Measure& measure) {
  std::uint32_t best = 0;
  double most = -1.0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double m = measure(points[i]);
    if (m > most) most = m, best = i;
  }
  return best;
}

/// Four points that span a volume: far from the first, from their line, from their plane. None when flat.
std::optional<std::array<std::uint32_t, 4>> first_tetrahedron(const std::vector<Vec3>& points) {
  if (points.size() < 4) return std::nullopt;
  const Vec3 a = points.front();
  const std::uint32_t i = farthest(points, [&](const Vec3& p) { return glm::length(p - a); });
  const double extent = glm::length(points[i] - a);
  if (!(extent > 0.0)) return std::nullopt;
  const Vec3 along = (points[i] - a) / extent;
  const auto off_line = [&](const Vec3& p) { return glm::length(glm::cross(along, p - a)); };
  const std::uint32_t j = farthest(points, off_line);
  if (!(off_line(points[j]) > flatness * extent)) return std::nullopt;
  const Vec3 normal = glm::normalize(glm::cross(along, points[j] - a));
  const auto off_plane = [&](const Vec3& p) { return std::fabs(glm::dot(normal, p - a)); };
  const std::uint32_t k = farthest(points, off_plane);
  if (!(off_plane(points[k]) > flatness * extent)) return std::nullopt;
  const int side = orientation(a, points[i], points[j], points[k]);
  if (side == 0) return std::nullopt;
  return side < 0 ? std::array<std::uint32_t, 4>{0, i, j, k} : std::array<std::uint32_t, 4>{0, j, i, k};
}

/// Adds one point: facets that it lies beyond give way to a fan over their border.
void insert(const std::vector<Vec3>& points, std::uint32_t p, std::vector<Triangle>& facets) {
  const auto beyond = [&](const Triangle& t) {
    return orientation(points[t[0]], points[t[1]], points[t[2]], points[p]) > 0;
  };
  const auto seen = std::stable_partition(facets.begin(), facets.end(), [&](const Triangle& t) { return !beyond(t); });
  if (seen == facets.end()) return;
  std::map<std::array<std::uint32_t, 2>, int> edges;
  for (auto t = seen; t != facets.end(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{(*t)[k], (*t)[(k + 1) % 3]}];
  }
  facets.erase(seen, facets.end());
  for (const auto& [edge, count] : edges) {
    if (!edges.contains({edge[1], edge[0]})) facets.push_back({edge[0], edge[1], p});
  }
}

std::vector<Triangle> hull_facets(const std::vector<Vec3>& points, const std::array<std::uint32_t, 4>& t) {
  std::vector<Triangle> facets{{t[0], t[1], t[2]}, {t[0], t[3], t[1]}, {t[1], t[3], t[2]}, {t[2], t[3], t[0]}};
  for (std::uint32_t p = 0; p < points.size(); ++p) insert(points, p, facets);
  return facets;
}

/// Twice the area, along the outward normal.
Vec3 area_normal(const std::vector<Vec3>& points, const Triangle& t) {
  return glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

/// Least and greatest of dot(normal, vertex).
std::array<double, 2> spread(const std::vector<Vec3>& points, const Triangle& t, const Vec3& normal) {
  const double a = glm::dot(normal, points[t[0]]), b = glm::dot(normal, points[t[1]]);
  const double c = glm::dot(normal, points[t[2]]);
  return {std::min({a, b, c}), std::max({a, b, c})};
}

/// The half-space with this outward direction that just holds all points.
HalfSpace supporting(const std::vector<Vec3>& points, const Vec3& outward) {
  HalfSpace side{-outward, std::numeric_limits<double>::infinity()};
  for (const Vec3& p : points) side.offset = std::min(side.offset, glm::dot(side.normal, p));
  return side;
}

void add_sides(const std::vector<Vec3>& points, Hull& hull) {
  std::vector<double> area(hull.triangles.size());
  for (std::size_t i = 0; i < area.size(); ++i) area[i] = glm::length(area_normal(points, hull.triangles[i]));
  std::vector<std::size_t> order(area.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });
  const double size = largest_coordinate(points);
  double widest = 0.0;
  for (const std::size_t i : order) {
    const Triangle& t = hull.triangles[i];
    const auto reaches = [&](const HalfSpace& side) { return spread(points, t, side.normal)[1] - side.offset; };
    const auto shared = std::find_if(hull.sides.begin(), hull.sides.end(),
                                     [&](const HalfSpace& side) { return reaches(side) <= merge_tolerance * size; });
    if (shared != hull.sides.end()) {
      widest = std::max(widest, reaches(*shared));
      continue;
    }
    // An area that rounds to 0 has no direction; its triangle must lie in some side's slab.
    if (!(area[i] > 0.0)) {
      double least = std::numeric_limits<double>::infinity();
      for (const HalfSpace& side : hull.sides) least = std::min(least, reaches(side));
      widest = std::max(widest, least);
      continue;
    }
    hull.sides.push_back(supporting(points, area_normal(points, t) / area[i]));
    widest = std::max(widest, reaches(hull.sides.back()));
  }
  // Both dot products round: below 4 ulp of the sum of magnitudes, itself below 3 * 2 * size, on either side.
  hull.margin = widest * (1.0 + 1e-15) + 1e-14 * size;
}

bool box_holds(const std::vector<Vec3>& points, const Vec3& point) {
  Bounds box;
  for (const Vec3& p : points) box.add(p);
  for (int k = 0; k < 3; ++k) {
    if (!(box.min[k] < point[k] && point[k] < box.max[k])) return false;
  }
  return true;
}

bool facets_hold(const std::vector<Vec3>& points, const std::vector<Triangle>& facets, const Vec3& point) {
  return std::all_of(facets.begin(), facets.end(), [&](const Triangle& t) {
    return orientation(points[t[0]], points[t[1]], points[t[2]], point) < 0;
  });
}

}  // namespace

Hull convex_hull(const std::vector<Vec3>& points) {
  const auto start = first_tetrahedron(points);
  if (!start) throw Error(ErrorCode::bad_scene, "convex: expected at least four points, not all in one plane");
  Hull hull;
  hull.triangles = hull_facets(points, *start);
  add_sides(points, hull);
  return hull;
}

bool hull_holds(const std::vector<Vec3>& points, const Vec3& point) {
  if (!box_holds(points, point)) return false;
  const auto start = first_tetrahedron(points);
  return start && facets_hold(points, hull_facets(points, *start), point);
}

bool hull_holds(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, const Vec3& point) {
  return box_holds(points, point) && facets_hold(points, triangles, point);
}

}  // namespace gridcull
