// Straight edges as a viewer sees them: directions by quadrant and slope, depth as a line over the slope.
//
// The viewer is the origin. Quadrant q holds the directions within 45 degrees of the axis q * 90 degrees; turned by
// that (swaps and signs only, exact), a point there has X > 0 and |Y| <= X, its slope is s = Y / X, -1 .. 1, and
// w = 1 / X orders depths along a direction: nearer is greater. A straight edge is a straight segment in (s, w), since
// n . p = 1 on its line gives w = nx + ny s. One formula for the slope of a point, whatever edge it ends, so edges
// with a common vertex leave no gap. Diagonals have the slopes 1 and -1, exactly.
//
// Rounding. u = 2^-53. Points relative to the viewer carry a relative error of u in each coordinate: one subtraction
// rounds once. Hence |error of s| <= 3 u. The line is n = (dy, -dx) / c with d = b - a, c = a x d:
//   - the error of c, below 4 u (|ax dy| + |ay dx|) with those of a and d, scales the whole line: relative error
//     4 u bulk / c;
//   - the errors of d's direction, of the division, of nx + ny s and of s itself are below 16 u (w + |ny|).
// World points carry roundings of their own, of a few ulp of the coordinates, so that walls meant to coincide do not.
// As in core/exact.h, places within 1e-12 of the coordinates' size M count as one: a line is moved by that, which
// scales w by 1 +- (1e-12 + 1e-12 M |n|). In all the true w, of whatever place counts as the same, lies within
//     w (1 +- m) +- sigma |ny|,  m = 1e-12 + 4 u bulk / c + 1e-12 M |n|, sigma = 16 u < 1e-12 / 100.
// `low` and `high` are the lines shifted by that, and by as much again for `high`. An edge hides with `low` and is
// tested with `high`: what is hidden only by the width of a rounding is seen, and so are walls that coincide.
// What rounding may do to the ends of edges (3 u of slope) can close a gap, or hide what sticks out, by less than
// that: what is visible in slopes of less than least_width altogether, or along edges narrower than 2^-38, counts as
// single rays. Not so where everything is as narrow as that: objects that seem smaller than `tiny` are tested as the
// discs around them, and they, and everything in a view narrower than that, are seen in any slope that is open
// (sight_2d.h).
#pragma once

#include <cmath>
#include <cstdint>

#include "gridcull/core/vec.h"

namespace gridcull {

/// What is visible in slopes of less than this altogether counts as hidden: 1.2e-10.
inline constexpr double least_width = 0x1p-33;
/// Radians: things and views narrower than this are too narrow for that rule.
inline constexpr double tiny = 0x1p-30;

/// w over the slopes of one quadrant.
struct SlopeLine {
  double a = 0.0, b = 0.0;
  double at(double s) const { return a + b * s; }
};

/// A direction as quadrant and slope, -1 <= slope < 1: diagonals belong to the quadrant after them.
struct Bearing {
  int quadrant;
  double slope;
};
inline Bearing bearing_of(const Vec2& p) {
  if (p.y < p.x) return p.y >= -p.x ? Bearing{0, p.y / p.x} : Bearing{3, -p.x / p.y};
  if (p.y > -p.x) return {1, -p.x / p.y};
  return p.y > p.x ? Bearing{2, p.y / p.x} : Bearing{3, -1.0};
}
/// Turns the quadrant's axis to +x. Exact. Turns the line n . p = 1 (given as n) into w = n.x + n.y s.
inline Vec2 turned(int quadrant, const Vec2& p) {
  switch (quadrant) {
    case 0: return p;
    case 1: return {p.y, -p.x};
    case 2: return {-p.x, -p.y};
    default: return {-p.y, p.x};
  }
}

/// Calls f(quadrant, from, to) for the slopes from `from` counter-clockwise to `to`, less than half a turn.
template <class F>
void for_each_run(const Bearing& from, Bearing to, F&& f) {
  if (to.slope == -1.0) to = {(to.quadrant + 3) & 3, 1.0};  // the same diagonal, from before
  int q = from.quadrant;
  double begin = from.slope;
  for (; q != to.quadrant; q = (q + 1) & 3) {
    f(q, begin, 1.0);
    begin = -1.0;
  }
  f(q, begin, to.slope);
}

/// How an edge from a to b lies about the viewer.
enum class Facing : std::uint8_t {
  left,    ///< b counter-clockwise of a
  right,   ///< b clockwise of a
  radial,  ///< both on one ray within rounding: no width
  touches  ///< the viewer stands on it within rounding
};

/// Of the magnitude of coordinates: places this close count as one.
inline constexpr double tie = 1e-12;

/// The line n . p = 1 through an edge, with its margin.
struct EdgeLine {
  Vec2 n{0.0};
  double margin = 0.0;  ///< m
  double peak = 0.0;    ///< where the margin is too great to be used: w is nowhere more; n is 0 then

  /// Nowhere above the edge; 0, which hides nothing, where that is not sure.
  SlopeLine low(int quadrant) const {
    const Vec2 t = turned(quadrant, n);
    return {t.x * (1.0 - margin) - sigma * std::fabs(t.y), t.y * (1.0 - margin)};
  }
  /// Nowhere below it.
  SlopeLine high(int quadrant) const {
    const Vec2 t = turned(quadrant, n);
    return {t.x * (1.0 + 2.0 * margin) + sigma * std::fabs(t.y) + peak, t.y * (1.0 + 2.0 * margin)};
  }

  static constexpr double sigma = 0x1p-49;
  static constexpr double greatest_margin = 0x1p-6;
};

/// An edge about the viewer, before its line is worked out.
struct EdgeTurn {
  Vec2 d{0.0};         ///< from a to b
  double c = 0.0;      ///< a x d
  double error = 0.0;  ///< of the line, times c
  double peak = 0.0;   ///< as in EdgeLine
  Facing facing = Facing::radial;

  EdgeLine line() const {
    if (peak > 0.0) return {Vec2(0.0), 0.0, peak};
    const double inverse = 1.0 / c;
    return {{d.y * inverse, -d.x * inverse}, tie + error * std::fabs(inverse), 0.0};
  }
};

/// An edge that the viewer, or its line, comes too close to: the margin is no use. w is greatest at the nearer
/// end, at most sqrt(2) / distance.
inline void turn_askew(const Vec2& a, const Vec2& b, double nearest, double blur, bool sure, EdgeTurn& turn) {
  if (glm::dot(a, b) <= 0.0 || !(nearest > 128.0 * blur)) {
    turn.facing = Facing::touches;
  } else if (!sure) {
    turn.facing = Facing::radial;
  } else {
    turn.peak = 1.5 / nearest;
  }
}

/// `blur`: tie times the magnitude of the viewer's coordinates. The sign of c is sure
/// where |c| is at least 2^-40 bulk, far above its error of 4 u bulk. c is taken from the nearer end, where bulk is
/// least; so what counts as radial is narrower than 2^-38.
inline EdgeTurn turn_of_edge(const Vec2& a, const Vec2& b, double blur) {
  EdgeTurn turn;
  turn.d = b - a;
  const double a2 = glm::dot(a, a), b2 = glm::dot(b, b);
  const Vec2& near = a2 < b2 ? a : b;
  const double p = near.x * turn.d.y, q = near.y * turn.d.x;
  const double bulk = std::fabs(p) + std::fabs(q);
  turn.c = p - q;
  turn.error = 0x1p-51 * bulk + blur * (std::fabs(turn.d.x) + std::fabs(turn.d.y));
  turn.facing = turn.c > 0.0 ? Facing::left : Facing::right;
  const double size = std::fabs(turn.c);
  const bool sure = size > 0x1p-40 * bulk;
  if (!(sure && turn.error < (EdgeLine::greatest_margin - tie) * size)) {
    turn_askew(a, b, std::sqrt(std::fmin(a2, b2)), blur, sure, turn);
  }
  return turn;
}
/// Most edges are seen well: |a x b| far above its rounding, their line far from the viewer. Then c may be taken as
/// a x b, whose error of 4 u (|ax by| + |ay bx|) is below half a tie, and there is nothing else to find out.
struct EasyEdge {
  double c = 0.0;  ///< a x b
  bool easy = false;
};
inline EasyEdge easy_edge(const Vec2& a, const Vec2& b, double blur) {
  const double p = a.x * b.y, q = a.y * b.x, c = p - q;
  const bool clear = std::fabs(c) > 0x1p-10 * (std::fabs(p) + std::fabs(q));
  const bool far = std::fabs(c) > 256.0 * blur * (std::fabs(b.x - a.x) + std::fabs(b.y - a.y));
  return {c, clear && far};
}
/// The line of an edge that is easy; `c` as easy_edge() gives it.
inline EdgeLine line_of_easy_edge(const Vec2& a, const Vec2& b, double c, double blur) {
  const Vec2 d = b - a;
  const double inverse = 1.0 / c;
  return {
      {d.y * inverse, -d.x * inverse}, 1.5 * tie + blur * (std::fabs(d.x) + std::fabs(d.y)) * std::fabs(inverse), 0.0};
}
inline EdgeLine line_of_edge(const Vec2& a, const Vec2& b, double blur) {
  const EasyEdge edge = easy_edge(a, b, blur);
  return edge.easy ? line_of_easy_edge(a, b, edge.c, blur) : turn_of_edge(a, b, blur).line();
}

}  // namespace gridcull
