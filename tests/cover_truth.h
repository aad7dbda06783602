// What discretisation should say of one cell, found by other means than grid/cover*.cpp: clipping. A cell is
// any box [low, high]; judging a box a little larger gives the tolerance of the tightness checks.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "gridcull/core/shape.h"

namespace cover_truth {

using gridcull::Pose;
using gridcull::Shape;
using gridcull::Vec2;
using gridcull::Vec3;

struct Box {
  Vec3 low, high;
  Box grown(double by) const { return {low - Vec3(by), high + Vec3(by)}; }
  Vec3 centre() const { return 0.5 * (low + high); }
  Vec3 corner(int i) const { return {(i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z}; }
};

struct Verdict {
  bool touches;  ///< the closed shape meets the closed box
  bool inside;   ///< the closed box lies in the open interior
};

/// dot(normal, p) >= offset.
struct Side {
  Vec3 normal;
  double offset;
  double height(const Vec3& p) const { return glm::dot(normal, p) - offset; }
};

/// Sutherland-Hodgman; true when something of the polygon (or segment, or point) is left.
inline bool meets(std::vector<Vec3> polygon, const std::vector<Side>& sides) {
  for (const Side& s : sides) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double ha = s.height(a), hb = s.height(b);
      if (ha >= 0) kept.push_back(a);
      if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) kept.push_back(a + (ha / (ha - hb)) * (b - a));
    }
    polygon = kept;
    if (polygon.empty()) return false;
  }
  return true;
}

inline std::vector<Side> sides_of(const Box& b) {
  return {{{1, 0, 0}, b.low.x},    {{-1, 0, 0}, -b.high.x}, {{0, 1, 0}, b.low.y},
          {{0, -1, 0}, -b.high.y}, {{0, 0, 1}, b.low.z},    {{0, 0, -1}, -b.high.z}};
}

inline std::vector<std::vector<Vec3>> faces_of_box(const std::array<Vec3, 8>& c) {
  std::vector<std::vector<Vec3>> faces;
  for (const auto& f : {std::array{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}) {
    faces.push_back({c[f[0]], c[f[1]], c[f[2]], c[f[3]]});
  }
  return faces;
}

inline std::array<Vec3, 8> corners(const Box& b) {
  std::array<Vec3, 8> c;
  for (int i = 0; i < 8; ++i) c[static_cast<std::size_t>(i)] = b.corner(i);
  return c;
}

// --- balls -----------------------------------------------------------------------------------------------

inline Verdict ball(const Vec3& centre, double radius, const Box& b, int dimension) {
  double nearest = 0, farthest = 0;
  for (int i = 0; i < 8; ++i) {
    Vec3 d = b.corner(i) - centre;
    if (dimension == 2) d.z = 0;
    farthest = std::max(farthest, glm::length(d));
  }
  for (int k = 0; k < dimension; ++k) {
    const double inside = std::fmin(std::fmax(centre[k], b.low[k]), b.high[k]);
    nearest += (centre[k] - inside) * (centre[k] - inside);
  }
  return {std::sqrt(nearest) <= radius, farthest < radius};
}

// --- the plane -------------------------------------------------------------------------------------------

/// Even-odd by a ray straight up.
inline bool odd(const std::vector<Vec2>& outline, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.x > p.x) == (b.x > p.x)) continue;
    const double t = (p.x - a.x) / (b.x - a.x);
    if (a.y + t * (b.y - a.y) > p.y) in = !in;
  }
  return in;
}

/// Segment against a convex polygon given as vertical sides.
inline bool edge_meets(const Vec2& a, const Vec2& b, const std::vector<Side>& sides) {
  return meets({{a.x, a.y, 0}, {b.x, b.y, 0}}, sides);
}

/// Polygon or chain against the convex region `sides` around `middle`.
inline Verdict planar(const std::vector<Vec2>& outline, bool closed, const std::vector<Side>& sides,
                      const Vec2& middle) {
  for (std::size_t i = 0; i + (closed ? 0 : 1) < outline.size(); ++i) {
    if (edge_meets(outline[i], outline[(i + 1) % outline.size()], sides)) return {true, false};
  }
  const bool in = closed && odd(outline, middle);
  return {in, in};
}

inline std::vector<Side> planar_sides(const Box& b) {
  return {{{1, 0, 0}, b.low.x}, {{-1, 0, 0}, -b.high.x}, {{0, 1, 0}, b.low.y}, {{0, -1, 0}, -b.high.y}};
}

// --- convex bodies ---------------------------------------------------------------------------------------

/// Sides through every triple of points that has all points on one side.
inline std::vector<Side> hull_sides(const std::vector<Vec3>& p, std::vector<std::array<std::size_t, 3>>& triples) {
  std::vector<Side> sides;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      for (std::size_t k = j + 1; k < p.size(); ++k) {
        Vec3 n = glm::cross(p[j] - p[i], p[k] - p[i]);
        const double length = glm::length(n);
        if (length < 1e-12) continue;
        n /= length;
        double least = 0, most = 0;
        for (const Vec3& q : p) {
          least = std::fmin(least, glm::dot(n, q - p[i]));
          most = std::fmax(most, glm::dot(n, q - p[i]));
        }
        if (least < -1e-12 && most > 1e-12) continue;
        if (most <= 1e-12) n = -n;
        sides.push_back({n, glm::dot(n, p[i])});
        triples.push_back({i, j, k});
      }
    }
  }
  return sides;
}

/// Convex body with these sides and faces (faces may be any triangles that cover the surface).
inline Verdict convex(const std::vector<Side>& sides, const std::vector<std::vector<Vec3>>& faces, const Box& b) {
  bool inside = true;
  for (int i = 0; i < 8; ++i) {
    for (const Side& s : sides) inside = inside && s.height(b.corner(i)) > 0;
  }
  if (inside) return {true, true};
  for (const auto& f : faces) {
    if (meets(f, sides_of(b))) return {true, false};
  }
  for (const auto& f : faces_of_box(corners(b))) {
    if (meets(f, sides)) return {true, false};
  }
  return {false, false};
}

// --- prisms ----------------------------------------------------------------------------------------------

/// Sides (in the plane) of the convex hull of points; brute force over pairs.
inline std::vector<Side> planar_hull(const std::vector<Vec2>& p) {
  std::vector<Side> sides;
  double slack = 1e-12;
  for (const Vec2& q : p) slack = std::fmax(slack, 1e-14 * (std::abs(q.x) + std::abs(q.y)));
  for (const Vec2& a : p) {
    for (const Vec2& b : p) {
      Vec2 n(a.y - b.y, b.x - a.x);
      const double length = glm::length(n);
      if (length <= slack) continue;
      n /= length;
      bool all = true;
      for (const Vec2& q : p) all = all && glm::dot(n, q - a) >= -slack;
      if (all) sides.push_back({{n.x, n.y, 0}, glm::dot(n, a)});
    }
  }
  return sides;
}

/// In the prism's own axes: the part of the cell between bottom and top, seen from above, against the outline.
inline Verdict prism(const std::vector<Vec2>& outline, double height, const Pose& pose, const Box& b) {
  const gridcull::Rotation r = rotation_of(pose.orientation);
  std::array<Vec3, 8> c;
  bool between = true;
  for (int i = 0; i < 8; ++i) {
    c[static_cast<std::size_t>(i)] = r.inverse(b.corner(i) - pose.position);
    const double z = c[static_cast<std::size_t>(i)].z;
    between = between && z > 0 && z < height;
  }
  std::vector<Vec2> seen;
  Vec2 middle(0);
  for (std::size_t i = 0; i < 8; ++i) {
    if (c[i].z >= 0 && c[i].z <= height) seen.emplace_back(c[i]);
    for (std::size_t j = i + 1; j < 8; ++j) {
      for (const double z : {0.0, height}) {
        if ((c[i].z < z) == (c[j].z < z)) continue;
        seen.emplace_back(c[i] + ((z - c[i].z) / (c[j].z - c[i].z)) * (c[j] - c[i]));
      }
    }
  }
  if (seen.empty()) return {false, false};
  for (const Vec2& p : seen) middle += p / static_cast<double>(seen.size());
  const Verdict v = planar(outline, true, planar_hull(seen), middle);
  return {v.touches, v.inside && between};
}

// --- meshes ----------------------------------------------------------------------------------------------

/// Odd by the sum of signed solid angles (A. van Oosterom and J. Strackee, 1983), for meshes whose triangles turn the
/// same way about each shell: no ray that could meet an edge.
inline bool winds(const std::vector<std::vector<Vec3>>& triangles, const Vec3& point) {
  double sum = 0.0;
  for (const auto& t : triangles) {
    const Vec3 a = t[0] - point, b = t[1] - point, c = t[2] - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    sum += std::atan2(glm::dot(a, glm::cross(b, c)),
                      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return std::lround(std::fabs(sum) / 6.283185307179586) % 2 != 0;  // the sum is half the solid angle
}

// --- any shape -------------------------------------------------------------------------------------------

/// A shape in its place, with what judging many cells needs.
class Truth {
 public:
  Truth(const Shape& shape, const Pose& pose) : shape_(shape), pose_(pose) {
    if (gridcull::dimension_of(shape) == 2) outline_ = world_outline(shape, pose);
    if (const auto* p = std::get_if<gridcull::Prism>(&shape)) outline_ = gridcull::merged_outline(p->vertices);
    const std::vector<Vec3> world = world_vertices(shape, pose);
    if (std::holds_alternative<gridcull::Cuboid>(shape) || std::holds_alternative<gridcull::Convex>(shape)) {
      std::vector<std::array<std::size_t, 3>> triples;
      sides_ = hull_sides(world, triples);
      for (const auto& t : triples) faces_.push_back({world[t[0]], world[t[1]], world[t[2]]});
    }
    if (const auto* f = std::get_if<gridcull::Faces>(&shape)) {
      for (const auto& t : f->triangles) faces_.push_back({world[t[0]], world[t[1]], world[t[2]]});
    }
  }

  Verdict judge(const Box& b) const {
    if (const auto* s = std::get_if<gridcull::Disc>(&shape_)) return ball(pose_.position, s->radius, b, 2);
    if (const auto* s = std::get_if<gridcull::Sphere>(&shape_)) return ball(pose_.position, s->radius, b, 3);
    if (gridcull::dimension_of(shape_) == 2) {
      const bool closed = !std::holds_alternative<gridcull::Polyline>(shape_);
      return planar(outline_, closed, planar_sides(b), Vec2(b.centre()));
    }
    if (const auto* s = std::get_if<gridcull::Prism>(&shape_)) return prism(outline_, s->height, pose_, b);
    if (const auto* mesh = std::get_if<gridcull::Faces>(&shape_)) {
      for (const auto& f : faces_) {
        if (meets(f, sides_of(b))) return {true, false};
      }
      const bool in = mesh->closed && winds(faces_, b.centre());
      return {in, in};
    }
    return convex(sides_, faces_, b);
  }

 private:
  Shape shape_;
  Pose pose_;
  std::vector<Vec2> outline_;
  std::vector<Side> sides_;
  std::vector<std::vector<Vec3>> faces_;
};

}  // namespace cover_truth
