// A convex polytope as points and the edges between them, for cutting and projecting.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/vec.h"

namespace gridcull::extended {

/// The hull of its points. Every edge joins two of them, so whatever is made of points and edges (cuts, chords of a
/// view) lies in the hull: an edge too few or one through the inside makes it smaller, never larger.
struct Polytope {
  std::vector<Vec3> points{};
  std::vector<std::array<std::uint32_t, 2>> edges{};
};

/// Cuts polytopes; storage is reused.
class Clipper {
 public:
  /// Keeps what has sign * p[axis] >= bound. New points lie on edges, to the rounding of one interpolation (2^-51 of
  /// the coordinates' size) along the two other axes and exactly on the bound along this one.
  void operator()(Polytope& polytope, int axis, double sign, double bound);

 private:
  void add_ring(int axis);

  Polytope out_{};
  std::vector<std::uint32_t> kept_{}, ring_{}, order_{}, corners_{};
  std::vector<Vec2> flat_{};
};

/// Corners of the convex hull of points in a plane, counter-clockwise, as indices; their order decides ties. What
/// rounding does to a turn can only drop a corner. `order` is overwritten.
void hull_corners(const std::vector<Vec2>& points, std::vector<std::uint32_t>& order,
                  std::vector<std::uint32_t>& corners);

}  // namespace gridcull::extended
