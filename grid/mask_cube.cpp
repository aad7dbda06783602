#include "gridcull/grid/mask_cube.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace gridcull::masking {
namespace {

/// Faces whose depth, at most, is above 0 and which no side leaves: |.| of the other two coordinates, at least, is at
/// most that depth. `deepest`: greatest depth along +x, -x, +y ...; `least`: of magnitudes along x, y, z.
unsigned reached(const double (&deepest)[6], const Vec3& least) {
  const double beside[3] = {std::max(least.y, least.z), std::max(least.x, least.z), std::max(least.x, least.y)};
  unsigned near = 0;
  for (int face = 0; face < 6; ++face) {
    near |= static_cast<unsigned>((deepest[face] > 0.0) & (beside[face / 2] <= deepest[face])) << face;
  }
  return near;
}

/// The least magnitude in [low, high], or below 0.
double least_in(double low, double high) { return std::max(low, -high); }

}  // namespace

unsigned cube_faces_near_box(const Vec3& low, const Vec3& high) {
  return reached({high.x, -low.x, high.y, -low.y, high.z, -low.z},
                 {least_in(low.x, high.x), least_in(low.y, high.y), least_in(low.z, high.z)});
}

unsigned cube_faces_near(const Vec3* rays, int count) {
  Vec3 low = rays[0], high = rays[0];
  for (int k = 1; k < count; ++k) low = glm::min(low, rays[k]), high = glm::max(high, rays[k]);
  return cube_faces_near_rays(&low.x, &high.x);
}

unsigned cube_faces_near_rays(const double* low, const double* high) {
  double slack = 0.0;
  for (int k = 0; k < 3; ++k) slack = std::max({slack, -low[k], high[k]});
  slack *= 0x1p-38;
  return cube_faces_near_box(Vec3(low[0], low[1], low[2]) - slack, Vec3(high[0], high[1], high[2]) + slack);
}

unsigned cube_faces_near_ball(const Vec3& c, double reach) {
  const double x = std::fabs(c.x), y = std::fabs(c.y), z = std::fabs(c.z);
  const double yz = std::max(y, z), xz = std::max(x, z), xy = std::max(x, y);
  const double beside[6] = {yz - c.x, yz + c.x, xz - c.y, xz + c.y, xy - c.z, xy + c.z};
  unsigned near = 0;
  for (int face = 0; face < 6; ++face) near |= static_cast<unsigned>(beside[face] <= reach) << face;
  return near;
}

int cube_face_of(const Vec3& d) {
  const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  return 2 * axis + (d[axis] < 0.0);
}

}  // namespace gridcull::masking
