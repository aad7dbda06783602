// Claim (lies_inside). A strictly convex part that no wall's closed segment meets in its open interior lies in one
// component of the plane without the outline, so the even-odd rule answers alike for all its points: one point decides.
// A segment and a convex polygon have disjoint interiors if and only if the line of one of the polygon's edges or the
// segment's own line separates them (separating axes; their Minkowski difference has no other edges). Both
// questions are signs of side_of_line(), which are exact.
#include "gridcull/grid/convex_cut.h"

#include <algorithm>
#include <array>
#include <map>

#include "gridcull/core/shape.h"
#include "gridcull/grid/exact_side.h"

namespace gridcull {

std::vector<Wall> walls_of(const std::vector<Vec2>& outline) {
  const std::vector<Vec2> points = merged_outline(outline);
  std::map<std::array<double, 4>, int> odd;  // by its ends, the lesser first
  const auto key = [](Vec2 a, Vec2 b) {
    if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::swap(a, b);
    return std::array<double, 4>{a.x, a.y, b.x, b.y};
  };
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) odd[key(points[j], points[i])] ^= 1;
  std::vector<Wall> walls;
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    int& left = odd[key(points[j], points[i])];
    if (left != 0) walls.push_back({points[j], points[i]});
    left = 0;
  }
  return walls;
}

double area_of(const ConvexPart& part) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < part.size(); ++i) sum += cross2(part[i] - part[0], part[i + 1] - part[0]);
  return 0.5 * sum;
}

ConvexPart cut_left(const ConvexPart& part, const Vec2& a, const Vec2& b) {
  ConvexPart out;
  for (std::size_t i = 0, n = part.size(); i < n; ++i) {
    const Vec2 p = part[i], q = part[(i + 1) % n];
    const double at_p = cross2(b - a, p - a), at_q = cross2(b - a, q - a);
    const int side_p = side_of_line(a, b, p), side_q = side_of_line(a, b, q);
    if (side_p >= 0) out.push_back(p);
    if (side_p * side_q < 0 && at_p != at_q) {
      const double t = std::clamp(at_p / (at_p - at_q), 0.0, 1.0);
      out.push_back(p + t * (q - p));
    }
  }
  return out;
}

ConvexPart strictly_convex(const ConvexPart& part) {
  ConvexPart out = part;
  for (bool again = true; again && out.size() >= 3;) {
    again = false;
    for (std::size_t i = 0; i < out.size() && out.size() >= 3; ++i) {
      const Vec2 before = out[(i + out.size() - 1) % out.size()], after = out[(i + 1) % out.size()];
      if (side_of_line(before, out[i], after) > 0) continue;
      out.erase(out.begin() + static_cast<std::ptrdiff_t>(i));
      again = true;
      break;
    }
  }
  if (out.size() < 3) out.clear();
  return out;
}

bool intrudes(const Wall& wall, const ConvexPart& part) {
  bool any_left = false, any_right = false;
  for (std::size_t i = 0, j = part.size() - 1; i < part.size(); j = i++) {
    if (side_of_line(part[j], part[i], wall.a) <= 0 && side_of_line(part[j], part[i], wall.b) <= 0) return false;
    const int side = side_of_line(wall.a, wall.b, part[i]);
    any_left = any_left || side > 0;
    any_right = any_right || side < 0;
  }
  return any_left && any_right;
}

bool is_inside(const std::vector<Wall>& walls, const Vec2& point) {
  bool inside = false;
  for (const Wall& w : walls) {
    if ((w.a.y > point.y) == (w.b.y > point.y)) continue;
    const int side = side_of_line(w.a, w.b, point);
    if ((w.b.y > w.a.y) == (side > 0)) inside = !inside;
  }
  return inside;
}

bool lies_inside(const ConvexPart& part, const std::vector<Wall>& walls) {
  if (part.size() < 3) return false;
  Vec2 middle(0.0);
  for (std::size_t i = 0, n = part.size(); i < n; ++i) {
    // Locally convex and turning once in all: each corner to the left of each edge.
    for (std::size_t k = 0; k < n; ++k) {
      if (k != i && k != (i + 1) % n && side_of_line(part[i], part[(i + 1) % n], part[k]) <= 0) return false;
    }
    middle += part[i];
  }
  middle /= static_cast<double>(part.size());
  for (std::size_t i = 0, j = part.size() - 1; i < part.size(); j = i++) {
    if (side_of_line(part[j], part[i], middle) <= 0) return false;
  }
  return std::none_of(walls.begin(), walls.end(), [&](const Wall& w) { return intrudes(w, part); }) &&
         is_inside(walls, middle);
}

}  // namespace gridcull
