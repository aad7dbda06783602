// The outer cone of an object or of a depth slice of it, for tests against the coverage mask.
#pragma once

#include "gridcull/grid/piece_silhouette.h"

namespace gridcull {

/// The object's outer hull (make_outer_hull) as a loop of rays whose convex cone holds every point of the object;
/// no point is nearer than `nearest`. False where no such cone can be given (the viewpoint in the hull, too near it,
/// or a hull that is not there): the object then counts as visible.
bool outer_outline(const PlacedPiece& hull, Outline& out);

/// What outer_slice() answers.
enum class Slice { empty, outline, unknown };

/// The same for the points of the hull's front faces at distances from `near` to `far` (metres, closed). Before every
/// point of the object stands such a front point on the same ray, at one of outer_outline()'s nearest .. farthest: when
/// slices cover that range, and each is hidden by what is nearer than its `near`, the object is hidden. `unknown`:
/// counts as visible.
Slice outer_slice(const PlacedPiece& hull, double near, double far, Outline& out);

}  // namespace gridcull
