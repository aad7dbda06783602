// The boundary of a k-DOP by duality: Bartz, Klosowski, Staneker 2005, section 3.3 (geometric duality and a convex
// hull). A plane n.x = d becomes the point n / d, a facet of their convex hull the vertex in which its planes meet.
// Changed: the hull is incremental, O(k^2) for k <= 26; its signs are exact, so that no planes in a row through one
// vertex or edge, parallel faces or slivers need care.
//
// Claim 1 (combinatorics). With an interior point as origin all d > 0, and the orientation of four dual points
// (n_i / d_i, 1) has the sign of the determinant of their rows (n_i, d_i). Moving the origin subtracts multiples of the
// columns of n from the column of d: the sign is the same, so no interior point need be known. Expanded along that
// column it is a sum of four doubles with integer factors of magnitude <= 4: its sign is found exactly (most times by
// a filter). As in core/hull.cpp, a facet is replaced only when the new point lies strictly beyond it, and the
// replaced ones form a disc.
//
// Claim 2 (containment). Let P be the polytope of the planes moved out, each by at least `grown` (offsets as stored:
// rounded, and the projections were off by 2^-51 size). By claim 1 each facet's three planes have an integer
// determinant D, |D| >= 1, and their vertex is (d_i (n_j x n_k) + d_j (n_k x n_i) + d_k (n_i x n_j)) / D, where the
// cross products have entries of magnitude <= 2: products exact, two sums, one quotient, so a coordinate is off by at
// most 3 * 2^-53 * 6 max d and the vertex by e < 2^-48 max d; max d <= size + 3.02 grown. So the stored vertices'
// support in any unit direction u is at least P's less e. A point x whose ball of radius e lies in P therefore
// satisfies u.x <= the stored vertices' support for all u: it lies in their hull. Each plane of P is farther than
// grown - 2^-50 (size + grown) from all points, and 2^-50 (size + grown) + e < 2^-44 size + 2^-40 grown: that last part
// is added on top here.
//
// 2D: the octagon is a rectangle with its corners cut; each vertex is one sum of two offsets, so claim 2 holds too.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "gridcull/core/slabs.h"

namespace gridcull {
namespace {

struct Plane {
  int x, y, z;  ///< outward
  double offset;
  double length;
};

constexpr std::size_t most_planes = 26, most_facets = 2 * most_planes;

struct Planes {
  std::array<Plane, most_planes> at;
  std::size_t count = 0;
};

/// Opposite planes next to each other; the first four are +x, -x, +y, -y.
Planes grown_planes(const Slabs& slabs, double grown) {
  Planes planes;
  for (std::size_t j = 0; j < slab_directions.size(); ++j) {
    if (!slabs.has(j)) continue;
    const SlabDirection& n = slab_directions[j];
    // As if a cube of half edge `grown` were added, and a little more along edges and corners: a box keeps its eight.
    const int entries = n.x * n.x + n.y * n.y + n.z * n.z;
    const double more = entries * grown * (entries == 1 ? 1.0 + 0x1p-39 : 1.0 + 0x1p-8);
    planes.at[planes.count++] = {n.x, n.y, n.z, slabs.high[j] + more, n.length};
    planes.at[planes.count++] = {-n.x, -n.y, -n.z, -slabs.low[j] + more, n.length};
  }
  return planes;
}

struct IntVec {
  int x, y, z;
};

IntVec cross(const Plane& a, const Plane& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
int dot(const Plane& a, const IntVec& v) { return a.x * v.x + a.y * v.y + a.z * v.z; }
int determinant(const Plane& a, const Plane& b, const Plane& c) { return dot(a, cross(b, c)); }

/// Exact sign of the sum of products of factors up to 4: Shewchuk 1997 (core/predicates.cpp), after a filter.
class ExactSum {
 public:
  void add(int factor, double value) {
    if (factor == 3 || factor == -3) {
      add(factor > 0 ? 2 : -2, value);
      factor = factor > 0 ? 1 : -1;
    }
    if (factor != 0) terms_[static_cast<std::size_t>(count_++)] = factor * value;
  }

  int sign() const {
    double sum = 0.0, magnitude = 0.0;
    for (int i = 0; i < count_; ++i) {
      sum += terms_[static_cast<std::size_t>(i)];
      magnitude += std::fabs(terms_[static_cast<std::size_t>(i)]);
    }
    // Seven sums of magnitudes, each off by 2^-53.
    if (std::fabs(sum) > 0x1p-49 * magnitude) return sum > 0.0 ? 1 : -1;
    return exact_sign();
  }

 private:
  int exact_sign() const {
    std::array<double, 8> parts;  // non-overlapping, ascending
    int length = 0;
    for (int i = 0; i < count_; ++i) {
      double carry = terms_[static_cast<std::size_t>(i)];
      int kept = 0;
      for (int k = 0; k < length; ++k) {
        const double part = parts[static_cast<std::size_t>(k)];
        const double high = carry + part, back = high - carry;
        const double low = (carry - (high - back)) + (part - back);
        if (low != 0.0) parts[static_cast<std::size_t>(kept++)] = low;
        carry = high;
      }
      if (carry != 0.0) parts[static_cast<std::size_t>(kept++)] = carry;
      length = kept;
    }
    if (length == 0) return 0;
    return parts[static_cast<std::size_t>(length - 1)] > 0.0 ? 1 : -1;
  }

  std::array<double, 8> terms_;
  int count_ = 0;
};

using Corners = std::array<std::uint8_t, 3>;

/// The vertex in which three planes meet is point / weight; a plane n.x = d cuts it off where n.point > d weight, if
/// weight > 0.
struct Facet {
  Corners at{};
  Vec3 point{0.0};
  int weight = 0;
};

/// The convex hull of the dual points, and what it says of the primal.
class DualHull {
 public:
  explicit DualHull(const Planes& planes) : planes_(planes) {
    for (std::size_t p = 0; p < planes.count; ++p) farthest_ = std::max(farthest_, std::fabs(planes.at[p].offset));
    // +x, -x, +y, +z: the determinant is +-(width along x), which is not 0.
    start(0, 1, 2, 4);
    for (std::size_t p = 0; p < planes.count; ++p) insert(static_cast<std::uint8_t>(p));
  }

  void write(ConvexBoundary& out) {
    join_coplanar();
    write_vertices(out);
    for (std::size_t p = 0; p < planes_.count; ++p) write_face(static_cast<std::uint8_t>(p), out);
  }

 private:
  Facet facet(std::uint8_t i, std::uint8_t j, std::uint8_t k) const {
    const Plane &a = planes_.at[i], &b = planes_.at[j], &c = planes_.at[k];
    const IntVec bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    return {
        {i, j, k},
        Vec3(a.offset * bc.x + b.offset * ca.x + c.offset * ab.x, a.offset * bc.y + b.offset * ca.y + c.offset * ab.y,
             a.offset * bc.z + b.offset * ca.z + c.offset * ab.z),
        dot(a, bc)};
  }

  /// 1: the dual point p lies beyond the facet, which means that plane p cuts off the facet's vertex.
  int beyond(const Facet& f, std::uint8_t p) const {
    const Plane& d = planes_.at[p];
    const double height = d.x * f.point.x + d.y * f.point.y + d.z * f.point.z - f.weight * d.offset;
    // `point`: products exact, two sums of up to 6 times the greatest offset: 12 * 2^-53 of it each; three of them, two
    // sums of 18, a product of 4 and the last sum of 22 times that: below 2^-46.
    if (std::fabs(height) > 0x1p-46 * farthest_) return height > 0.0 ? 1 : -1;
    return exactly_beyond(f.at, d);
  }

  int exactly_beyond(const Corners& f, const Plane& d) const {
    const Plane &a = planes_.at[f[0]], &b = planes_.at[f[1]], &c = planes_.at[f[2]];
    ExactSum sum;
    sum.add(determinant(b, c, d), a.offset);
    sum.add(-determinant(a, c, d), b.offset);
    sum.add(determinant(a, b, d), c.offset);
    sum.add(-determinant(a, b, c), d.offset);
    return sum.sign();
  }

  void start(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) {
    if (beyond(facet(a, b, c), d) > 0) std::swap(b, c);
    facets_[0] = facet(a, b, c);
    facets_[1] = facet(a, d, b);
    facets_[2] = facet(b, d, c);
    facets_[3] = facet(c, d, a);
    count_ = 4;
  }

  void insert(std::uint8_t p) {
    std::array<std::uint32_t, most_planes> ways{};  // bit b of ways[a]: an edge of a replaced facet runs from a to b
    std::size_t kept = 0;
    for (std::size_t f = 0; f < count_; ++f) {
      const Corners at = facets_[f].at;
      if (beyond(facets_[f], p) <= 0) {
        if (kept != f) facets_[kept] = facets_[f];
        ++kept;
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k) ways[at[k]] |= std::uint32_t{1} << at[(k + 1) % 3];
    }
    if (kept == count_) return;
    for (std::uint8_t a = 0; a < planes_.count; ++a) {
      for (std::uint32_t left = ways[a]; left != 0; left &= left - 1) {
        const auto b = static_cast<std::uint8_t>(std::countr_zero(left));
        if ((ways[b] >> a & 1) == 0) facets_[kept++] = facet(a, b, p);
      }
    }
    count_ = kept;
  }

  std::size_t root(std::size_t f) const {
    while (same_[f] != f) f = same_[f];
    return f;
  }

  /// Facets in one plane are one vertex.
  void join_coplanar() {
    for (std::size_t f = 0; f < count_; ++f) {
      same_[f] = static_cast<std::uint8_t>(f);
      for (std::size_t k = 0; k < 3; ++k)
        facet_at_[facets_[f].at[k]][facets_[f].at[(k + 1) % 3]] = static_cast<std::uint8_t>(f);
    }
    for (std::size_t f = 0; f < count_; ++f) {
      const Corners& at = facets_[f].at;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t g = facet_at_[at[(k + 1) % 3]][at[k]];
        if (g > f && beyond(facets_[f], opposite(g, at[k], at[(k + 1) % 3])) == 0) {
          same_[root(g)] = static_cast<std::uint8_t>(root(f));
        }
      }
    }
  }

  std::uint8_t opposite(std::size_t g, std::uint8_t a, std::uint8_t b) const {
    for (const std::uint8_t v : facets_[g].at) {
      if (v != a && v != b) return v;
    }
    return a;
  }

  void write_vertices(ConvexBoundary& out) {
    for (std::size_t f = 0; f < count_; ++f) {
      if (root(f) != f) continue;
      vertex_[f] = static_cast<std::uint32_t>(out.vertices.size());
      out.vertices.push_back(facets_[f].point / static_cast<double>(facets_[f].weight));
    }
  }

  /// The facets about dual point p in order are the corners of plane p's face. A plane that only touches has none.
  void write_face(std::uint8_t p, ConvexBoundary& out) {
    std::size_t f = 0;
    std::uint8_t from = 0;
    bool found = false;
    for (; f < count_ && !found; ++f) {
      for (std::size_t k = 0; k < 3 && !found; ++k) {
        if (facets_[f].at[k] == p) from = facets_[f].at[(k + 1) % 3], found = true;
      }
    }
    if (!found) return;
    const std::uint8_t first = from;
    const auto base = static_cast<std::uint32_t>(out.loops.size());
    do {
      // The facet (p, from, next); the one after it has the edge from p to `next`.
      const std::size_t at = facet_at_[p][from];
      const std::uint32_t v = vertex_[root(at)];
      if (out.loops.size() == base || out.loops.back() != v) out.loops.push_back(v);
      from = opposite(at, p, from);
    } while (from != first);
    while (out.loops.size() > base + 1 && out.loops.back() == out.loops[base]) out.loops.pop_back();
    const auto count = static_cast<std::uint32_t>(out.loops.size()) - base;
    if (count < 3) return out.loops.resize(base);
    const Plane& n = planes_.at[p];
    out.faces.push_back(
        {Vec3(n.x, n.y, n.z) / std::sqrt(static_cast<double>(n.x * n.x + n.y * n.y + n.z * n.z)), base, count});
  }

  const Planes& planes_;
  double farthest_ = 0.0;
  std::array<Facet, most_facets> facets_;
  std::size_t count_ = 0;
  std::array<std::uint8_t, most_facets> same_{};
  std::array<std::uint32_t, most_facets> vertex_{};
  std::array<std::array<std::uint8_t, most_planes>, most_planes> facet_at_{};
};

/// Counter-clockwise from the corner with the greatest x and least y; each corner cut where its diagonal cuts it.
void write_octagon(const Slabs& slabs, const Planes& planes, ConvexBoundary& out) {
  const double right = planes.at[0].offset, left = planes.at[1].offset;
  const double top = planes.at[2].offset, bottom = planes.at[3].offset;
  const auto add = [&](double x, double y) {
    const Vec3 p(x, y, 0.0);
    if (out.vertices.empty() || out.vertices.back() != p) out.vertices.push_back(p);
  };
  // x <= a, y <= b, x + y <= d in the corner's own quadrant, signs put back afterwards.
  const auto corner = [&](double a, double b, double d, double sx, double sy, bool x_first) {
    if (slabs.kind == BoundKind::box || !(d < a + b)) return add(sx * a, sy * b);
    const Vec2 on_x(sx * a, sy * (d - a)), on_y(sx * (d - b), sy * b);
    const Vec2 &first = x_first ? on_x : on_y, &second = x_first ? on_y : on_x;
    add(first.x, first.y);
    add(second.x, second.y);
  };
  const bool box = slabs.kind == BoundKind::box;
  const auto diagonal = [&](std::size_t i) { return box ? 0.0 : planes.at[i].offset; };
  corner(right, bottom, diagonal(6), 1, -1, false);
  corner(right, top, diagonal(4), 1, 1, true);
  corner(left, top, diagonal(7), -1, 1, false);
  corner(left, bottom, diagonal(5), -1, -1, true);
  while (out.vertices.size() > 1 && out.vertices.back() == out.vertices.front()) out.vertices.pop_back();
  for (std::uint32_t i = 0; i < out.vertices.size(); ++i) out.loops.push_back(i);
  out.faces.push_back({{0.0, 0.0, 1.0}, 0, static_cast<std::uint32_t>(out.vertices.size())});
}

}  // namespace

void slab_boundary(const Slabs& slabs, double grown, ConvexBoundary& out) {
  out.clear();
  const Planes planes = grown_planes(slabs, grown);
  if (slabs.dimension == 2) {
    write_octagon(slabs, planes, out);
  } else {
    DualHull(planes).write(out);
  }
}

}  // namespace gridcull
