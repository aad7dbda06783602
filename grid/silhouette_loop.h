// The loop of edges between faces that see the viewpoint and faces that do not: H. Batagelo and S.-T. Wu, section 6
// (image-space fusion), needs no more of an occluder. For boxes the 27 loops are a table (D. Schmalstieg and
// R. F. Tobler, "Fast projected area computation for three-dimensional bounding boxes", 1999).
#pragma once

#include <array>
#include <cstdint>

#include "gridcull/grid/convex_piece.h"

namespace gridcull {

struct VertexLoop {
  std::array<std::uint8_t, ConvexPiece::max_vertices> vertex;
  int count = 0;        ///< 0: no face sees the viewpoint, or no single loop
  double height = 0.0;  ///< of the viewpoint over the highest face plane, metres; a lower bound of the distance
  double doubt = 0.0;   ///< least distance of the viewpoint from a face plane, metres: below rounding it says nothing
  int highest = 0;      ///< the face of `height`
};

/// `apex`: the viewpoint in local axes. Counter-clockwise seen from behind: dot(cross(a, b), d) > 0 inside.
void find_loop(const ConvexPiece& piece, const Vec3& apex, VertexLoop& out);

}  // namespace gridcull
