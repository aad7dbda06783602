// Balls (2D: discs): closed formula per cell, four cells of a row at a time.
// Batagelo and Wu 2002, sections 4.1 and 5.1, rasterise grown and shrunk outlines; here the nearest and the
// farthest point of each grown cell from the centre decide, which is exact up to the margin:
//   touched: near.x^2 + near.y^2 + near.z^2 <= r^2,   opaque: far.x^2 + far.y^2 + far.z^2 < r^2.
// Rounding: relative coordinates are off by 2 ulp of M, the greatest |coordinate|; near and far are moved by
// the margin, some 500 ulp of M, to the safe side, and r <= M, so r^2 minus the squares (3 roundings of at
// most r^2 * 2^-53 each) errs by less than the margin moves it: in (near + margin)^2 - near^2 >= 2 margin near,
// where near >= r / 2 for one axis on every surface point (r / sqrt 3 > r / 2).
#include <array>
#include <bit>
#include <limits>

#include "gridcull/grid/ball_bits.h"
#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_kernels.h"

namespace gridcull::covering {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Squares of the distances of the cells of one brick along one axis from the centre; infinite beyond `clip`.
template <int edge>
struct Squares {
  alignas(16) std::array<double, edge> near, far;
  double nearest;  ///< least near
  double least_far, most_far;

  void fill(const Axis& axis, std::int64_t brick, const Range& clip, double centre, double margin) {
    // Cell numbers as doubles (exact: below 2^40), so that the loop needs no conversion and runs in SIMD.
    const auto first = static_cast<double>(brick * edge);
    const auto low_end = static_cast<double>(clip.first), high_end = static_cast<double>(clip.last);
    for (int k = 0; k < edge; ++k) {
      const double i = first + static_cast<double>(k);
      const double low = axis.origin + i * axis.cell - centre - margin;
      const double high = axis.origin + (i + 1.0) * axis.cell - centre + margin;
      const double gap = std::max(std::max(low, -high), 0.0);
      const double reach = std::max(high, -low);
      const bool in = (i >= low_end) & (i <= high_end);
      near[k] = in ? gap * gap : infinite;
      far[k] = in ? reach * reach : infinite;
    }
    nearest = least_far = infinite;
    most_far = 0.0;
    for (int k = 0; k < edge; ++k) {
      nearest = std::min(nearest, near[k]);
      least_far = std::min(least_far, far[k]);
      most_far = std::max(most_far, far[k]);
    }
  }
};

/// The squares along x, 16 bricks at a time: computed once for all but huge balls.
template <int edge>
class Columns {
 public:
  Columns(const Axis& axis, const Range& clip, double centre, double margin)
      : axis_(axis), clip_(clip), centre_(centre), margin_(margin), first_(clip.first / edge) {
    load(0);
  }
  const Squares<edge>& at(std::int64_t brick) {
    const std::int64_t block = (brick - first_) / held;
    if (block != block_) load(block);
    return squares_[static_cast<std::size_t>((brick - first_) % held)];
  }

 private:
  static constexpr int held = 16;
  void load(std::int64_t block) {
    block_ = block;
    const std::int64_t last = std::min(first_ + (block + 1) * held - 1, clip_.last / edge);
    for (std::int64_t b = first_ + block * held; b <= last; ++b) {
      squares_[static_cast<std::size_t>((b - first_) % held)].fill(axis_, b, clip_, centre_, margin_);
    }
  }

  Axis axis_;
  Range clip_;
  double centre_, margin_;
  std::int64_t first_, block_ = 0;
  std::array<Squares<edge>, held> squares_;
};

/// One row of bricks along x: limits are r^2 less the squares of y and z, a row of cells each.
template <int edge>
struct BrickRow {
  static constexpr int rows = 64 / edge;
  std::array<double, rows> near, far;
  double best_near;            ///< greatest near
  double best_far, worst_far;  ///< greatest and least far; not above 0 where nothing can be opaque
};

template <int edge>
void brick_row(const BrickRow<edge>& row, Columns<edge>& columns, const Range& bricks, std::size_t base,
               std::vector<BrickCover>& out) {
  const std::size_t from = out.size();
  out.resize(from + static_cast<std::size_t>(bricks.last - bricks.first + 1));
  BrickCover* next = out.data() + from;
  for (std::int64_t b = bricks.first; b <= bricks.last; ++b) {
    const Squares<edge>& x = columns.at(b);
    if (!(x.nearest <= row.best_near)) continue;
    next->brick = static_cast<std::uint32_t>(base + static_cast<std::size_t>(b));
    next->opaque = 0;
    if (x.most_far < row.worst_far) {
      next->touched = next->opaque = ~std::uint64_t{0};
      ++next;
      continue;
    }
    next->touched = bits_at_most<edge>(x.near.data(), row.near.data());
    if (x.least_far < row.best_far) next->opaque = bits_below<edge>(x.far.data(), row.far.data());
    next += next->touched != 0;
  }
  out.resize(static_cast<std::size_t>(next - out.data()));
}

/// Cells whose own half diagonal is not below the radius are never inside.
bool may_be_opaque(const Lattice& lattice, double radius) {
  return 4.0 * radius * radius > lattice.dimension() * lattice.cell() * lattice.cell();
}

void disc(const Lattice& lattice, const Vec3& centre, double radius, double margin, bool with_opaque, Cover& out) {
  constexpr int edge = 8;
  const Axis ax(lattice, 0), ay(lattice, 1);
  const double reach = radius + margin;
  const Range x = ax.touched(centre.x - reach, centre.x + reach, out.outside);
  const Range y = ay.touched(centre.y - reach, centre.y + reach, out.outside);
  if (x.empty() || y.empty()) return;
  Columns<edge> columns(ax, x, centre.x, margin);
  const double r2 = radius * radius;
  for (std::int64_t by = y.first / edge; by <= y.last / edge; ++by) {
    Squares<edge> sy;
    sy.fill(ay, by, y, centre.y, margin);
    BrickRow<edge> row;
    for (int j = 0; j < edge; ++j) {
      row.near[j] = r2 - sy.near[j];
      row.far[j] = r2 - sy.far[j];
    }
    row.best_near = r2 - sy.nearest;
    row.best_far = with_opaque ? r2 - sy.least_far : -infinite;
    row.worst_far = with_opaque ? r2 - sy.most_far : -infinite;
    brick_row<edge>(row, columns, {x.first / edge, x.last / edge}, lattice.brick_index({0, by, 0}), out.bricks);
  }
}

void sphere(const Lattice& lattice, const Vec3& centre, double radius, double margin, bool with_opaque, Cover& out) {
  constexpr int edge = 4;
  const Axis ax(lattice, 0), ay(lattice, 1), az(lattice, 2);
  const double reach = radius + margin;
  const Range x = ax.touched(centre.x - reach, centre.x + reach, out.outside);
  const Range y = ay.touched(centre.y - reach, centre.y + reach, out.outside);
  const Range z = az.touched(centre.z - reach, centre.z + reach, out.outside);
  if (x.empty() || y.empty() || z.empty()) return;
  Columns<edge> columns(ax, x, centre.x, margin), rows(ay, y, centre.y, margin);
  const double r2 = radius * radius;
  for (std::int64_t bz = z.first / edge; bz <= z.last / edge; ++bz) {
    Squares<edge> sz;
    sz.fill(az, bz, z, centre.z, margin);
    for (std::int64_t by = y.first / edge; by <= y.last / edge; ++by) {
      const Squares<edge>& sy = rows.at(by);
      BrickRow<edge> row;
      row.best_near = r2 - (sy.nearest + sz.nearest);
      if (!(row.best_near >= 0.0)) continue;
      row.best_far = with_opaque ? r2 - (sy.least_far + sz.least_far) : -infinite;
      row.worst_far = with_opaque ? r2 - (sy.most_far + sz.most_far) : -infinite;
      for (int k = 0; k < edge; ++k) {
        for (int j = 0; j < edge; ++j) {
          row.near[k * edge + j] = r2 - (sy.near[j] + sz.near[k]);
          row.far[k * edge + j] = r2 - (sy.far[j] + sz.far[k]);
        }
      }
      brick_row<edge>(row, columns, {x.first / edge, x.last / edge}, lattice.brick_index({0, by, bz}), out.bricks);
    }
  }
}

}  // namespace

void ball(const Lattice& lattice, const Vec3& centre, double radius, bool with_opaque, Cover& out) {
  const bool flat = lattice.dimension() == 2;
  const double across = std::max(std::abs(centre.x), std::abs(centre.y));
  const double margin = lattice.margin((flat ? across : std::max(across, std::abs(centre.z))) + radius);
  with_opaque = with_opaque && may_be_opaque(lattice, radius);
  if (flat) {
    disc(lattice, centre, radius, margin, with_opaque, out);
  } else {
    sphere(lattice, centre, radius, margin, with_opaque, out);
  }
}

}  // namespace gridcull::covering

namespace gridcull {

void cover_ball(const Lattice& lattice, const Vec3& centre, double radius, Cover& out) {
  out.clear();
  covering::ball(lattice, centre, radius, false, out);
}

}  // namespace gridcull
