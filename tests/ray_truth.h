// Where a ray meets a placed 3D shape, in long doubles and straight from the definitions: the judge of the tests of
// occluder pieces. Shares no code with the library but the shapes and to_world().
#pragma once

#include <optional>
#include <vector>

#include "gridcull/core/object.h"

namespace gridcull::test {

struct Long3 {
  long double x, y, z;
};
inline Long3 operator+(const Long3& a, const Long3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Long3 operator-(const Long3& a, const Long3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Long3 operator*(long double s, const Long3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline long double dot(const Long3& a, const Long3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Long3 cross(const Long3& a, const Long3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Long3 longer(const Vec3& v) { return {v.x, v.y, v.z}; }
long double length(const Long3& v);

/// A shape where it stands, seen from a viewpoint.
class RayTruth {
 public:
  RayTruth(const Shape& shape, const Pose& pose, const Vec3& eye);

  /// Distance at which the ray first has the shape's interior just behind it (thin: crosses a face).
  std::optional<long double> entrance(const Long3& direction) const;

  /// Whether the ray lies in a prism's wall but for rounding: then entrance() says nothing.
  bool runs_along_a_wall(const Long3& direction) const;

  /// Whether the open interior holds the viewpoint.
  bool holds_eye() const;

 private:
  struct Plane {
    Long3 normal;
    long double offset;  ///< inside: dot(normal, p) < offset
  };
  struct Stretch {
    long double begin, end;
  };
  Long3 local(const Long3& direction) const;
  std::vector<Stretch> stretches(const Long3& direction) const;
  std::vector<Stretch> prism_stretches(const Long3& direction) const;
  std::optional<long double> faces_entrance(const Long3& direction) const;

  const Shape* shape_;
  Long3 eye_;                    ///< local axes; Faces: world
  std::array<Long3, 3> axes_;    ///< world directions to local ones
  std::vector<Plane> planes_;    ///< Cuboid, Convex
  std::vector<Vec3> triangles_;  ///< Faces: world vertices
};

}  // namespace gridcull::test
