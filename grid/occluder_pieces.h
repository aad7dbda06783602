// What an object occludes with, and what it is tested with; built once per shape.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/core/shape.h"
#include "gridcull/grid/convex_piece.h"

namespace gridcull {

/// Convex pieces inside the closed shape (thin `faces`: flat pieces on its surface). They overlap. None for spheres
/// (grid/ball_sections.h) and 2D shapes.
struct OccluderPieces {
  std::vector<ConvexPiece> pieces;  ///< largest first

  std::uint64_t bytes() const;
};
OccluderPieces make_occluder_pieces(const Shape& shape);

/// A convex solid around the shape, pushed out (grid/outer_outline.h). None (no vertices) for spheres and 2D shapes.
ConvexPiece make_outer_hull(const Shape& shape);

}  // namespace gridcull
