// A bounding volume of core/ as the convex solid that the method `silhouette` tests an object with.
#pragma once

#include "gridcull/core/bounding_volume.h"
#include "gridcull/grid/convex_piece.h"

namespace gridcull {

/// The shape's volume of that kind, pushed out as every tested hull (convex_piece.h); thin ones are made a little
/// thicker. A `hull` with more than 32 corners (prisms: more than 32 in the outline) is its 26-DOP instead. No
/// vertices for what is round: kind sphere, or a ball's hull.
ConvexPiece bound_piece(const Shape& shape, BoundKind kind);

}  // namespace gridcull
