// Outlines in the plane: polygons (concave, self-crossing, with spikes) and open chains.
//
// Batagelo and Wu 2002, section 4.1: the outline as a thick line gives the cells partly covered, the rest of
// the interior is opaque. Two changes: the thick line is exact (a segment cut by a row of cells has one x
// interval, and exactly the cells of that interval meet it), and the interior is filled by even-odd parity
// between boundary cells, 64 cells at a time.
// A cell that no edge touches lies wholly on one side, so the parity at its centre decides for all of it. An
// edge that crosses the line of cell centres crosses it inside a cell that it touches; that cell gets a parity
// change, and the running exclusive-or along the row gives the parity of every later cell of it that no edge
// touches, wherever inside its cells the crossings lie.
#include <cmath>

#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_kernels.h"
#include "gridcull/grid/cover_words.h"

namespace gridcull::covering {
namespace {

/// Masks of a planar brick of edge x edge bits: `columns(k)` has bits k and up of every row.
template <int edge>
struct Words {
  static constexpr std::uint64_t row = (std::uint64_t{1} << edge) - 1;
  static constexpr std::uint64_t left = edge == 8 ? 0x0101'0101'0101'0101ull : 0x1111ull;  ///< first bit of each row
  static constexpr std::uint64_t columns(int k) { return left * ((row << k) & row); }

  /// Running exclusive-or of each row from its first bit on.
  static std::uint64_t parity(std::uint64_t w) {
    w ^= (w << 1) & columns(1);
    w ^= (w << 2) & columns(2);
    if constexpr (edge == 8) w ^= (w << 4) & columns(4);
    return w;
  }
  /// All bits of the rows whose last bit is set.
  static std::uint64_t carry(std::uint64_t w) { return ((w >> (edge - 1)) & left) * row; }
};

class Plane {
 public:
  Plane(const Lattice& lattice, double margin) : ax_(lattice, 0), ay_(lattice, 1), margin_(margin) {}

  /// The edge with its rows; false when it meets no row of the lattice or cannot matter to one.
  bool prepare(const Vec2& a, const Vec2& b, OutlineEdge& e) const {
    e.low = a.y <= b.y ? a : b;
    e.high = a.y <= b.y ? b : a;
    e.x_min = std::min(a.x, b.x);
    e.x_max = std::max(a.x, b.x);
    bool ignored = false;
    const Range rows = ay_.touched(e.low.y - margin_, e.high.y + margin_, ignored);
    const bool beyond = ax_.in_cells(e.x_min - margin_) >= static_cast<double>(ax_.cells);
    if (rows.empty() || beyond) return false;
    e.first_row = rows.first;
    e.last_row = rows.last;
    const double height = e.high.y - e.low.y;
    e.level = height < margin_;
    e.slope = e.level ? 0.0 : (e.high.x - e.low.x) / height;
    return true;
  }

  /// Where the edge is at height y, kept within the edge.
  double x_at(const OutlineEdge& e, double y) const {
    return std::max(e.x_min, std::min(e.x_max, e.low.x + (y - e.low.y) * e.slope));
  }

  /// Cells of a row that the edge touches, clipped to the lattice.
  Range touched(const OutlineEdge& e, std::int64_t row) const {
    double a = e.x_min, b = e.x_max;
    if (!e.level) {
      const double bottom = ay_.boundary(row) - margin_, top = ay_.boundary(row + 1) + margin_;
      const double first = e.low.y >= bottom ? e.low.x : x_at(e, bottom);
      const double last = e.high.y <= top ? e.high.x : x_at(e, top);
      a = std::min(first, last);
      b = std::max(first, last);
    }
    bool ignored = false;
    return ax_.touched(a - margin_, b + margin_, ignored);
  }

  /// Cell of the row in which the edge crosses the line of cell centres: -1 left of the lattice, cells() right
  /// of it; none() when it does not cross.
  std::int64_t crossing(const OutlineEdge& e, std::int64_t row) const {
    const double y = ay_.boundary(row) + 0.5 * ay_.cell;
    if ((e.low.y <= y) == (e.high.y <= y)) return none();
    return floor_within(ax_.in_cells(e.level ? e.x_min : x_at(e, y)), -1, ax_.cells);
  }
  static constexpr std::int64_t none() { return -2; }

  const Axis& x() const { return ax_; }
  const Axis& y() const { return ay_; }

 private:
  Axis ax_, ay_;
  double margin_;
};

/// One row of bricks being drawn.
template <int edge>
class Band {
 public:
  Band(CoverScratch& scratch, std::int64_t bricks) : boundary_(scratch.boundary), crossings_(scratch.crossings) {
    if (boundary_.size() < static_cast<std::size_t>(bricks)) {
      boundary_.resize(static_cast<std::size_t>(bricks));
      crossings_.resize(static_cast<std::size_t>(bricks));
    }
  }

  void start() {
    first_ = 0;
    last_ = -1;
    left_ = 0;
  }
  void touch(int row, const Range& cells) {
    const std::int64_t first = cells.first / edge, last = cells.last / edge;
    reach(first, last);
    for (std::int64_t b = first; b <= last; ++b) {
      const auto low = static_cast<int>(std::max<std::int64_t>(cells.first - b * edge, 0));
      const auto high = static_cast<int>(std::min<std::int64_t>(cells.last - b * edge, edge - 1));
      boundary_[static_cast<std::size_t>(b)] |= run(low, high) << (edge * row);
    }
  }
  /// The cell is touched already.
  void cross(int row, std::int64_t cell) {
    crossings_[static_cast<std::size_t>(cell / edge)] ^= std::uint64_t{1} << (edge * row + cell % edge);
  }
  void cross_left(int row) { left_ ^= Words<edge>::row << (edge * row); }

  /// Appends the bricks of the band. `rows` are its rows inside the lattice.
  void finish(std::size_t base, const Axis& x, std::uint64_t rows, bool closed, std::vector<BrickCover>& out) {
    const std::int64_t bricks = (x.cells + edge - 1) / edge;
    if (left_ != 0) reach(0, 0);
    std::uint64_t carry = left_;
    for (std::int64_t b = first_; b <= last_ || (carry != 0 && b < bricks); ++b) {
      const bool drawn = b <= last_;
      const std::uint64_t boundary = drawn ? boundary_[static_cast<std::size_t>(b)] : 0;
      const std::uint64_t crossings = drawn ? crossings_[static_cast<std::size_t>(b)] : 0;
      const std::uint64_t odd = Words<edge>::parity(crossings) ^ carry;
      carry = Words<edge>::carry(odd);
      const bool sticks_out = (b + 1) * edge > x.cells;
      const std::uint64_t cells =
          sticks_out ? rows & ~Words<edge>::columns(static_cast<int>(x.cells - b * edge)) : rows;
      const std::uint64_t inside = closed ? odd & ~boundary & cells : 0;
      if ((boundary | inside) == 0) continue;
      out.push_back({static_cast<std::uint32_t>(base + static_cast<std::size_t>(b)), boundary | inside, inside});
    }
  }

 private:
  /// Extends the words in use to bricks first .. last, cleared.
  void reach(std::int64_t first, std::int64_t last) {
    if (last_ < first_) {
      clear(first, last);
      first_ = first;
      last_ = last;
      return;
    }
    if (first < first_) clear(first, first_ - 1), first_ = first;
    if (last > last_) clear(last_ + 1, last), last_ = last;
  }
  void clear(std::int64_t first, std::int64_t last) {
    for (std::int64_t b = first; b <= last; ++b) {
      boundary_[static_cast<std::size_t>(b)] = 0;
      crossings_[static_cast<std::size_t>(b)] = 0;
    }
  }

  std::vector<std::uint64_t>& boundary_;
  std::vector<std::uint64_t>& crossings_;
  std::int64_t first_ = 0, last_ = -1;
  std::uint64_t left_ = 0;  ///< rows with odd parity left of the lattice, whole rows of bits
};

/// Draws the rows of one edge that lie in the band of bricks `band`.
template <int edge>
void draw(const Plane& plane, const OutlineEdge& e, std::int64_t band, bool closed, Band<edge>& bits) {
  const std::int64_t last = std::min(e.last_row, band * edge + edge - 1);
  for (std::int64_t row = std::max(e.first_row, band * edge); row <= last; ++row) {
    const auto j = static_cast<int>(row - band * edge);
    const Range cells = plane.touched(e, row);
    if (!cells.empty()) bits.touch(j, cells);
    if (!closed) continue;
    const std::int64_t crossing = plane.crossing(e, row);
    if (crossing == -1) {
      bits.cross_left(j);
    } else if (crossing >= 0 && crossing < plane.x().cells) {
      bits.cross(j, crossing);
    }
  }
}

template <int edge>
void draw_all(const Lattice& lattice, const Plane& plane, bool closed, CoverScratch& scratch,
              std::vector<BrickCover>& out) {
  const std::vector<OutlineEdge>& edges = scratch.edges;
  std::int64_t last_row = -1;
  for (const OutlineEdge& e : edges) last_row = std::max(last_row, e.last_row);
  Band<edge> bits(scratch, lattice.bricks().x);
  scratch.active.clear();
  std::size_t next = 0;
  for (std::int64_t band = edges.front().first_row / edge; band <= last_row / edge; ++band) {
    while (next < edges.size() && edges[next].first_row / edge <= band) {
      scratch.active.push_back(static_cast<std::uint32_t>(next++));
    }
    bits.start();
    std::size_t kept = 0;
    for (const std::uint32_t i : scratch.active) {
      draw<edge>(plane, edges[i], band, closed, bits);
      if (edges[i].last_row / edge > band) scratch.active[kept++] = i;
    }
    scratch.active.resize(kept);
    const std::int64_t rows = std::min<std::int64_t>(edge, plane.y().cells - band * edge);
    const std::uint64_t cells = rows * edge == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << (rows * edge)) - 1;
    bits.finish(static_cast<std::size_t>(band * lattice.bricks().x), plane.x(), cells, closed, out);
  }
}

}  // namespace

void outline(const Lattice& lattice, std::span<const Vec2> points, bool closed, double margin, CoverScratch& scratch,
             std::vector<BrickCover>& out, bool& outside) {
  const Plane plane(lattice, margin);
  Bounds bounds;
  for (const Vec2& p : points) bounds.add({p.x, p.y, 0.0});
  const Range x = plane.x().touched(bounds.min.x - margin, bounds.max.x + margin, outside);
  const Range y = plane.y().touched(bounds.min.y - margin, bounds.max.y + margin, outside);
  if (x.empty() || y.empty()) return;
  scratch.edges.clear();
  OutlineEdge e;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (plane.prepare(points[i], points[i + 1], e)) scratch.edges.push_back(e);
  }
  if (closed && plane.prepare(points.back(), points.front(), e)) scratch.edges.push_back(e);
  if (scratch.edges.empty()) return;
  const auto earlier = [](const OutlineEdge& a, const OutlineEdge& b) { return a.first_row < b.first_row; };
  std::sort(scratch.edges.begin(), scratch.edges.end(), earlier);
  if (lattice.dimension() == 2) {
    draw_all<8>(lattice, plane, closed, scratch, out);
  } else {
    draw_all<4>(lattice, plane, closed, scratch, out);
  }
}

}  // namespace gridcull::covering
