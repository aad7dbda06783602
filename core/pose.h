// Where an object or viewer stands and how it is turned.
#pragma once

#include "gridcull/core/vec.h"

namespace gridcull {

/// Unit quaternion, the rotation from local to world axes.
struct Quat {
  double w = 1, x = 0, y = 0, z = 0;
};

/// Position (metres; z = 0 in 2D) and orientation (in 2D a turn about +z).
struct Pose {
  Vec3 position{0.0, 0.0, 0.0};
  Quat orientation{};
};

/// Rotation matrix by columns: the images of the local x, y and z axis.
struct Rotation {
  Vec3 x{1.0, 0.0, 0.0};
  Vec3 y{0.0, 1.0, 0.0};
  Vec3 z{0.0, 0.0, 1.0};

  Vec3 operator*(const Vec3& v) const {
    return {x.x * v.x + y.x * v.y + z.x * v.z, x.y * v.x + y.y * v.y + z.y * v.z, x.z * v.x + y.z * v.y + z.z * v.z};
  }
  /// World direction into local axes (the transpose).
  Vec3 inverse(const Vec3& v) const { return {glm::dot(x, v), glm::dot(y, v), glm::dot(z, v)}; }
};

/// Turn of `heading` radians about +z, counter-clockwise from +x; exact at 0.
Quat turn_about_z(double heading);

/// Heading (radians, -pi .. pi) of the local x axis in the ground plan.
double heading_of(const Quat& q);

/// Scales to unit length. Throws Error(bad_scene) when a part is not finite or the length is below 1e-9.
Quat normalised(const Quat& q);

/// a then nothing: the product a*b turns by b first, then by a.
Quat operator*(const Quat& a, const Quat& b);

/// Columns of the rotation; a turn about z leaves z coordinates bit for bit alone.
Rotation rotation_of(const Quat& q);

/// The one place that takes a local point into the world. Everybody (methods and reference alike)
/// speaks about these rounded points: they are the truth.
Vec3 to_world(const Pose& pose, const Rotation& rotation, const Vec3& local);

/// Pose of something mounted at `local` on `base`.
Pose compose(const Pose& base, const Pose& local);

}  // namespace gridcull
