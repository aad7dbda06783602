// The silhouette of a convex piece seen from a viewpoint, for the coverage mask.
#pragma once

#include <array>
#include <cstdint>

#include "gridcull/core/pose.h"
#include "gridcull/grid/convex_piece.h"
#include "gridcull/grid/silhouette_loop.h"

namespace gridcull {

/// Where a viewpoint and an object stand to each other; made once for each pair, serves all pieces of the object.
struct SightFrame {
  Rotation rotation;  ///< of the object
  Vec3 origin;        ///< the object's position relative to the viewpoint, world axes
  Vec3 apex;          ///< the viewpoint in the object's axes
  double blur;        ///< sight_blur() for what does not grow with the shape, metres
};
SightFrame sight_frame(const Pose& pose, const Rotation& rotation, const Vec3& viewpoint);

struct PlacedPiece {
  const ConvexPiece& piece;
  const SightFrame& frame;
};

/// A closed loop of directions from the viewpoint (world axes, not normalised; each is a point of the piece relative
/// to the viewpoint). dot(cross(rays[i], rays[i + 1]), d) > 0 for directions d inside.
struct Outline {
  static constexpr int max_rays = 64;
  std::array<Vec3, max_rays> rays;
  int count = 0;
  double nearest = 0.0;   ///< occluders: about the piece's distance; occludees: no point is nearer; metres
  double farthest = 0.0;  ///< no ray is longer; metres
};

/// The occluder's outline: every ray strictly inside meets the piece's interior (flat: crosses it) no later than at
/// `farthest`, the key at which it may enter the mask. False when the piece cannot be used from there.
bool silhouette(const PlacedPiece& placed, Outline& out);
/// The same, which leaves the loop too.
bool silhouette(const PlacedPiece& placed, Outline& out, VertexLoop& loop);

}  // namespace gridcull
