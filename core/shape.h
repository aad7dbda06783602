// The shapes of objects, in local coordinates (metres), as FORMATS names them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string_view>
#include <variant>
#include <vector>

#include "gridcull/core/pose.h"
#include "gridcull/core/vec.h"

namespace gridcull {

// 2D, closed unless said otherwise.

struct Disc {
  double radius;  ///< > 0
};
/// Centred on the origin, length along the heading.
struct Rectangle {
  Vec2 size;  ///< length, width; > 0
};
/// Closed outline, either turn, concave or self-crossing (even-odd rule). At least three distinct points.
/// Without area it has no interior and hides nothing.
struct Polygon {
  std::vector<Vec2> vertices;
};
/// Open chain of walls without thickness: no interior, but crossing a wall blocks. At least two points.
struct Polyline {
  std::vector<Vec2> vertices;
};

// 3D.

struct Sphere {
  double radius;  ///< > 0
};
/// Centred on the origin.
struct Cuboid {
  Vec3 size;  ///< > 0
};
/// Polygon (as in 2D) swept from z = 0 to z = height.
struct Prism {
  std::vector<Vec2> vertices;
  double height;  ///< > 0
};
/// Convex hull of its points; at least four, not all in one plane.
struct Convex {
  std::vector<Vec3> vertices;
};
/// Triangles: crossing one blocks. As they are they have no thickness and no interior. When `closed` they are a mesh
/// without a hole (core/mesh.h): what is within it by the even-odd rule is its interior, and who is there sees past it.
struct Faces {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool closed = false;
};

class ScalarField;
struct VolumeBody;

/// What a field of floats (core/scalar_field.h) is less than, or greater than, a value in: its interior is where the
/// trilinear interpolant is, strictly. Made by make_volume() (core/volume.h).
struct Volume {
  std::shared_ptr<const ScalarField> field;
  double iso;                              ///< the value
  bool inside_below;                       ///< the interior is where the field is less; else where it is greater
  std::shared_ptr<const VolumeBody> body;  ///< what follows from these: solid boxes within it, corners about it
};

using Shape = std::variant<Disc, Rectangle, Polygon, Polyline, Sphere, Cuboid, Prism, Convex, Faces, Volume>;

/// 2 or 3.
int dimension_of(const Shape& shape);

/// The name FORMATS gives it: "disc", "box", "polygon", ...; "mesh" for closed faces; "volume".
std::string_view name_of(const Shape& shape);

/// Whether it is a thin shape (`Polyline`, `Faces` that are not closed): blocks on crossing, holds no cell.
bool is_thin(const Shape& shape);

/// Greatest distance of a point of the shape from its origin: at any orientation the object stays
/// inside the ball of this radius about its position (rounded up).
double reach_of(const Shape& shape);

/// Throws Error(bad_scene) with one line when a size is not positive or not finite, a magnitude is
/// above 1e9, a polygon has fewer than three distinct points, a hull is flat, or an index is out of range.
void validate(const Shape& shape);

/// The points of an outline with repeated neighbours (and a repeated closing point) merged.
std::vector<Vec2> merged_outline(const std::vector<Vec2>& vertices);

/// World vertices of a 2D shape's outline or chain: Rectangle (4, counter-clockwise), Polygon (merged),
/// Polyline. Empty for a Disc. Every consumer uses these rounded points.
std::vector<Vec2> world_outline(const Shape& shape, const Pose& pose);

/// World vertices of a 3D shape: Cuboid (8: bit 0 = +x, bit 1 = +y, bit 2 = +z), Prism (outline at the
/// bottom, then at the top), Convex and Faces (as given), Volume (corners of a polyhedron about it, some fifty at
/// most). Empty for a Sphere.
std::vector<Vec3> world_vertices(const Shape& shape, const Pose& pose);

}  // namespace gridcull
