// Balls on a face of the coverage mask.
#pragma once

#include "gridcull/grid/mask_face.h"

namespace gridcull::masking {

/// Where the cone of directions to a ball lies; centre in the face's axes (MaskFace::to_face), |centre| > radius.
enum class BallPlace {
  outside,  ///< beyond one of the face's sides
  ellipse,  ///< well before the face: the outline is an ellipse
  crossing  ///< reaches beside the viewpoint, where the outline is a hyperbola or nearly one
};
BallPlace place_ball(const MaskFace& face, const Vec3& centre, double radius, Ellipse& out);

inline constexpr int cone_rays = 32;
/// `cone_rays` rays round the circular cone of a ball: on it (within), or a little outside so that the cone they
/// span holds it (around). World axes.
void rays_within(const Vec3& centre, double radius, Vec3* out);
void rays_around(const Vec3& centre, double radius, Vec3* out);

}  // namespace gridcull::masking
