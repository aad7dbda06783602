// Balls (2D: discs): closed formula per cell, a row of four or eight cells at a time.
// Batagelo and Wu 2002, sections 4.1 and 5.1, rasterise grown and shrunk outlines; here the nearest and the
// farthest point of each grown cell from the centre decide, which is exact up to the margin:
//   touched: near.x^2 + near.y^2 + near.z^2 <= r^2,   opaque: far.x^2 + far.y^2 + far.z^2 < r^2.
// Rounding: distances along an axis are off by a few ulp of M, the greatest |coordinate|; near and far are
// moved by the margin, some 500 ulp of M, to the safe side, and r <= M, so r^2 minus the squares (a handful of
// roundings of at most r^2 * 2^-53 each) errs by less than the margin moves it: by at least 2 margin near,
// where near > r / 2 along one axis for every surface point (r / sqrt 3 > r / 2).
#include <array>
#include <limits>

#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_kernels.h"
#include "gridcull/grid/double_pair.h"

namespace gridcull::covering {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Squares of the nearest and farthest distances of the cells of one brick from the centre, along one axis;
/// infinite for cells beyond the lattice.
template <int edge>
struct Squares {
  static constexpr int pairs = edge / 2;
  std::array<DoublePair, pairs> near, far;
  double least_near, least_far, most_far;

  void fill(const Axis& axis, std::int64_t brick, double centre, double margin) {
    const DoublePair half = DoublePair::both(0.5 * axis.cell + margin);
    const DoublePair origin = DoublePair::both(axis.origin), cell = DoublePair::both(axis.cell);
    const DoublePair about = DoublePair::both(centre), none = DoublePair::both(0.0);
    const auto first = static_cast<double>(brick * edge);
    DoublePair middle = DoublePair::of(first + 0.5, first + 1.5);  // in cells
    for (int p = 0; p < pairs; ++p) {
      const DoublePair away = absolute(origin + middle * cell - about);
      const DoublePair gap = greatest(away - half, none), reach = away + half;
      near[p] = gap * gap;
      far[p] = reach * reach;
      middle = middle + DoublePair::both(2.0);
    }
    if (brick * edge + edge > axis.cells) cut(first, static_cast<double>(axis.cells));
    measure();
  }

 private:
  void cut(double first, double cells) {
    const DoublePair end = DoublePair::both(cells), never = DoublePair::both(infinite);
    for (int p = 0; p < pairs; ++p) {
      const DoublePair i = DoublePair::of(first + 2 * p, first + 2 * p + 1);
      near[p] = where_less(i, end, near[p], never);
      far[p] = where_less(i, end, far[p], never);
    }
  }
  void measure() {
    DoublePair a = near[0], b = far[0], c = far[0];
    for (int p = 1; p < pairs; ++p) {
      a = least(a, near[p]);
      b = least(b, far[p]);
      c = greatest(c, far[p]);
    }
    least_near = std::min(a.first(), a.second());
    least_far = std::min(b.first(), b.second());
    most_far = std::max(c.first(), c.second());
  }
};

/// The squares along an axis, 8 bricks at a time: computed once for all but large balls.
template <int edge>
class Line {
 public:
  Line(const Axis& axis, const Range& cells, double centre, double margin)
      : axis_(axis), centre_(centre), margin_(margin), first_(cells.first / edge), last_(cells.last / edge) {
    load(first_);
  }
  std::int64_t first() const { return first_; }
  std::int64_t last() const { return last_; }
  const Squares<edge>& at(std::int64_t brick) {
    if (static_cast<std::uint64_t>(brick - loaded_) >= held) load(brick);
    return squares_[static_cast<std::size_t>(brick - loaded_)];
  }

 private:
  static constexpr std::uint64_t held = 8;
  void load(std::int64_t from) {
    loaded_ = from;
    const std::int64_t end = std::min(from + static_cast<std::int64_t>(held) - 1, last_);
    for (std::int64_t b = from; b <= end; ++b) {
      squares_[static_cast<std::size_t>(b - from)].fill(axis_, b, centre_, margin_);
    }
  }

  Axis axis_;
  double centre_, margin_;
  std::int64_t first_, last_, loaded_;
  std::array<Squares<edge>, held> squares_;
};

/// One row of bricks along x, in blocks of 16 cells (two rows in 2D, a layer in 3D): what the squares of y and
/// z leave of r^2, a pair of rows at a time.
template <int edge>
struct BrickRow {
  static constexpr int pairs = 8 / edge;  ///< of rows in a block
  std::array<std::array<DoublePair, pairs>, 4> near, far;
  int first_block, last_block;  ///< that can touch the ball
  double best_near;             ///< greatest near
  double best_far, worst_far;   ///< greatest and least far; -infinite where nothing can be opaque
};

template <int edge>
void brick_row(const BrickRow<edge>& row, Line<edge>& line, std::size_t base, std::vector<BrickCover>& out) {
  for (std::int64_t b = line.first(); b <= line.last(); ++b) {
    const Squares<edge>& x = line.at(b);
    if (!(x.least_near <= row.best_near)) continue;
    BrickCover cover{static_cast<std::uint32_t>(base + static_cast<std::size_t>(b)), 0, 0};
    if (x.most_far < row.worst_far) {
      cover.touched = cover.opaque = ~std::uint64_t{0};
      out.push_back(cover);
      continue;
    }
    for (int k = row.first_block; k <= row.last_block; ++k) {
      cover.touched |= std::uint64_t{compare_rows<edge, false>(x.near.data(), row.near[k].data())} << (16 * k);
    }
    if (x.least_far < row.best_far) {
      for (int k = row.first_block; k <= row.last_block; ++k) {
        cover.opaque |= std::uint64_t{compare_rows<edge, true>(x.far.data(), row.far[k].data())} << (16 * k);
      }
    }
    if (cover.touched != 0) out.push_back(cover);
  }
}

/// Cells whose own half diagonal is not below the radius are never inside.
bool may_be_opaque(const Lattice& lattice, double radius) {
  return 4.0 * radius * radius > lattice.dimension() * lattice.cell() * lattice.cell();
}

struct Ball {
  Vec3 centre;
  double radius, margin;
  bool opaque;  ///< whether opaque cells are asked for and possible

  Range touched(const Axis& axis, int k, bool& outside) const {
    return axis.touched(centre[k] - (radius + margin), centre[k] + (radius + margin), outside);
  }
};

void disc(const Lattice& lattice, const Ball& ball, Cover& out) {
  constexpr int edge = 8;
  const Axis ax(lattice, 0), ay(lattice, 1);
  const Range x = ball.touched(ax, 0, out.outside), y = ball.touched(ay, 1, out.outside);
  if (x.empty() || y.empty()) return;
  Line<edge> line(ax, x, ball.centre.x, ball.margin);
  const double r2 = ball.radius * ball.radius;
  const DoublePair squared = DoublePair::both(r2);
  for (std::int64_t by = y.first / edge; by <= y.last / edge; ++by) {
    Squares<edge> sy;
    sy.fill(ay, by, ball.centre.y, ball.margin);
    BrickRow<edge> row;
    row.first_block = static_cast<int>(std::max<std::int64_t>(y.first - by * edge, 0)) / 2;
    row.last_block = static_cast<int>(std::min<std::int64_t>(y.last - by * edge, edge - 1)) / 2;
    for (int k = row.first_block; k <= row.last_block; ++k) {
      row.near[k][0] = squared - sy.near[k];
      row.far[k][0] = squared - sy.far[k];
    }
    row.best_near = r2 - sy.least_near;
    row.best_far = ball.opaque ? r2 - sy.least_far : -infinite;
    row.worst_far = ball.opaque ? r2 - sy.most_far : -infinite;
    brick_row<edge>(row, line, lattice.brick_index({0, by, 0}), out.bricks);
  }
}

/// Squares along an axis for the cells of at most three bricks.
struct ShortLine {
  static constexpr int bricks = 3;
  std::array<DoublePair, 2 * bricks> near, far;
  std::int64_t first_brick = 0;
  int first = 0, last = -1;  ///< cells that the ball may touch, counted from the first brick's first

  bool fits(const Range& cells) const { return (cells.last >> 2) - (cells.first >> 2) < bricks; }
  int count() const { return (last >> 2) + 1; }  ///< of bricks

  void fill(const Axis& axis, const Range& cells, double centre, double margin) {
    const DoublePair half = DoublePair::both(0.5 * axis.cell + margin);
    const DoublePair origin = DoublePair::both(axis.origin), cell = DoublePair::both(axis.cell);
    const DoublePair about = DoublePair::both(centre), none = DoublePair::both(0.0), two = DoublePair::both(2.0);
    first_brick = cells.first >> 2;
    const std::int64_t from = 4 * first_brick;
    first = static_cast<int>(cells.first - from);
    last = static_cast<int>(cells.last - from);
    DoublePair middle = DoublePair::of(static_cast<double>(from) + 0.5, static_cast<double>(from) + 1.5);
    for (std::size_t p = 0, pairs = 2 * static_cast<std::size_t>(count()); p < pairs; ++p) {
      const DoublePair away = absolute(origin + middle * cell - about);
      const DoublePair gap = greatest(away - half, none), reach = away + half;
      near[p] = gap * gap;
      far[p] = reach * reach;
      middle = middle + two;
    }
  }
  /// No ball touches or fills the cells beyond the lattice.
  void cut(std::int64_t cells) {
    for (int i = static_cast<int>(cells - 4 * first_brick); i < 4 * count(); ++i) {
      const auto p = static_cast<std::size_t>(i) / 2;
      const bool second = i % 2 != 0;
      near[p] = DoublePair::of(second ? near[p].first() : infinite, infinite);
      far[p] = DoublePair::of(second ? far[p].first() : infinite, infinite);
    }
  }
};

/// A sphere of at most three bricks along each axis, as most are, row by row of cells.
struct SmallSphere {
  ShortLine x, y, z;
  double r2;
  bool opaque;

  /// The cells of `width` bricks side by side; `base` is the index of the first.
  template <int width>
  void bricks(int by, int bz, std::size_t base, std::vector<BrickCover>& out) const {
    std::array<std::uint64_t, width> touched{}, filled{};
    std::array<double, 4> y_near, y_far;
    for (std::size_t p = 0; p < 2; ++p) {
      const std::size_t from = 2 * static_cast<std::size_t>(by) + p;
      y.near[from].store(y_near.data() + 2 * p);
      y.far[from].store(y_far.data() + 2 * p);
    }
    const int z_first = std::max(z.first - 4 * bz, 0), z_last = std::min(z.last - 4 * bz, 3);
    const int y_first = std::max(y.first - 4 * by, 0), y_last = std::min(y.last - 4 * by, 3);
    for (int k = z_first; k <= z_last; ++k) {
      const auto layer = static_cast<std::size_t>(4 * bz + k) / 2;
      const double z_near = k % 2 == 0 ? z.near[layer].first() : z.near[layer].second();
      const double z_far = k % 2 == 0 ? z.far[layer].first() : z.far[layer].second();
      for (int j = y_first; j <= y_last; ++j) {
        const auto row = static_cast<std::size_t>(j);
        const double near = r2 - (y_near[row] + z_near), far = r2 - (y_far[row] + z_far);
        const int shift = 4 * j + 16 * k;
        for (std::size_t b = 0; b < width; ++b) {
          touched[b] |= std::uint64_t{compare_row<false>(x.near.data() + 2 * b, near)} << shift;
        }
        if (!opaque || !(far > 0.0)) continue;
        for (std::size_t b = 0; b < width; ++b) {
          filled[b] |= std::uint64_t{compare_row<true>(x.far.data() + 2 * b, far)} << shift;
        }
      }
    }
    for (std::size_t b = 0; b < width; ++b) {
      if (touched[b] != 0) out.push_back({static_cast<std::uint32_t>(base + b), touched[b], filled[b]});
    }
  }

  template <int width>
  void all(const Lattice& lattice, std::vector<BrickCover>& out) const {
    for (int bz = 0; bz < z.count(); ++bz) {
      for (int by = 0; by < y.count(); ++by) {
        bricks<width>(by, bz, lattice.brick_index({x.first_brick, y.first_brick + by, z.first_brick + bz}), out);
      }
    }
  }
};

/// What is left of r^2 for the rows of one brick row of a sphere.
void set_row(BrickRow<4>& row, const Squares<4>& sy, const Squares<4>& sz, double r2, bool opaque) {
  row.best_near = r2 - (sy.least_near + sz.least_near);
  row.best_far = opaque ? r2 - (sy.least_far + sz.least_far) : -infinite;
  row.worst_far = opaque ? r2 - (sy.most_far + sz.most_far) : -infinite;
  const DoublePair squared = DoublePair::both(r2);
  for (int k = row.first_block; k <= row.last_block; ++k) {
    const DoublePair near = sz.near[k / 2], far = sz.far[k / 2];
    const DoublePair z_near = DoublePair::both(k % 2 == 0 ? near.first() : near.second());
    for (int p = 0; p < 2; ++p) row.near[k][p] = squared - (sy.near[p] + z_near);
    if (!(row.best_far > 0.0)) continue;
    const DoublePair z_far = DoublePair::both(k % 2 == 0 ? far.first() : far.second());
    for (int p = 0; p < 2; ++p) row.far[k][p] = squared - (sy.far[p] + z_far);
  }
}

void sphere(const Lattice& lattice, const Ball& ball, Cover& out) {
  constexpr int edge = 4;
  const Axis ax(lattice, 0), ay(lattice, 1), az(lattice, 2);
  const Range x = ball.touched(ax, 0, out.outside), y = ball.touched(ay, 1, out.outside);
  const Range z = ball.touched(az, 2, out.outside);
  if (x.empty() || y.empty() || z.empty()) return;
  SmallSphere small;
  if (small.x.fits(x) && small.y.fits(y) && small.z.fits(z)) {
    small.x.fill(ax, x, ball.centre.x, ball.margin);
    small.y.fill(ay, y, ball.centre.y, ball.margin);
    small.z.fill(az, z, ball.centre.z, ball.margin);
    if (4 * (small.x.first_brick + small.x.count()) > ax.cells) small.x.cut(ax.cells);
    small.r2 = ball.radius * ball.radius;
    small.opaque = ball.opaque;
    if (small.x.count() == 1) return small.all<1>(lattice, out.bricks);
    if (small.x.count() == 2) return small.all<2>(lattice, out.bricks);
    return small.all<3>(lattice, out.bricks);
  }
  Line<edge> line(ax, x, ball.centre.x, ball.margin), rows(ay, y, ball.centre.y, ball.margin);
  const double r2 = ball.radius * ball.radius;
  for (std::int64_t bz = z.first / edge; bz <= z.last / edge; ++bz) {
    Squares<edge> sz;
    sz.fill(az, bz, ball.centre.z, ball.margin);
    BrickRow<edge> row;
    row.first_block = static_cast<int>(std::max<std::int64_t>(z.first - bz * edge, 0));
    row.last_block = static_cast<int>(std::min<std::int64_t>(z.last - bz * edge, edge - 1));
    for (std::int64_t by = rows.first(); by <= rows.last(); ++by) {
      const Squares<edge>& sy = rows.at(by);
      if (!(sy.least_near + sz.least_near <= r2)) continue;
      set_row(row, sy, sz, r2, ball.opaque);
      brick_row<edge>(row, line, lattice.brick_index({0, by, bz}), out.bricks);
    }
  }
}

}  // namespace

void ball(const Lattice& lattice, const Vec3& centre, double radius, bool with_opaque, Cover& out) {
  const bool flat = lattice.dimension() == 2;
  const double across = std::max(std::abs(centre.x), std::abs(centre.y));
  const double margin = lattice.margin((flat ? across : std::max(across, std::abs(centre.z))) + radius);
  const Ball ball{centre, radius, margin, with_opaque && may_be_opaque(lattice, radius)};
  if (flat) {
    disc(lattice, ball, out);
  } else {
    sphere(lattice, ball, out);
  }
}

}  // namespace gridcull::covering

namespace gridcull {

void cover_ball(const Lattice& lattice, const Vec3& centre, double radius, Cover& out) {
  out.clear();
  covering::ball(lattice, centre, radius, false, out);
}

}  // namespace gridcull
