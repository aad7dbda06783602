// 3D objects for the reference, in doubles: where a ray's line runs inside them.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/half_space.h"
#include "gridcull/core/object.h"

namespace gridcull::exact {

/// A piece of a ray's line inside a solid, or one crossing of a thin face (begin == end). Metres along the ray
/// (unit direction) from the eye; negative behind it.
struct Stretch {
  double begin, end;
};

enum class SolidKind { sphere, convex, prism, faces, volume };

class RayVolume;

/// One object, prepared.
struct Solid {
  ObjectId id;
  SolidKind kind;
  bool occluder;
  bool closed = false;  ///< faces: they close, and have an interior
  Vec3 position;
  Rotation rotation;
  double reach;   ///< ball about position that holds it
  double radius;  ///< sphere
  Bounds box;     ///< local axes; not for spheres
  Bounds world_box;
  std::vector<HalfSpace> sides;                         ///< convex, local axes
  std::vector<Vec2> outline;                            ///< prism, local axes; from z = 0 to box.max.z
  std::vector<Vec3> vertices;                           ///< world; not for spheres; volume: points inside
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< over vertices: convex and faces
  std::shared_ptr<const RayVolume> field{};             ///< volume
};

/// Throws Error(bad_scene) for 2D shapes.
std::vector<Solid> make_solids(std::span<const Object> world);

/// Appends the stretches of the ray's line, ascending for one solid.
void add_stretches(const Solid& solid, const Vec3& eye, const Vec3& ray, std::vector<Stretch>& out);

/// Whether the point is farther inside than rounding could put it. Objects that hold the eye by less than that
/// neither hide nor need to be seen by a method that says otherwise.
bool surely_holds(const Solid& solid, const Vec3& point);

/// Distance from a point to the solid's surface, or (not for spheres) to its local box if that is less;
/// infinity for faces.
double rough_distance(const Solid& solid, const Vec3& point);

}  // namespace gridcull::exact
