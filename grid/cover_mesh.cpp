// The inside of a closed mesh, once the cells that its triangles touch are known.
//
// Claim: a cell is opaque only if it lies in the open interior. The cells of a row between two touched ones are joined,
// and no triangle meets any of them (each was judged grown by the margin), so they lie all inside or all outside;
// the side of the first one's centre is exact (core/mesh.h). The ray that decides it runs along the row, so it meets no
// triangles but those that it meets in the plane of y and z: at the row's middle height they reach from y to y around
// it, found with a cell to spare on both sides.
//
// Cost: an entry for each row that a triangle meets, and a few; in each row a test of its triangles for each gap.
#include <algorithm>
#include <array>

#include "gridcull/core/mesh.h"
#include "gridcull/grid/cover_kernels.h"

namespace gridcull::covering {
namespace {

struct Range {
  std::int64_t first, last;  ///< inclusive
};

/// The lattice's cells along an axis between two places.
Range cells_between(const Lattice& lattice, int axis, double low, double high) {
  const Cell n = lattice.cells();
  const std::int64_t count = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  return {std::max<std::int64_t>(lattice.index(axis, low), 0), std::min(lattice.index(axis, high), count - 1)};
}

Vec3 centre_of(const Lattice& lattice, const Cell& c) {
  return {0.5 * (lattice.boundary(0, c.x) + lattice.boundary(0, c.x + 1)),
          0.5 * (lattice.boundary(1, c.y) + lattice.boundary(1, c.y + 1)),
          0.5 * (lattice.boundary(2, c.z) + lattice.boundary(2, c.z + 1))};
}

/// Along y, where the triangle meets the level z; empty where it does not.
Bounds at_level(const std::array<Vec3, 3>& t, double z) {
  Bounds out;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = t[k], &b = t[(k + 1) % 3];
    if (a.z == z) out.add(a);
    if ((a.z < z) == (b.z < z)) continue;
    const double share = std::clamp((z - a.z) / (b.z - a.z), 0.0, 1.0);
    out.add(a + share * (b - a));
  }
  return out;
}

void add_rows(const Lattice& lattice, const std::vector<Vec3>& vertices, std::span<const Triangle> triangles,
              std::vector<MeshRow>& rows) {
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    Bounds box;
    for (const std::uint32_t corner : triangles[i]) box.add(vertices[corner]);
    const std::array<Vec3, 3> t{vertices[triangles[i][0]], vertices[triangles[i][1]], vertices[triangles[i][2]]};
    const Range zs = cells_between(lattice, 2, box.min.z, box.max.z);
    for (std::int64_t z = zs.first; z <= zs.last; ++z) {
      const Bounds cut = at_level(t, centre_of(lattice, {0, 0, z}).z);
      if (cut.empty()) continue;
      // A cell more on either side than any rounding of the cut could need.
      const Range ys = cells_between(lattice, 1, cut.min.y - lattice.cell(), cut.max.y + lattice.cell());
      for (std::int64_t y = ys.first; y <= ys.last; ++y) rows.push_back({z * lattice.cells().y + y, i});
    }
  }
  std::sort(rows.begin(), rows.end(), [](const MeshRow& a, const MeshRow& b) {
    return a.row != b.row ? a.row < b.row : a.triangle < b.triangle;
  });
}

/// Walks one row: says of each of its cells in turn whether a triangle touches it.
class TouchedInRow {
 public:
  TouchedInRow(const Lattice& lattice, const std::vector<BrickCover>& bricks, const Cell& first)
      : lattice_(lattice), end_(bricks.end()) {
    at_ = std::lower_bound(bricks.begin(), end_, lattice.brick_of(first),
                           [](const BrickCover& b, std::size_t brick) { return b.brick < brick; });
  }
  /// Cells in ascending order.
  bool operator()(const Cell& c) {
    const std::size_t brick = lattice_.brick_of(c);
    while (at_ != end_ && at_->brick < brick) ++at_;
    return at_ != end_ && at_->brick == brick && (at_->touched >> lattice_.bit_of(c) & 1) != 0;
  }

 private:
  const Lattice& lattice_;
  std::vector<BrickCover>::const_iterator at_, end_;
};

void add_cell(const Lattice& lattice, const Cell& c, std::vector<BrickCover>& out) {
  const auto brick = static_cast<std::uint32_t>(lattice.brick_of(c));
  if (out.empty() || out.back().brick != brick) out.push_back({brick, 0, 0});
  out.back().touched |= std::uint64_t{1} << lattice.bit_of(c);
  out.back().opaque = out.back().touched;
}

void fill_row(const Lattice& lattice, const std::vector<Vec3>& vertices, std::span<const Triangle> triangles,
              const Cell& start, const std::vector<BrickCover>& touched, std::vector<BrickCover>& out) {
  Bounds box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t corner : t) box.add(vertices[corner]);
  }
  const Range xs = cells_between(lattice, 0, box.min.x, box.max.x);
  TouchedInRow touches(lattice, touched, {xs.first, start.y, start.z});
  bool in_gap = false, inside = false;
  for (Cell c{xs.first, start.y, start.z}; c.x <= xs.last; ++c.x) {
    if (touches(c)) {
      in_gap = false;
      continue;
    }
    if (!in_gap) inside = side_of_mesh(vertices, triangles, centre_of(lattice, c)) == MeshSide::inside;
    in_gap = true;
    if (inside) add_cell(lattice, c, out);
  }
}

}  // namespace

void fill_mesh(const Lattice& lattice, const std::vector<Vec3>& vertices, std::span<const Triangle> triangles,
               CoverScratch& scratch, Cover& out) {
  std::vector<MeshRow>& rows = scratch.mesh_rows;
  rows.clear();
  scratch.tiles.clear();
  add_rows(lattice, vertices, triangles, rows);
  for (std::size_t i = 0; i < rows.size();) {
    const std::int64_t row = rows[i].row;
    scratch.row_triangles.clear();
    for (; i < rows.size() && rows[i].row == row; ++i) scratch.row_triangles.push_back(triangles[rows[i].triangle]);
    const Cell start{0, row % lattice.cells().y, row / lattice.cells().y};
    fill_row(lattice, vertices, scratch.row_triangles, start, out.bricks, scratch.tiles);
  }
  out.bricks.insert(out.bricks.end(), scratch.tiles.begin(), scratch.tiles.end());
}

}  // namespace gridcull::covering
