// Bounding volumes of any shape or set of points: D. Bartz, J. T. Klosowski, D. Staneker, "k-DOPs as tighter bounding
// volumes for better occlusion performance", 2005, section 3. Built once in local axes, placed with the object; or
// fitted anew in world axes from the old boundary.
//
// Contract. What a volume was made of lies in it; what is placed at a pose contains the world points of the shape
// (to_world(), core/shape.h's truth), and so their hull, at that pose: rounding included.
#pragma once

#include <span>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/bounding_ball.h"
#include "gridcull/core/convex_boundary.h"
#include "gridcull/core/oriented_box.h"
#include "gridcull/core/pose.h"
#include "gridcull/core/shape.h"
#include "gridcull/core/slabs.h"

namespace gridcull {

struct BoundingVolume {
  BoundKind kind = BoundKind::box;
  int dimension = 3;
  bool round = false;         ///< the ball (2D: disc) is the volume; else the boundary is
  Ball ball{};                ///< where round
  ConvexBoundary boundary{};  ///< else; always with faces, flat shapes' too
  double grown = 0.0;         ///< metres by which the planes were moved out against rounding, about 2^-30 of the size
  double size = 0.0;          ///< greatest sum of a point's coordinates' magnitudes, or more
  // What the boundary was made of, where it is made again with more growth.
  Slabs slabs{};          ///< box and k-DOPs
  OrientedBox obb{};      ///< obb
  ConvexBoundary bare{};  ///< hull, its vertices the given points themselves (re-fitted: the old boundary's)
  Ball inner{};           ///< lies in it; radius 0 where it is nearly flat
};

/// In the shape's local axes. The shape is valid (core/shape.h).
BoundingVolume bound_of(const Shape& shape, BoundKind kind);
/// Of points of magnitude at most 1e12; not empty. 2D: z = 0.
BoundingVolume bound_of(std::span<const Vec3> points, BoundKind kind, int dimension = 3);

/// The volume's boundary with all planes moved out by `metres` more (a hull's at least that far); of a ball none.
ConvexBoundary grown_boundary(const BoundingVolume& bound, double metres);

/// A volume that moves with its object: the ball, or the boundary with the faces that it had.
struct PlacedBound {
  bool round = false;
  Ball ball{};
  ConvexBoundary boundary{};
};
/// Into world axes. Allocates nothing for an `out` that held as large a one before, unless the coordinates of the pose
/// are some 2^14 times the object's size.
void place(const BoundingVolume& bound, const Pose& pose, PlacedBound& out);

/// Rigid motion, re-fitted: box and k-DOPs have world axes again and hold the vertices of the old boundary (a few
/// dozens, whatever the shape); the others turn with the object. Fit from the shape's own volume, not from a re-fitted
/// one, which grows at every step.
BoundingVolume refit(const BoundingVolume& bound, const Pose& pose);

/// Cubic metres; 2D: square metres.
double volume_of(const BoundingVolume& bound);
/// Square metres; 2D: metres around.
double surface_of(const BoundingVolume& bound);

}  // namespace gridcull
