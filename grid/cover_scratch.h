// Working memory of discretisation: one per thread, so that a steady state allocates nothing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/vec.h"

namespace gridcull {

/// The cells of one brick (64 cells, see Lattice). opaque is a subset of touched.
struct BrickCover {
  std::uint32_t brick;
  std::uint64_t touched;
  std::uint64_t opaque;
};

/// One edge of an outline, lower end first, with its rows clipped to the lattice.
struct OutlineEdge {
  Vec2 low, high;                    ///< low.y <= high.y, metres
  double slope;                      ///< dx / dy; 0 where the edge is level
  double x_min, x_max;               ///< metres
  std::int64_t first_row, last_row;  ///< rows of cells it touches, inclusive, inside the lattice
  bool level;                        ///< less high than the margin: every row it touches gets its whole x range
};

/// A direction in which a convex body lies between two planes: low <= dot(direction, p - reference) <= high.
struct ConvexSlab {
  Vec3 direction;  ///< any length
  double low, high;
  /// Points with inner_low < dot(direction, p - reference) < inner_high in all full slabs lie in the body.
  double inner_low, inner_high;
};

/// A convex body as an intersection of slabs. Those in xy have no z part and bound x by y, and so on.
struct ConvexBody {
  Vec3 reference{0.0};  ///< a point near the body
  Bounds bounds;        ///< metres
  std::vector<ConvexSlab> full, xy, xz, yz;
  bool has_inside = false;  ///< whether the full slabs' inner bounds describe an interior

  void clear() {
    full.clear();
    xy.clear();
    xz.clear();
    yz.clear();
    has_inside = false;
  }
};

/// A triangle of a closed mesh that may meet the middle line of a row of cells along x.
struct MeshRow {
  std::int64_t row;  ///< z * cells().y + y
  std::uint32_t triangle;
};

/// Only grid/cover*.cpp look inside; contents mean nothing between two covers.
struct CoverScratch {
  std::vector<Vec2> outline;             ///< world outline
  std::vector<Vec3> vertices;            ///< world vertices
  std::vector<Vec2> chain;               ///< convex hull of a projection
  std::vector<OutlineEdge> edges;        ///< ascending by first_row
  std::vector<std::uint32_t> active;     ///< edges that meet the current row of bricks
  std::vector<std::uint64_t> boundary;   ///< words of one row of bricks: cells that the outline touches
  std::vector<std::uint64_t> crossings;  ///< words of one row of bricks: changes of parity
  std::vector<BrickCover> tiles;         ///< planar bricks of a prism's outline; cells inside a mesh
  std::vector<MeshRow> mesh_rows;
  std::vector<std::array<std::uint32_t, 3>> row_triangles;  ///< of the row in hand
  ConvexBody body;
};

}  // namespace gridcull
