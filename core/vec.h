// Vectors: GLM's, in doubles. Metres unless said otherwise; right-handed; +z up.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace gridcull {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

/// z component of the cross product: > 0 where b lies counter-clockwise of a.
inline double cross2(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace gridcull
