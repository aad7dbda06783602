// Pairs of edges by sort and sweep over x (D. Baraff, "Dynamic simulation of non-penetrating rigid bodies", 1992,
// section 2.3): outlines have up to thousands of points, and this is done once a shape.
#include "gridcull/grid/outline_parts.h"

#include <algorithm>
#include <cmath>

namespace gridcull {
namespace {

struct Edge {
  Vec2 a, b;
  double low, high;  // x
  std::uint32_t index;
};

/// Calls f(edge, edge) for pairs whose boxes come within `reach`.
template <class F>
void for_each_pair(std::span<const Vec2> points, double reach, F&& f) {
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
    edges.push_back({a, b, std::min(a.x, b.x), std::max(a.x, b.x), static_cast<std::uint32_t>(i)});
  }
  std::sort(edges.begin(), edges.end(),
            [](const Edge& p, const Edge& q) { return p.low < q.low || (p.low == q.low && p.index < q.index); });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge& p = edges[i];
    for (std::size_t j = i + 1; j < edges.size() && edges[j].low <= p.high + reach; ++j) {
      const Edge& q = edges[j];
      if (std::min(p.a.y, p.b.y) > std::max(q.a.y, q.b.y) + reach) continue;
      if (std::min(q.a.y, q.b.y) > std::max(p.a.y, p.b.y) + reach) continue;
      f(p, q);
    }
  }
}

double distance(const Vec2& p, const Edge& e) {
  const Vec2 d = e.b - e.a;
  const double square = glm::dot(d, d);
  const double t = square > 0.0 ? std::clamp(glm::dot(p - e.a, d) / square, 0.0, 1.0) : 0.0;
  return glm::length(p - (e.a + t * d));
}

/// Whether each has its ends on both sides of the other. Plain doubles do: an end within rounding of the other's line
/// lies within rounding of the other edge, or that one's end of this edge, if they cross at all; distances tell.
bool cross(const Edge& p, const Edge& q) {
  const auto apart = [](const Edge& e, const Edge& f) {
    const Vec2 d = e.b - e.a;
    const double from = cross2(d, f.a - e.a), to = cross2(d, f.b - e.a);
    return (from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0);
  };
  return apart(p, q) && apart(q, p);
}

double distance(const Edge& p, const Edge& q, std::size_t count) {
  if ((p.index + 1) % count == q.index) return std::min(distance(q.b, p), distance(p.a, q));
  if ((q.index + 1) % count == p.index) return std::min(distance(p.b, q), distance(q.a, p));
  const double ends = std::min({distance(p.a, q), distance(p.b, q), distance(q.a, p), distance(q.b, p)});
  return ends > 0.0 && cross(p, q) ? 0.0 : ends;
}

/// Whether the edges leave a common point at more than a thousandth of a radian.
bool fork(const Edge& p, const Edge& q) {
  const auto apart = [](const Vec2& u, const Vec2& v) {
    return glm::dot(u, v) < 0.0 || std::fabs(cross2(u, v)) > 1e-3 * glm::length(u) * glm::length(v);
  };
  bool common = false;
  for (const bool p_end : {false, true}) {
    for (const bool q_end : {false, true}) {
      const Vec2 &from = p_end ? p.b : p.a, &p_to = p_end ? p.a : p.b;
      if (from != (q_end ? q.b : q.a)) continue;
      common = true;
      if (!apart(p_to - from, (q_end ? q.a : q.b) - from)) return false;
    }
  }
  return common;
}

struct Range {
  double low, high;
};

/// Grows `range` by the t at which p lies within `reach` of `centre`. Over-estimated.
void add_disc(const Edge& p, const Vec2& centre, double reach, Range& range) {
  const Vec2 d = p.b - p.a;
  const double square = glm::dot(d, d);
  const double t = glm::dot(centre - p.a, d) / square;
  const Vec2 off = centre - (p.a + t * d);
  const double rest = reach * reach - glm::dot(off, off);
  if (rest < 0.0) return;
  const double half = std::sqrt(rest / square);
  range.low = std::min(range.low, t - half);
  range.high = std::max(range.high, t + half);
}

/// The t of p within `reach` of q, over-estimated: the region about q is convex, bounded by two lines and two
/// half discs, so the range ends on one of these.
Range near(const Edge& p, const Edge& q, double reach) {
  Range range{2.0, -1.0};
  add_disc(p, q.a, reach, range);
  add_disc(p, q.b, reach, range);
  const Vec2 along = q.b - q.a, d = p.b - p.a;
  const double length = glm::length(along), slope = cross2(along, d) / length;
  for (const double side : {-reach, reach}) {
    const double t = (side - cross2(along, p.a - q.a) / length) / slope;
    const double u = glm::dot(p.a + t * d - q.a, along) / (length * length);
    if (!(u >= 0.0 && u <= 1.0)) continue;  // also not a number: parallel
    range.low = std::min(range.low, t);
    range.high = std::max(range.high, t);
  }
  return range;
}

}  // namespace

double clearance_of(std::span<const Vec2> points, double enough) {
  double least = enough;
  for_each_pair(points, enough,
                [&](const Edge& p, const Edge& q) { least = std::min(least, distance(p, q, points.size())); });
  return least;
}

void usable_parts(std::span<const Vec2> points, double least, std::vector<Outline2D::Part>& out) {
  std::vector<std::vector<Range>> taken(points.size());
  for_each_pair(points, 2.0 * least, [&](const Edge& p, const Edge& q) {
    if (fork(p, q)) return;
    taken[p.index].push_back(near(p, q, 2.0 * least));
    taken[q.index].push_back(near(q, p, 2.0 * least));
  });
  out.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& ranges = taken[i];
    std::sort(ranges.begin(), ranges.end(), [](const Range& p, const Range& q) { return p.low < q.low; });
    double t = 0.0;
    for (const Range& r : ranges) {
      if (r.low > r.high || r.low >= 1.0) continue;
      if (r.low > t) out.push_back({static_cast<std::uint32_t>(i), t, r.low});
      t = std::max(t, r.high);
    }
    if (t < 1.0) out.push_back({static_cast<std::uint32_t>(i), t, 1.0});
  }
}

}  // namespace gridcull
