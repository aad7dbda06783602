// C. B. Barber, D. P. Dobkin, H. Huhdanpaa, "The quickhull algorithm for convex hulls", 1996. Changed: signs are exact
// (core/predicates.h), so that facets are never merged and no point lies outside the result.
//
// Claim. Every input point is in the hull of the listed vertices. A point is dropped only when it lies strictly beyond
// no facet that it may still see. Let a point q see (lie strictly beyond) facets of the hull so far; they are
// connected. When the facets that p sees are replaced, q is looked at again if it was listed at one of them. Suppose it
// still sees a kept facet but no new one: then along the way from a replaced facet that q sees to that kept one, q sees
// a replaced facet r and a kept s with a common edge; the new facet over that edge lies in the wedge between r and s,
// its functional is a sum of r's and s's with factors a > 0, b >= 0 (p is beyond r and not beyond s), so q is beyond
// it too. A contradiction: q is listed at a new facet, or inside.
#include "gridcull/core/quick_hull.h"

#include <algorithm>
#include <cmath>

#include "gridcull/core/predicates.h"
#include "gridcull/core/simplex.h"

namespace gridcull {
namespace {

constexpr std::uint32_t nothing = 0xFFFF'FFFFu;

struct Facet {
  std::array<std::uint32_t, 3> at{};    ///< points, counter-clockwise from outside
  std::array<std::uint32_t, 3> over{};  ///< the facet over the edge from at[k] to at[k + 1]
  std::vector<std::uint32_t> beyond{};  ///< points strictly beyond it, each listed once in all facets
  Vec3 normal{0.0};
  bool alive = true;
  std::uint32_t mark = 0;
};

class QuickHull {
 public:
  QuickHull(std::span<const Vec3> points, const std::array<std::uint32_t, 4>& first) : points_(points) {
    start(first);
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      while (facets_[f].alive && !facets_[f].beyond.empty()) raise(f);
    }
  }

  std::vector<std::array<std::uint32_t, 3>> triangles() const {
    std::vector<std::array<std::uint32_t, 3>> out;
    for (const Facet& f : facets_) {
      if (f.alive) out.push_back(f.at);
    }
    return out;
  }

 private:
  bool sees(std::uint32_t p, const Facet& f) const {
    return orientation(points_[f.at[0]], points_[f.at[1]], points_[f.at[2]], points_[p]) > 0;
  }

  std::uint32_t add(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Facet f;
    f.at = {a, b, c};
    f.normal = glm::cross(points_[b] - points_[a], points_[c] - points_[a]);
    facets_.push_back(std::move(f));
    return static_cast<std::uint32_t>(facets_.size() - 1);
  }

  void start(const std::array<std::uint32_t, 4>& t) {
    add(t[0], t[1], t[2]);
    add(t[0], t[3], t[1]);
    add(t[1], t[3], t[2]);
    add(t[2], t[3], t[0]);
    for (std::uint32_t f = 0; f < 4; ++f) {
      for (std::size_t k = 0; k < 3; ++k) facets_[f].over[k] = facet_with(facets_[f].at[(k + 1) % 3], facets_[f].at[k]);
    }
    for (std::uint32_t p = 0; p < points_.size(); ++p) list(p, 0);
  }

  std::uint32_t facet_with(std::uint32_t a, std::uint32_t b) const {
    for (std::uint32_t f = 0; f < 4; ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (facets_[f].at[k] == a && facets_[f].at[(k + 1) % 3] == b) return f;
      }
    }
    return nothing;
  }

  /// At the first facet from `first` on that the point lies beyond, if any.
  void list(std::uint32_t p, std::size_t first) {
    for (std::size_t f = first; f < facets_.size(); ++f) {
      if (sees(p, facets_[f])) return facets_[f].beyond.push_back(p);
    }
  }

  /// Takes the farthest point beyond the facet into the hull.
  void raise(std::uint32_t f) {
    const Facet& facet = facets_[f];
    const Vec3 base = points_[facet.at[0]];
    const std::uint32_t p = *std::max_element(facet.beyond.begin(), facet.beyond.end(), [&](auto a, auto b) {
      return glm::dot(facet.normal, points_[a] - base) < glm::dot(facet.normal, points_[b] - base);
    });
    find_border(f, p);
    const std::size_t first = facets_.size();
    // The border's edges, each followed by the one that starts where it ends.
    for (const Edge& edge : border_) {
      const std::uint32_t fresh = add(edge.from, edge.to, p);
      facets_[fresh].over = {edge.outer, nothing, nothing};
      facets_[edge.outer].over[edge.side] = fresh;
    }
    const auto count = static_cast<std::uint32_t>(border_.size());
    const auto base_index = static_cast<std::uint32_t>(first);
    for (std::uint32_t i = 0; i < count; ++i) {
      facets_[base_index + i].over[1] = base_index + (i + 1) % count;
      facets_[base_index + i].over[2] = base_index + (i + count - 1) % count;
    }
    for (const std::uint32_t old : gone_) {
      const std::vector<std::uint32_t> loose = std::move(facets_[old].beyond);
      facets_[old].beyond = {};
      for (const std::uint32_t q : loose) {
        if (q != p) list(q, first);
      }
    }
  }

  struct Edge {
    std::uint32_t from, to, outer;
    std::size_t side;  ///< of `outer`
  };

  /// The facets that p sees, into gone_, and their border, in order. Depth first, sides in turn: the border comes as
  /// one closed way round.
  void find_border(std::uint32_t f, std::uint32_t p) {
    border_.clear();
    gone_.clear();
    gone_.push_back(f);
    facets_[f].alive = false;
    stack_.clear();
    stack_.push_back({f, 0, 3});
    while (!stack_.empty()) {
      Step& step = stack_.back();
      if (step.left == 0) {
        stack_.pop_back();
        continue;
      }
      const std::uint32_t at = step.facet;
      const std::size_t k = step.side;
      step.side = (k + 1) % 3;
      --step.left;
      const std::uint32_t other = facets_[at].over[k];
      Facet& next = facets_[other];
      if (!next.alive) continue;
      const std::uint32_t from = facets_[at].at[k], to = facets_[at].at[(k + 1) % 3];
      std::size_t back = 0;
      while (next.at[back] != to) ++back;
      if (sees(p, next)) {
        next.alive = false;
        gone_.push_back(other);
        stack_.push_back({other, (back + 1) % 3, 2});
      } else {
        border_.push_back({from, to, other, back});
      }
    }
  }

  struct Step {
    std::uint32_t facet;
    std::size_t side, left;
  };

  std::span<const Vec3> points_;
  std::vector<Facet> facets_{};
  std::vector<Edge> border_{};
  std::vector<std::uint32_t> gone_{};
  std::vector<Step> stack_{};
};

/// Vertices in the order in which they are first named.
class BoundaryWriter {
 public:
  explicit BoundaryWriter(std::span<const Vec3> points) : points_(points), number_(points.size(), nothing) {}

  void face(std::span<const std::uint32_t> loop, const Vec3& normal) {
    out.faces.push_back(
        {normal, static_cast<std::uint32_t>(out.loops.size()), static_cast<std::uint32_t>(loop.size())});
    for (const std::uint32_t p : loop) out.loops.push_back(vertex(p));
  }
  std::uint32_t vertex(std::uint32_t p) {
    if (number_[p] == nothing) {
      number_[p] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(points_[p]);
    }
    return number_[p];
  }

  ConvexBoundary out{};

 private:
  std::span<const Vec3> points_;
  std::vector<std::uint32_t> number_;
};

ConvexBoundary flat_boundary(std::span<const Vec3> points, const Simplex& s) {
  BoundaryWriter writer(points);
  const Vec3 &a = points[s.at[0]], &b = points[s.at[1]], &c = points[s.at[2]];
  const auto [x, y] = s.axes;
  std::vector<std::uint32_t> ring = planar_hull(points, x, y);
  // The ring runs counter-clockwise in (x, y); a, b, c perhaps do not.
  Vec3 normal = unit(glm::cross(b - a, c - a));
  if (orientation(planar(a, x, y), planar(b, x, y), planar(c, x, y)) < 0) normal = -normal;
  writer.face(ring, normal);
  std::reverse(ring.begin(), ring.end());
  writer.face(ring, -normal);
  return std::move(writer.out);
}

/// The two ends of points on one line.
ConvexBoundary line_boundary(std::span<const Vec3> points) {
  const auto less = [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), less);
  ConvexBoundary out;
  out.vertices.push_back(*low);
  if (*low != *high) out.vertices.push_back(*high);
  return out;
}

}  // namespace

std::vector<std::uint32_t> planar_hull(std::span<const Vec3> points, int x, int y) {
  const auto at = [&](std::uint32_t i) { return planar(points[i], x, y); };
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec2 p = at(a), q = at(b);
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a < b;
  });
  order.erase(std::unique(order.begin(), order.end(), [&](auto a, auto b) { return at(a) == at(b); }), order.end());
  if (order.size() < 3) return order;
  std::vector<std::uint32_t> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t base = hull.size();
    for (const std::uint32_t p : order) {
      while (hull.size() >= base + 2 && orientation(at(hull[hull.size() - 2]), at(hull.back()), at(p)) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();  // the other side's first
    std::reverse(order.begin(), order.end());
  }
  return hull;
}

ConvexBoundary hull_boundary(std::span<const Vec3> points, int dimension) {
  if (dimension == 2) {
    const std::vector<std::uint32_t> ring = planar_hull(points, 0, 1);
    if (ring.size() < 3) return line_boundary(points);
    BoundaryWriter writer(points);
    writer.face(ring, {0.0, 0.0, 1.0});
    return std::move(writer.out);
  }
  const Simplex s = simplex_of(points);
  if (s.rank < 2) return line_boundary(points);
  if (s.rank == 2) return flat_boundary(points, s);
  BoundaryWriter writer(points);
  for (const auto& t : QuickHull(points, s.at).triangles()) {
    writer.face(t, unit(glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])));
  }
  return std::move(writer.out);
}

}  // namespace gridcull
