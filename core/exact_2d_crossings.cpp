// Pairs by sort and sweep over x (D. Baraff, "Dynamic simulation of non-penetrating rigid bodies", 1992,
// section 2.3), crossings by school formulas: they only say where to cut the sweep, so an error of rounding moves
// a cut by about as much as the sweep ignores anyway.
#include "gridcull/core/exact_2d_crossings.h"

#include <algorithm>

namespace gridcull::exact {
namespace {

/// Parameters this far outside a segment still count: a needless cut costs little, a missing one an answer.
constexpr double padding = 1e-9;

class Crossings {
 public:
  Crossings(const Surroundings& around, std::vector<double>& turns) : around_(around), turns_(turns) {}

  void pair(const Wall& p, const Wall& q) {
    if (p.radius > 0.0 && q.radius > 0.0) return discs(p.a, p.radius, q.a, q.radius);
    if (p.radius > 0.0) return disc_and_segment(p.a, p.radius, q);
    if (q.radius > 0.0) return disc_and_segment(q.a, q.radius, p);
    segments(p, q);
  }

  void with_range(const Wall& p) {
    if (p.radius > 0.0) return discs(p.a, p.radius, Vec2(0.0), around_.range);
    disc_and_segment(Vec2(0.0), around_.range, p);
  }

 private:
  void cut(const Vec2& point) {
    if (point.x != 0.0 || point.y != 0.0) turns_.push_back(turn_of(point));
  }

  void segments(const Wall& p, const Wall& q) {
    const double den = cross2(p.along, q.along);
    if (den == 0.0) return;  // parallel: they meet at ends, which are cuts already
    const Vec2 d = q.a - p.a;
    const double t = cross2(d, q.along) / den, u = cross2(d, p.along) / den;
    if (std::fabs(t - 0.5) > 0.5 + padding || std::fabs(u - 0.5) > 0.5 + padding) return;
    cut(p.a + t * p.along);
  }

  void disc_and_segment(const Vec2& centre, double radius, const Wall& wall) {
    const Vec2 d = wall.a - centre;
    const double a = glm::dot(wall.along, wall.along), b = glm::dot(d, wall.along);
    const double c = (glm::length(d) - radius) * (glm::length(d) + radius);
    const double square = b * b - a * c;
    if (!(square >= 0.0 && a > 0.0)) return;
    const double root = std::sqrt(square);
    for (const double t : {(-b - root) / a, (-b + root) / a}) {
      if (std::fabs(t - 0.5) <= 0.5 + padding) cut(wall.a + t * wall.along);
    }
  }

  void discs(const Vec2& a, double r, const Vec2& b, double s) {
    const Vec2 d = b - a;
    const double distance = glm::length(d);
    if (!(distance > 0.0) || distance > r + s || distance < std::fabs(r - s)) return;
    const double along = 0.5 * (distance + (r - s) * (r + s) / distance);
    const double across = std::sqrt(std::max(0.0, (r - along) * (r + along)));
    const Vec2 unit = d / distance, left(-unit.y, unit.x);
    cut(a + along * unit + across * left);
    cut(a + along * unit - across * left);
  }

  const Surroundings& around_;
  std::vector<double>& turns_;
};

/// A wall's box, clipped to the range's.
struct Box {
  double x0, x1, y0, y1;
  std::uint32_t wall;
};

Box box_of(const Wall& w, std::uint32_t index, double range) {
  const Vec2 low = w.radius > 0.0 ? w.a - Vec2(w.radius) : glm::min(w.a, w.a + w.along);
  const Vec2 high = w.radius > 0.0 ? w.a + Vec2(w.radius) : glm::max(w.a, w.a + w.along);
  return {std::max(low.x, -range), std::min(high.x, range), std::max(low.y, -range), std::min(high.y, range), index};
}

}  // namespace

void add_crossings(const Surroundings& around, std::vector<double>& turns) {
  Crossings crossings(around, turns);
  std::vector<Box> boxes;
  boxes.reserve(around.walls.size());
  for (std::uint32_t i = 0; i < around.walls.size(); ++i) {
    const Wall& w = around.walls[i];
    if (w.nearest > around.range) continue;
    boxes.push_back(box_of(w, i, around.range));
    if (std::isfinite(around.range)) crossings.with_range(w);
  }
  std::sort(boxes.begin(), boxes.end(),
            [](const Box& p, const Box& q) { return p.x0 < q.x0 || (p.x0 == q.x0 && p.wall < q.wall); });
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& p = boxes[i];
    const Wall& wall = around.walls[p.wall];
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].x0 <= p.x1; ++j) {
      const Box& q = boxes[j];
      if (q.y0 > p.y1 || p.y0 > q.y1) continue;
      const Wall& other = around.walls[q.wall];
      if (wall.body == other.body) continue;
      if (around.bodies[wall.body].occluder || around.bodies[other.body].occluder) crossings.pair(wall, other);
    }
  }
}

}  // namespace gridcull::exact
