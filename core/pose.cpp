#include "gridcull/core/pose.h"

#include <cmath>

#include "gridcull/core/error.h"
#include "gridcull/core/trigonometry.h"

namespace gridcull {

Quat turn_about_z(double heading) {
  const SinCos half = stable_sincos(0.5 * heading);
  return {half.cos, 0.0, 0.0, half.sin};
}

double heading_of(const Quat& q) {
  const Vec3 x = rotation_of(q).x;
  return std::atan2(x.y, x.x);
}

Quat normalised(const Quat& q) {
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  if (!std::isfinite(length) || length < 1e-9) {
    throw Error(ErrorCode::bad_scene, "orientation: expected a quaternion [w, x, y, z] of length 1");
  }
  // Already unit to the last bits: leave it alone, so that a written scene reads back with the same bits.
  if (std::fabs(length - 1.0) < 4e-16) return q;
  return {q.w / length, q.x / length, q.y / length, q.z / length};
}

Quat operator*(const Quat& a, const Quat& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Rotation rotation_of(const Quat& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  Rotation r;
  r.x = {1.0 - 2.0 * (yy + zz), 2.0 * (xy + wz), 2.0 * (xz - wy)};
  r.y = {2.0 * (xy - wz), 1.0 - 2.0 * (xx + zz), 2.0 * (yz + wx)};
  r.z = {2.0 * (xz + wy), 2.0 * (yz - wx), 1.0 - 2.0 * (xx + yy)};
  return r;
}

Vec3 to_world(const Pose& pose, const Rotation& rotation, const Vec3& local) {
  return pose.position + rotation * local;
}

Pose compose(const Pose& base, const Pose& local) {
  return {to_world(base, rotation_of(base.orientation), local.position), base.orientation * local.orientation};
}

}  // namespace gridcull
