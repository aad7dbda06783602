// Greedy joining (S. Hertel and K. Mehlhorn, "Fast triangulation of the plane with respect to simple polygons", 1983,
// section 3): a shared edge is dropped when its two polygons lie in one plane and both corners stay convex. Each
// polygon keeps its corners as numbers of distinct points; the points are the shape's own, so that nothing is rounded.
#include "gridcull/grid/flat_polygons.h"

#include <algorithm>
#include <map>

#include "gridcull/grid/exact_side.h"

namespace gridcull {
namespace {

using Corners = std::vector<std::uint32_t>;

constexpr std::size_t most_corners = 32;

/// Looks along the axis in which the plane's projection is largest.
struct Projection {
  int u = 0, v = 1;
  Vec2 of(const Vec3& p) const { return {p[u], p[v]}; }
};

class Joiner {
 public:
  Joiner(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::map<std::array<double, 3>, std::uint32_t> number;
    for (const auto& t : triangles) {
      Corners c;
      for (const std::uint32_t i : t) {
        const Vec3& p = vertices[i];
        // Adding 0.0 makes one zero of two.
        const auto [at, is_new] =
            number.insert({{p.x + 0.0, p.y + 0.0, p.z + 0.0}, static_cast<std::uint32_t>(points_.size())});
        if (is_new) points_.push_back(p);
        c.push_back(at->second);
      }
      if (has_area(c)) polygons_.push_back(c);
    }
  }

  std::vector<FlatPolygon> join() {
    while (join_some()) {
    }
    std::vector<FlatPolygon> out;
    for (const Corners& c : polygons_) {
      FlatPolygon polygon;
      for (const std::uint32_t i : c) polygon.push_back(points_[i]);
      out.push_back(std::move(polygon));
    }
    return out;
  }

 private:
  Projection projection_of(const Corners& c) const {
    const Vec3 n = glm::abs(glm::cross(points_[c[1]] - points_[c[0]], points_[c[2]] - points_[c[0]]));
    if (n.x >= n.y && n.x >= n.z) return {1, 2};
    return n.y >= n.z ? Projection{2, 0} : Projection{0, 1};
  }

  int turn(const Projection& view, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return side_of_line(view.of(points_[a]), view.of(points_[b]), view.of(points_[c]));
  }

  bool has_area(const Corners& c) const { return turn(projection_of(c), c[0], c[1], c[2]) != 0; }

  /// One pass over all shared edges. Edges are keyed by their ends, whatever the polygons' turns.
  bool join_some() {
    std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> at_edge;
    for (std::size_t p = 0; p < polygons_.size(); ++p) {
      const Corners& c = polygons_[p];
      for (std::size_t i = 0; i < c.size(); ++i) {
        const auto ends = std::minmax(c[i], c[(i + 1) % c.size()]);
        at_edge[{ends.first, ends.second}].push_back(p);
      }
    }
    bool joined = false;
    for (const auto& [edge, owners] : at_edge) {
      // The owners' numbers go stale as soon as one of them was joined: those wait for the next pass.
      for (std::size_t i = 0; i + 1 < owners.size(); ++i) {
        for (std::size_t j = i + 1; j < owners.size(); ++j) joined = join_two(owners[i], owners[j], edge) || joined;
      }
    }
    std::erase_if(polygons_, [](const Corners& c) { return c.empty(); });
    return joined;
  }

  bool join_two(std::size_t p, std::size_t q, const std::array<std::uint32_t, 2>& edge) {
    Corners a = polygons_[p], b = polygons_[q];
    if (p == q || a.size() + b.size() > most_corners + 2) return false;
    if (!open_at(a, edge) || !open_at(b, edge)) return false;
    const Projection view = projection_of(a);
    for (const std::uint32_t i : b) {
      if (side_of_plane(points_[a[0]], points_[a[1]], points_[a[2]], points_[i]) != 0) return false;
    }
    // a runs edge end -> ... -> edge start, b the other way round: a's start is b's end.
    if (a.front() == b.front()) std::reverse(b.begin(), b.end());
    Corners both(a.begin(), a.end());
    both.insert(both.end(), b.begin() + 1, b.end() - 1);
    Corners corners = without_straight(view, both);
    if (!convex(view, corners)) return false;
    polygons_[p] = std::move(corners);
    polygons_[q].clear();
    return true;
  }

  /// Turns the loop until it runs from one end of the edge all the way round to the other. False when it no longer has
  /// the edge.
  static bool open_at(Corners& c, const std::array<std::uint32_t, 2>& edge) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      const std::uint32_t a = c[i], b = c[(i + 1) % c.size()];
      if ((a == edge[0] && b == edge[1]) || (a == edge[1] && b == edge[0])) {
        std::rotate(c.begin(), c.begin() + static_cast<std::ptrdiff_t>((i + 1) % c.size()), c.end());
        return true;
      }
    }
    return false;
  }

  /// A corner in the middle of a straight side goes, never a spike's tip: that makes the loop not convex.
  Corners without_straight(const Projection& view, const Corners& c) const {
    Corners out;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const std::uint32_t before = c[(i + c.size() - 1) % c.size()], after = c[(i + 1) % c.size()];
      const bool on = glm::dot(points_[c[i]] - points_[before], points_[after] - points_[c[i]]) > 0.0;
      if (turn(view, before, c[i], after) != 0 || !on) out.push_back(c[i]);
    }
    return out;
  }

  /// Strictly: each corner on the same side of each edge.
  bool convex(const Projection& view, const Corners& c) const {
    if (c.size() < 3) return false;
    const int side = turn(view, c[0], c[1], c[2]);
    for (std::size_t i = 0; side != 0 && i < c.size(); ++i) {
      const std::size_t j = (i + 1) % c.size();
      for (std::size_t k = 0; k < c.size(); ++k) {
        if (k != i && k != j && turn(view, c[i], c[j], c[k]) != side) return false;
      }
    }
    return side != 0;
  }

  std::vector<Vec3> points_;
  std::vector<Corners> polygons_;
};

}  // namespace

std::vector<FlatPolygon> join_triangles(const std::vector<Vec3>& vertices,
                                        const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  return Joiner(vertices, triangles).join();
}

}  // namespace gridcull
