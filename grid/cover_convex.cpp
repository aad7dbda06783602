// Convex bodies in rows of cells: rectangles, oriented boxes, hulls, triangles.
//
// Batagelo and Wu 2002, section 5.1, take inner and outer boxes. Here a row of cells meets the body in an
// interval, found from slabs low <= a . (p - reference) <= high in closed form: a cell with centre c and half
// edge s (margin included) touches the slab iff low - s |a|_1 <= a . c <= high + s |a|_1 and lies in its
// inside iff inner_low + s |a|_1 < a . c < inner_high - s |a|_1 (|a|_1: sum of absolute parts), and both are
// linear in c.x. With the face normals, the cell's own axes (the bounds) and the edge cross products (the xy,
// xz and yz slabs) this is the complete separating-axis test, so touched is exact.
// Rounding: every error is a few ulp of |a| M; s |a|_1 holds 500 ulp of |a| M, also after the division by a.x.
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_kernels.h"
#include "gridcull/grid/cover_words.h"

namespace gridcull::covering {
namespace {

/// Below this part of |a|_1 a component counts as 0: over coordinates up to 2 M it moves a slab by less than
/// 2^-49 M |a|_1, 1/32 of the margin.
constexpr double flat_part = 0x1p-50;

bool is_flat(const Vec3& a, int axis) {
  return std::abs(a[axis]) <= flat_part * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z));
}

/// Grows the slab by the cell and divides it by its part along `axis`, so that the coordinate itself lies
/// within [low, high] less the rest of the dot product. A slab flat along the axis is only grown; its part
/// along the axis becomes 0 (else it is 1).
void solve(ConvexSlab& s, int axis, double half) {
  Vec3& a = s.direction;
  const double grow = half * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z));
  s.low -= grow;
  s.high += grow;
  s.inner_low += grow;
  s.inner_high -= grow;
  if (is_flat(a, axis)) {
    a[axis] = 0.0;
    return;
  }
  const double scale = 1.0 / a[axis];
  for (double* part : {&a.x, &a.y, &a.z, &s.low, &s.high, &s.inner_low, &s.inner_high}) *part *= scale;
  a[axis] = 1.0;
  if (scale < 0.0) {
    std::swap(s.low, s.high);
    std::swap(s.inner_low, s.inner_high);
  }
}

/// Solves slabs of two coordinates; one that is flat along `axis` says no more than the bounds and goes.
void solve_planar(std::vector<ConvexSlab>& slabs, int axis, double half) {
  std::size_t kept = 0;
  for (ConvexSlab& s : slabs) {
    if (is_flat(s.direction, axis)) continue;
    solve(s, axis, half);
    slabs[kept++] = s;
  }
  slabs.resize(kept);
}

struct Interval {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  void meet(double l, double h) {
    low = std::max(low, l);
    high = std::min(high, h);
  }
  void meet(const Interval& o) { meet(o.low, o.high); }
};

/// Touched and opaque cells of one row.
struct Row {
  Range touched, opaque;
};

/// Cell centres of an axis relative to the body's reference, and back.
struct Centres {
  double first = 0, cell = 0, offset = 0, inverse = 0;  ///< offset: index of the reference, in cells

  Centres() = default;
  Centres(const Axis& axis, double reference)
      : first(axis.origin - reference + 0.5 * axis.cell),
        cell(axis.cell),
        offset(axis.in_cells(reference) - 0.5),
        inverse(axis.inverse) {}
  double at(std::int64_t i) const { return first + static_cast<double>(i) * cell; }
  /// Cells of `within` whose centres lie in the interval.
  Range inside(const Interval& v, const Range& within) const {
    return {ceil_within(v.low * inverse + offset, within.first, within.last + 1),
            floor_within(v.high * inverse + offset, within.first - 1, within.last)};
  }
};

/// The rows of one body.
struct Rows {
  const ConvexBody& body;
  Centres x, y, z;
  Range within;  ///< cells along x

  Interval bound(const std::vector<ConvexSlab>& slabs, int other, double value) const {
    Interval v;
    for (const ConvexSlab& s : slabs) {
      const double rest = s.direction[other] * value;
      v.meet(s.low - rest, s.high - rest);
    }
    return v;
  }

  /// `planar` is what the xy and xz slabs leave of x at this row.
  Row at(double dy, double dz, const Interval& planar) const {
    Interval outer = planar, inner;
    bool inside = body.has_inside;
    for (const ConvexSlab& s : body.full) {
      const double rest = s.direction.y * dy + s.direction.z * dz;
      if (s.direction.x == 0.0) {
        if (rest < s.low || rest > s.high) return {};
        inside = inside && rest > s.inner_low && rest < s.inner_high;
      } else {
        outer.meet(s.low - rest, s.high - rest);
        inner.meet(s.inner_low - rest, s.inner_high - rest);
      }
    }
    if (!(outer.low <= outer.high)) return {};
    Row row{x.inside(outer, within), {}};
    if (inside && inner.low < inner.high) {
      row.opaque = x.inside(inner, within);
      row.opaque = {std::max(row.opaque.first, row.touched.first), std::min(row.opaque.last, row.touched.last)};
    }
    return row;
  }
};

/// Appends the bricks that a row of bricks of `rows` touches; `base` is the index of the brick at x = 0.
template <int edge, std::size_t count>
void emit(const std::array<Row, count>& rows, std::size_t base, std::vector<BrickCover>& out) {
  Range cells{std::numeric_limits<std::int64_t>::max(), -1};
  for (const Row& r : rows) {
    if (r.touched.empty()) continue;
    cells = {std::min(cells.first, r.touched.first), std::max(cells.last, r.touched.last)};
  }
  if (cells.empty()) return;
  const std::size_t from = out.size();
  const std::int64_t first = cells.first / edge, last = cells.last / edge;
  BrickCover* bricks = append_bricks(out, base, first, last);
  for (std::size_t j = 0; j < count; ++j) {
    const Row& r = rows[j];
    const int shift = edge * static_cast<int>(j);
    if (!r.touched.empty()) fill_run<edge, &BrickCover::touched>(bricks, first, shift, r.touched);
    if (!r.opaque.empty()) fill_run<edge, &BrickCover::opaque>(bricks, first, shift, r.opaque);
  }
  drop_empty(out, from);
}

template <int edge>
void flat_body(const Lattice& lattice, const Rows& rows, const Range& y, std::vector<BrickCover>& out) {
  for (std::int64_t by = y.first / edge; by <= y.last / edge; ++by) {
    std::array<Row, edge> band{};
    for (int j = 0; j < edge; ++j) {
      const std::int64_t row = by * edge + j;
      if (row >= y.first && row <= y.last) band[static_cast<std::size_t>(j)] = rows.at(rows.y.at(row), 0.0, {});
    }
    emit<edge>(band, lattice.brick_index({0, by, 0}), out);
  }
}

/// One layer of bricks in z: for each of its 4 layers of cells the rows the body meets, and their x bounds.
struct Layer {
  static constexpr int edge = 4;
  std::array<Range, edge> rows;
  std::array<Interval, edge> x;
  std::array<double, edge> z;
  Range all{std::numeric_limits<std::int64_t>::max(), -1};

  Layer(const Rows& body, std::int64_t bz, const Range& y, const Range& layers) {
    for (int k = 0; k < edge; ++k) {
      const std::int64_t layer = bz * edge + k;
      rows[k] = {};
      if (layer < layers.first || layer > layers.last) continue;
      z[k] = body.z.at(layer);
      const Interval v = body.bound(body.body.yz, 2, z[k]);
      if (!(v.low <= v.high)) continue;
      rows[k] = body.y.inside(v, y);
      if (rows[k].empty()) continue;
      x[k] = body.bound(body.body.xz, 2, z[k]);
      all = {std::min(all.first, rows[k].first), std::max(all.last, rows[k].last)};
    }
  }
};

void solid_body(const Lattice& lattice, const Rows& rows, const Range& y, const Range& z, Cover& out) {
  constexpr int edge = Layer::edge;
  for (std::int64_t bz = z.first / edge; bz <= z.last / edge; ++bz) {
    const Layer layer(rows, bz, y, z);
    if (layer.all.empty()) continue;
    for (std::int64_t by = layer.all.first / edge; by <= layer.all.last / edge; ++by) {
      std::array<Row, edge * edge> band{};
      for (int j = 0; j < edge; ++j) {
        const std::int64_t row = by * edge + j;
        const double dy = rows.y.at(row);
        const Interval of_y = rows.bound(rows.body.xy, 1, dy);
        for (int k = 0; k < edge; ++k) {
          if (row < layer.rows[k].first || row > layer.rows[k].last) continue;
          Interval planar = layer.x[k];
          planar.meet(of_y);
          band[static_cast<std::size_t>(k * edge + j)] = rows.at(dy, layer.z[k], planar);
        }
      }
      emit<edge>(band, lattice.brick_index({0, by, bz}), out.bricks);
    }
  }
}

}  // namespace

double magnitude_of(const Bounds& bounds) {
  double m = 0.0;
  if (bounds.empty()) return m;
  for (int k = 0; k < 3; ++k) m = std::max({m, std::abs(bounds.min[k]), std::abs(bounds.max[k])});
  return m;
}

void convex(const Lattice& lattice, ConvexBody& body, double margin, Cover& out) {
  const Axis ax(lattice, 0), ay(lattice, 1), az(lattice, 2);
  const Range x = ax.touched(body.bounds.min.x - margin, body.bounds.max.x + margin, out.outside);
  const Range y = ay.touched(body.bounds.min.y - margin, body.bounds.max.y + margin, out.outside);
  const Range z = az.touched(body.bounds.min.z - margin, body.bounds.max.z + margin, out.outside);
  if (x.empty() || y.empty() || z.empty()) return;
  const double half = 0.5 * lattice.cell() + margin;
  for (ConvexSlab& s : body.full) solve(s, 0, half);
  solve_planar(body.xy, 0, half);
  solve_planar(body.xz, 0, half);
  solve_planar(body.yz, 1, half);
  const Rows rows{body, Centres(ax, body.reference.x), Centres(ay, body.reference.y), Centres(az, body.reference.z), x};
  solid_body(lattice, rows, y, z, out);
}

void convex_planar(const Lattice& lattice, ConvexBody& body, double margin, std::vector<BrickCover>& out,
                   bool& outside) {
  const Axis ax(lattice, 0), ay(lattice, 1);
  const Range x = ax.touched(body.bounds.min.x - margin, body.bounds.max.x + margin, outside);
  const Range y = ay.touched(body.bounds.min.y - margin, body.bounds.max.y + margin, outside);
  if (x.empty() || y.empty()) return;
  const double half = 0.5 * lattice.cell() + margin;
  for (ConvexSlab& s : body.full) solve(s, 0, half);
  const Rows rows{body, Centres(ax, body.reference.x), Centres(ay, body.reference.y), {}, x};
  if (lattice.dimension() == 2) {
    flat_body<8>(lattice, rows, y, out);
  } else {
    flat_body<4>(lattice, rows, y, out);
  }
}

void set_box(ConvexBody& body, const Pose& pose, const Vec3& half, bool flat) {
  body.clear();
  body.has_inside = true;
  body.reference = pose.position;
  const Rotation r = rotation_of(pose.orientation);
  const std::array<Vec3, 3> axes{r.x, r.y, r.z};
  Vec3 extent(0.0);
  for (int k = 0; k < 3; ++k) {
    const Vec3& a = axes[static_cast<std::size_t>(k)];
    extent += half[k] * Vec3(std::abs(a.x), std::abs(a.y), std::abs(a.z));
    if (!flat || k < 2) body.full.push_back({a, -half[k], half[k], -half[k], half[k]});
  }
  body.bounds = {pose.position - extent, pose.position + extent};
  if (flat) return;
  const auto planar = [&](std::vector<ConvexSlab>& slabs, const Vec3& a) {
    const double h =
        half.x * std::abs(glm::dot(a, r.x)) + half.y * std::abs(glm::dot(a, r.y)) + half.z * std::abs(glm::dot(a, r.z));
    slabs.push_back({a, -h, h, 0.0, 0.0});
  };
  for (const Vec3& u : axes) {  // cross products with the cell's edges
    planar(body.xy, {-u.y, u.x, 0.0});
    planar(body.xz, {u.z, 0.0, -u.x});
    planar(body.yz, {0.0, -u.z, u.y});
  }
}

}  // namespace gridcull::covering
