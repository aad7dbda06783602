// Shapes in local axes, ready for rays: where does a line run inside one?
//
// In doubles, in the shape's own axes: a line that passes within about 1e-12 (relative) of an edge may be answered
// either way. Good for methods that sample; nothing conservative may rest on it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/core/half_space.h"
#include "gridcull/core/shape.h"

namespace gridcull {

struct LocalShape {
  enum class Kind {
    ball,     ///< Disc, Sphere
    box,      ///< Rectangle (z without limits), Cuboid
    outline,  ///< Polygon (z without limits), Prism
    hull,     ///< Convex
    chain,    ///< Polyline: thin
    faces     ///< Faces: thin; Volume, by boxes within it
  };
  Kind kind = Kind::ball;
  Vec3 middle{0.0};                                       ///< of the local box; a ball's is its position
  Vec3 half{0.0};                                         ///< of the local box; in 2D z is 0
  double radius = 0.0;                                    ///< about `middle`: holds the shape; a ball's own
  bool flat = false;                                      ///< 2D
  std::vector<Vec2> points{};                             ///< outline (merged), chain
  std::vector<HalfSpace> sides{};                         ///< hull
  std::vector<Vec3> vertices{};                           ///< hull, faces
  std::vector<std::array<std::uint32_t, 3>> triangles{};  ///< hull, faces
};

/// A box's triangles; corners by bits: 1 = +x, 2 = +y, 4 = +z.
inline constexpr std::array<std::array<std::uint32_t, 3>, 12> box_triangles{{{0, 4, 6},
                                                                             {0, 6, 2},
                                                                             {1, 3, 7},
                                                                             {1, 7, 5},
                                                                             {0, 1, 5},
                                                                             {0, 5, 4},
                                                                             {2, 6, 7},
                                                                             {2, 7, 3},
                                                                             {0, 2, 3},
                                                                             {0, 3, 1},
                                                                             {4, 5, 7},
                                                                             {4, 7, 6}}};

/// The shape is valid (core/shape.h). Throws what convex_hull() throws.
LocalShape make_local_shape(const Shape& shape);

/// Whether the open segment from + t * along, 0 < t < 1, meets the open interior or crosses a wall or face; both
/// vectors in local axes. `scratch` is overwritten.
bool blocks_segment(const LocalShape& shape, const Vec3& from, const Vec3& along, std::vector<double>& scratch);

/// The least t > after at which the line from + t * along enters an outline's interior; infinity where it does not.
double outline_entry(const LocalShape& shape, const Vec3& from, const Vec3& along, double after,
                     std::vector<double>& scratch);

}  // namespace gridcull
