// A discrete orientation polytope as its intervals: Bartz, Klosowski, Staneker 2005, section 3 (bounding slabs of
// Kay and Kajiya 1986). k planes are k / 2 intervals along fixed directions with entries -1, 0, 1.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/convex_boundary.h"

namespace gridcull {

struct SlabDirection {
  int x, y, z;    ///< -1, 0, 1; not normalised
  double length;  ///< rounded up
};

/// All directions: 3 axes, 4 corners, 6 edges (13 of the 26 planes' normals, the others being opposite).
inline constexpr std::array<SlabDirection, 13> slab_directions{{{1, 0, 0, 1.0},
                                                                {0, 1, 0, 1.0},
                                                                {0, 0, 1, 1.0},
                                                                {1, 1, 1, 1.7320508075688774},
                                                                {1, -1, 1, 1.7320508075688774},
                                                                {1, 1, -1, 1.7320508075688774},
                                                                {-1, 1, 1, 1.7320508075688774},
                                                                {1, 1, 0, 1.4142135623730951},
                                                                {1, 0, 1, 1.4142135623730951},
                                                                {0, 1, 1, 1.4142135623730951},
                                                                {1, -1, 0, 1.4142135623730951},
                                                                {1, 0, -1, 1.4142135623730951},
                                                                {0, 1, -1, 1.4142135623730951}}};

/// Intervals low[j] <= dot(direction j, p) <= high[j] along those directions that the kind has.
struct Slabs {
  BoundKind kind = BoundKind::box;  ///< box or a k-DOP
  int dimension = 3;
  std::array<double, 13> low{}, high{};  ///< as rounded: off by less than 2^-51 of `size`
  double size = 0.0;                     ///< greatest |x| + |y| + |z| of a point, rounded up; metres

  /// Which of slab_directions: in 2D x, y and the two diagonals between them (box: x and y).
  bool has(std::size_t direction) const;
};

/// Of a non-empty set of points: O(nk), without multiplications.
Slabs slabs_of(std::span<const Vec3> points, BoundKind kind, int dimension);
/// Of a ball or disc.
Slabs slabs_of_ball(const Vec3& centre, double radius, BoundKind kind, int dimension);

/// Vertices and faces of the slabs when every plane is moved out by `grown` metres or up to 1.75 times that (more than
/// 2^-44 of `size`). The convex hull of the vertices as stored contains every point within grown - 2^-44 size of a
/// point that the slabs were made of. `out` is overwritten.
void slab_boundary(const Slabs& slabs, double grown, ConvexBoundary& out);

/// The first points found farthest along each of slab_directions, and against it. Not empty.
struct Extremes {
  std::array<std::uint32_t, 13> lowest{}, highest{};
};
Extremes extremes_of(std::span<const Vec3> points);

}  // namespace gridcull
