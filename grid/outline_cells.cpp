// Hollow temporal bounding volumes (Batagelo and Wu 2002, sections 4.1 and 5.2).
//
// Barrier. Let D be a set of cells that holds every cell the object can touch, B its cells with one of their
// eight (26 in 3D) neighbours outside D, and N = D \ B. (1) A path of cells, diagonal steps allowed, from
// outside D to a cell of N enters D at a cell with a neighbour outside D, which is in B. (2) Take a segment from
// a point outside the closed cells of D to a point of the object. If that point lies in a closed cell of B, done.
// Otherwise it lies in one of N. The closed cells of N and the closed cells outside D have no point in common,
// since cells that share one are neighbours; a segment that begins in the latter set and ends in the former
// has therefore a point in neither, and that point lies in a cell of B.
// So outlines of D are safe for any D that holds the touched cells: a digital disc in 2D, a box in 3D. The
// paper's circle may cut cells that the object touches; here the radius is chosen to hold them all.
#include "gridcull/grid/outline_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_words.h"

namespace gridcull {
namespace {

using namespace covering;

/// Circles beyond this many cells are taken to enclose everything; squares of smaller ones fit 64 bits.
constexpr std::int64_t greatest_radius = std::int64_t{1} << 30;

/// Greatest x^2 + y^2 of a cell (relative to the centre's) that the disc touches; all in cells. `at` is the
/// distance of the disc's centre from its cell's centre along x and y, 0 .. 1/2: the disc reaches farthest
/// into the quadrant towards which it is off its cell's centre.
std::int64_t greatest_square(double radius, const Vec2& at, double margin) {
  std::int64_t best = 0;
  for (std::int64_t j = 0;; ++j) {
    const double gap = std::max(0.0, static_cast<double>(j) - 0.5 - at.y - margin);
    if (gap > radius) return best;
    const double half = std::sqrt(radius * radius - gap * gap);
    const auto i = static_cast<std::int64_t>(at.x + 0.5 + half + margin);
    best = std::max(best, i * i + j * j);
  }
}

/// Least R >= 0 with R^2 + R >= square.
std::int64_t radius_for(std::int64_t square) {
  auto r = static_cast<std::int64_t>(std::sqrt(static_cast<double>(square)));
  while (r > 0 && (r - 1) * r >= square) --r;
  while (r * (r + 1) < square) ++r;
  return r;
}

/// Half widths w(j) of the rows of a digital disc, greatest w with w^2 + j^2 <= R^2 + R, or -1 without cells.
/// Neighbouring rows are asked for one after the other, so the total cost is about R steps.
class HalfWidth {
 public:
  explicit HalfWidth(std::int64_t radius) : square_(radius * radius + radius) {}
  std::int64_t of(std::int64_t j) {
    while (w_ >= 0 && w_ * w_ + j * j > square_) --w_;
    while ((w_ + 1) * (w_ + 1) + j * j <= square_) ++w_;
    return w_;
  }

 private:
  std::int64_t square_, w_ = -1;
};

/// Appends the square outline u.first .. u.last by v.first .. v.last; `bricks_u` bricks make a row.
void square_outline(const Range& u, const Range& v, std::int64_t bricks_u, std::vector<PlanarBrick>& out) {
  for (std::int64_t bv = v.first / 4; bv <= v.last / 4; ++bv) {
    const bool end = bv == v.first / 4 || bv == v.last / 4;
    const std::int64_t first = u.first / 4, last = u.last / 4;
    const std::int64_t step = end ? 1 : std::max<std::int64_t>(last - first, 1);  // only the sides in between
    for (std::int64_t bu = first; bu <= last; bu += step) {
      const auto from = static_cast<int>(std::max<std::int64_t>(u.first - 4 * bu, 0));
      const auto to = static_cast<int>(std::min<std::int64_t>(u.last - 4 * bu, 3));
      std::uint64_t sides = 0, mask = 0;
      if (u.first / 4 == bu) sides |= run(from, from);
      if (u.last / 4 == bu) sides |= run(to, to);
      for (int row = 0; row < 4; ++row) {
        const std::int64_t at = 4 * bv + row;
        if (at < v.first || at > v.last) continue;
        mask |= (at == v.first || at == v.last ? run(from, to) : sides) << (4 * row);
      }
      if (mask != 0) {
        out.push_back({static_cast<std::uint32_t>(bv * bricks_u + bu), static_cast<std::uint16_t>(mask)});
      }
    }
  }
}

}  // namespace

CircleOutline circle_outline(const Lattice& lattice, const Vec3& centre, double radius) {
  const double cell = lattice.cell();
  const double margin = lattice.margin(std::max(std::abs(centre.x), std::abs(centre.y)) + radius) / cell;
  CircleOutline circle;
  circle.centre = lattice.cell_of(centre);
  const Cell n = lattice.cells();
  const double in_cells = radius / cell;
  if (in_cells > static_cast<double>(std::max(n.x, n.y))) {
    // Far too large to be whole; two half diagonals of a cell cover every position of the centre.
    circle.radius = static_cast<std::int64_t>(std::min(in_cells + margin, 0x1p40)) + 3;
    return circle;
  }
  const auto off = [&](int axis, std::int64_t i) {
    return std::min(std::abs((centre[axis] - lattice.boundary(axis, i)) / cell - 0.5), 0.5);
  };
  const Vec2 at(off(0, circle.centre.x), off(1, circle.centre.y));
  circle.radius = radius_for(greatest_square(in_cells, at, margin));
  const Cell c = circle.centre;
  const std::int64_t r = circle.radius;
  circle.whole = c.x - r >= 0 && c.y - r >= 0 && c.x + r < n.x && c.y + r < n.y;
  return circle;
}

void cover_circle_outline(const Lattice& lattice, const CircleOutline& circle, Cover& out) {
  constexpr int edge = 8;
  out.clear();
  out.outside = !circle.whole;
  if (out.outside) return;
  const Cell c = circle.centre;
  const std::int64_t r = circle.radius;
  HalfWidth width(r), next(r);
  const std::int64_t first = (c.x - r) / edge, last = (c.x + r) / edge;
  for (std::int64_t by = (c.y - r) / edge; by <= (c.y + r) / edge; ++by) {
    const std::size_t from = out.bricks.size();
    BrickCover* bricks = append_bricks(out.bricks, lattice.brick_index({0, by, 0}), first, last);
    const std::int64_t end = std::min(c.y + r, by * edge + edge - 1);
    for (std::int64_t y = std::max(c.y - r, by * edge); y <= end; ++y) {
      const std::int64_t j = std::abs(y - c.y);
      const std::int64_t outer = width.of(j), inner = std::max<std::int64_t>(next.of(j + 1), 0);
      const int shift = edge * static_cast<int>(y - by * edge);
      fill_run<edge, &BrickCover::touched>(bricks, first, shift, {c.x - outer, c.x - inner});
      fill_run<edge, &BrickCover::touched>(bricks, first, shift, {c.x + inner, c.x + outer});
    }
    drop_empty(out.bricks, from);
  }
}

void cover_circle_outline(const Lattice& lattice, const Vec3& centre, double radius, Cover& out) {
  cover_circle_outline(lattice, circle_outline(lattice, centre, radius), out);
}

bool circle_encloses(const CircleOutline& circle, const Cell& cell) {
  const std::int64_t x = std::abs(cell.x - circle.centre.x), y = std::abs(cell.y - circle.centre.y);
  const std::int64_t r = circle.radius;
  if (r > greatest_radius) return true;
  if (x > r || y > r) return false;
  return x * x + y * y <= r * r + r;
}

bool circle_encloses(const Lattice& lattice, const Vec3& centre, double radius, const Cell& cell) {
  return circle_encloses(circle_outline(lattice, centre, radius), cell);
}

CubeCells cube_cells(const Lattice& lattice, const Vec3& centre, double radius) {
  const double reach =
      radius + lattice.margin(std::max({std::abs(centre.x), std::abs(centre.y), std::abs(centre.z)}) + radius);
  CubeCells cube{lattice.cell_of(centre - Vec3(reach)), lattice.cell_of(centre + Vec3(reach)), false};
  cube.whole = lattice.holds(cube.low) && lattice.holds(cube.high);
  return cube;
}

bool cube_encloses(const CubeCells& cube, const Cell& cell) {
  return cell.x >= cube.low.x && cell.x <= cube.high.x && cell.y >= cube.low.y && cell.y <= cube.high.y &&
         cell.z >= cube.low.z && cell.z <= cube.high.z;
}

void cover_cube_outline(const Lattice& lattice, const CubeCells& cube, CubeOutline& out) {
  for (auto& plane : out.plane) plane.clear();
  out.outside = !cube.whole;
  if (out.outside) return;
  const Range x{cube.low.x, cube.high.x}, y{cube.low.y, cube.high.y}, z{cube.low.z, cube.high.z};
  square_outline(x, y, lattice.bricks().x, out.plane[0]);
  square_outline(x, z, lattice.bricks().x, out.plane[1]);
  square_outline(y, z, lattice.bricks().y, out.plane[2]);
}

void cover_cube_outline(const Lattice& lattice, const Vec3& centre, double radius, CubeOutline& out) {
  cover_cube_outline(lattice, cube_cells(lattice, centre, radius), out);
}

}  // namespace gridcull
