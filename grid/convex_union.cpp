// Claim. Let A and B be convex polygons in one plane that have a point in common, H the hull of both. If H's border
// lies in A or B, then so does H: A and B are star-shaped about the common point, so their union is, and a closed set
// that is star-shaped and holds a closed curve's points holds what the curve encloses. An edge of H between two corners
// of A is in A. An edge from a corner of A to one of B is in their union if an edge of A and an edge of B lie on its
// line (a supporting line, so nothing else of A or B does) and, along it, A's does not end before B's begins. Then they
// also have a point in common. At least one edge of H leads from A to B, or one holds the other.
//
// All signs are exact: the plane by side_of_plane(), the rest in the projection along an axis that the plane
// is not parallel to, which keeps lines, order and convexity.
#include "gridcull/grid/convex_union.h"

#include <algorithm>

#include "gridcull/grid/exact_side.h"

namespace gridcull {
namespace {

/// A corner in the projection and where it comes from.
struct Corner {
  Vec2 at;
  Vec3 point;
  bool in_a, in_b;
};

/// The projection's axes, or none when the first three corners are in line in all of them.
struct Axes {
  int u = -1, v = -1;
};

Axes axes_of(const FlatPolygon& p) {
  const Vec3 n = glm::abs(glm::cross(p[1] - p[0], p[2] - p[0]));
  Axes axes = n.x >= n.y && n.x >= n.z ? Axes{1, 2} : n.y >= n.z ? Axes{2, 0} : Axes{0, 1};
  const auto on = [&](const Vec3& q) { return Vec2(q[axes.u], q[axes.v]); };
  return side_of_line(on(p[0]), on(p[1]), on(p[2])) == 0 ? Axes{} : axes;
}

bool before(const Vec2& p, const Vec2& q) { return p.x < q.x || (p.x == q.x && p.y < q.y); }

std::vector<Corner> all_corners(const FlatPolygon& a, const FlatPolygon& b, const Axes& axes) {
  std::vector<Corner> out;
  for (const Vec3& p : a) out.push_back({{p[axes.u], p[axes.v]}, p, true, false});
  for (const Vec3& p : b) {
    const Vec2 at(p[axes.u], p[axes.v]);
    const auto same = std::find_if(out.begin(), out.end(), [&](const Corner& c) { return c.at == at; });
    if (same == out.end()) {
      out.push_back({at, p, false, true});
    } else {
      same->in_b = true;
    }
  }
  std::sort(out.begin(), out.end(), [](const Corner& p, const Corner& q) { return before(p.at, q.at); });
  return out;
}

/// A. M. Andrew's monotone chain, 1979.
std::vector<Corner> hull_of(std::vector<Corner> points) {
  std::vector<Corner> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const Corner& p : points) {
      while (hull.size() >= base + 2 && side_of_line(hull[hull.size() - 2].at, hull.back().at, p.at) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The corners of one polygon on the line, the farthest along it from `from` on (they start there or end at `to`).
struct Reach {
  Vec2 first, last;
  bool any = false;
};

Reach reach_of(const std::vector<Corner>& points, bool of_a, const Vec2& from, const Vec2& to) {
  Reach reach;
  const bool forward = before(from, to);
  for (const Corner& c : points) {
    if (!(of_a ? c.in_a : c.in_b) || side_of_line(from, to, c.at) != 0) continue;
    if (!reach.any) {
      reach = {c.at, c.at, true};
    } else if (before(c.at, reach.first) == forward) {
      reach.first = c.at;
    } else if (before(reach.last, c.at) == forward) {
      reach.last = c.at;
    }
  }
  return reach;
}

/// Whether the hull's edge lies in the union.
bool is_covered(const std::vector<Corner>& points, const Corner& p, const Corner& q) {
  if ((p.in_a && q.in_a) || (p.in_b && q.in_b)) return true;
  const Reach start = reach_of(points, p.in_a, p.at, q.at), end = reach_of(points, !p.in_a, p.at, q.at);
  const bool forward = before(p.at, q.at);
  return start.last == end.first || before(end.first, start.last) == forward;
}

bool in_plane_of(const FlatPolygon& a, const FlatPolygon& b) {
  return std::all_of(b.begin(), b.end(), [&](const Vec3& p) { return side_of_plane(a[0], a[1], a[2], p) == 0; });
}

}  // namespace

bool is_flat_and_convex(const FlatPolygon& p) {
  if (p.size() < 3 || !in_plane_of(p, p)) return false;
  const Axes axes = axes_of(p);
  return axes.u >= 0 && hull_of(all_corners(p, p, axes)).size() == p.size();
}

std::optional<FlatPolygon> convex_union(const FlatPolygon& a, const FlatPolygon& b) {
  if (!in_plane_of(a, b)) return std::nullopt;
  const Axes axes = axes_of(a);
  if (axes.u < 0) return std::nullopt;
  const std::vector<Corner> points = all_corners(a, b, axes);
  const std::vector<Corner> hull = hull_of(points);
  FlatPolygon out;
  bool all_a = true, all_b = true;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (!is_covered(points, hull[i], hull[(i + 1) % hull.size()])) return std::nullopt;
    out.push_back(hull[i].point);
    all_a = all_a && hull[i].in_a, all_b = all_b && hull[i].in_b;
  }
  // One holds the other: nothing is gained.
  if (all_a || all_b) return std::nullopt;
  return out;
}

}  // namespace gridcull
