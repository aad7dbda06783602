// Triangles by cutting ears, then joined over their diagonals while what results is convex.
//
// S. Hertel and K. Mehlhorn, "Fast triangulation of simple polygons", 1983 (their second step: at most four times the
// least number of parts). Every decision is the sign of an exact determinant (methods/turn_sign.h) and every corner is
// a given point, so parts lie inside the outline without any margin.
#include "gridcull/methods/convex_partition.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "gridcull/methods/turn_sign.h"

namespace gridcull {
namespace {

constexpr std::size_t most_points = 256;

using Outline = std::vector<Vec2>;
using Ring = std::vector<std::uint32_t>;  ///< point numbers, counter-clockwise

/// On the closed segment; the three points are collinear.
bool between(const Vec2& a, const Vec2& b, const Vec2& p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const int abc = turn_sign(a, b, c), abd = turn_sign(a, b, d);
  const int cda = turn_sign(c, d, a), cdb = turn_sign(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && between(a, b, c)) || (abd == 0 && between(a, b, d)) || (cda == 0 && between(c, d, a)) ||
         (cdb == 0 && between(c, d, b));
}

/// No two edges meet but neighbours in their common point.
bool is_simple(const Outline& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
    if (a == b) return false;
    if (turn_sign(a, b, c) == 0 && (between(a, b, c) || between(b, c, a))) return false;  // turns back
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && segments_meet(a, b, p[j], p[(j + 1) % n])) return false;
    }
  }
  return true;
}

/// Whether the simple outline runs counter-clockwise: as it does at its lowest, then leftmost point that turns.
bool runs_left(const Outline& p) {
  const auto least = std::min_element(
      p.begin(), p.end(), [](const Vec2& a, const Vec2& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); });
  const std::size_t n = p.size(), at = static_cast<std::size_t>(least - p.begin());
  return turn_sign(p[(at + n - 1) % n], *least, p[(at + 1) % n]) > 0;
}

int turn(const Outline& p, const Ring& ring, std::size_t i) {
  const std::size_t n = ring.size();
  return turn_sign(p[ring[(i + n - 1) % n]], p[ring[i]], p[ring[(i + 1) % n]]);
}

/// The corner can be cut off: it turns left and no other point of the ring lies in its closed triangle.
bool is_ear(const Outline& p, const Ring& ring, std::size_t i) {
  if (turn(p, ring, i) <= 0) return false;
  const std::size_t n = ring.size(), before = (i + n - 1) % n, after = (i + 1) % n;
  const Vec2 &a = p[ring[before]], &b = p[ring[i]], &c = p[ring[after]];
  for (std::size_t j = 0; j < n; ++j) {
    if (j == before || j == i || j == after) continue;
    const Vec2& q = p[ring[j]];
    if (turn_sign(a, b, q) >= 0 && turn_sign(b, c, q) >= 0 && turn_sign(c, a, q) >= 0) return false;
  }
  return true;
}

std::vector<Ring> cut_ears(const Outline& p) {
  Ring ring(p.size());
  for (std::uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
  std::vector<Ring> out;
  while (ring.size() > 3) {
    std::size_t i = 0;
    while (i < ring.size() && turn(p, ring, i) != 0 && !is_ear(p, ring, i)) ++i;
    if (i == ring.size()) return {};  // cannot be, for a simple outline
    const std::size_t n = ring.size();
    if (turn(p, ring, i) > 0) out.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (turn(p, ring, 1) > 0) out.push_back(ring);
  return out;
}

/// Joins `b` to `a` over a common diagonal where the result is convex.
bool join(const Outline& p, Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::uint32_t from = a[i], to = a[(i + 1) % a.size()];
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (b[j] != to || b[(j + 1) % b.size()] != from) continue;
      Ring both;
      for (std::size_t k = 0; k < a.size(); ++k) both.push_back(a[(i + 1 + k) % a.size()]);  // to ... from
      for (std::size_t k = 2; k < b.size(); ++k) both.push_back(b[(j + k) % b.size()]);      // behind from, up to `to`
      for (std::size_t k = 0; k < both.size(); ++k) {
        if (turn(p, both, k) < 0) return false;
      }
      a = both;
      return true;
    }
  }
  return false;
}

void join_all(const Outline& p, std::vector<Ring>& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (bool grown = true; grown;) {
      grown = false;
      for (std::size_t j = i + 1; j < parts.size() && !grown; ++j) {
        if (!join(p, parts[i], parts[j])) continue;
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(j));
        grown = true;
      }
    }
  }
}

}  // namespace

std::vector<std::vector<Vec2>> convex_partition(const std::vector<Vec2>& outline) {
  std::vector<std::vector<Vec2>> out;
  if (outline.size() < 3 || outline.size() > most_points || !is_simple(outline)) return out;
  Outline points = outline;
  if (!runs_left(points)) std::reverse(points.begin(), points.end());
  std::vector<Ring> rings = cut_ears(points);
  join_all(points, rings);
  for (const Ring& ring : rings) {
    std::vector<Vec2>& part = out.emplace_back();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (turn(points, ring, i) != 0) part.push_back(points[ring[i]]);
    }
  }
  return out;
}

}  // namespace gridcull
