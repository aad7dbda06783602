// The cube of six faces that a view all round has: which of them a shape may reach, told by comparisons only.
#pragma once

#include "gridcull/core/vec.h"

namespace gridcull::masking {

/// The faces (bit k: set_cube_face(k)) that rays may reach: one is left out when all rays lie behind it or beyond one
/// of its sides even with their errors, so that the cone they span does.
unsigned cube_faces_near(const Vec3* rays, int count);
/// The same, told the bounds of the rays: three coordinates each.
unsigned cube_faces_near_rays(const double* low, const double* high);

/// The same for a ball; `reach`: its radius times MaskFace::norm_x. These are the comparisons of place_ball().
unsigned cube_faces_near_ball(const Vec3& centre, double reach);

/// The same for an axis-aligned box that is not around the viewpoint, grown already by what it may be off.
unsigned cube_faces_near_box(const Vec3& low, const Vec3& high);

/// A face that the direction falls on, by its largest coordinate.
int cube_face_of(const Vec3& direction);

}  // namespace gridcull::masking
