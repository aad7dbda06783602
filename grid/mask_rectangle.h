// Rectangles of pixels about a shape's image on a face: what is asked first, because it costs least.
#pragma once

#include "gridcull/core/vec.h"
#include "gridcull/grid/mask_face.h"

namespace gridcull::masking {

/// A box in the face's axes (MaskFace::to_face), grown already by what it may be off: the rectangle of pixels that its
/// image may touch, from intervals. It errs outward only. False: touches none.
bool rectangle_about(const MaskFace& face, const Vec3& low, const Vec3& high, Rectangle& out);

/// A box in the world's axes on a face of the cube, likewise.
bool box_on_cube_face(const MaskFace& face, int index, const Vec3& low, const Vec3& high, Rectangle& out);

/// Whether a ball lies wholly beyond one of the face's sides; centre in the face's axes.
inline bool beyond_face(const MaskFace& face, const Vec3& c, double r) {
  const double x = c.x < 0.0 ? -c.x : c.x, y = c.y < 0.0 ? -c.y : c.y;
  return x - face.tangent_x * c.z > r * face.norm_x || y - face.tangent_y * c.z > r * face.norm_y;
}

}  // namespace gridcull::masking
