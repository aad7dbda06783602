#include "gridcull/core/convex_boundary.h"

namespace gridcull {

Vec3 area_normal(const ConvexBoundary& boundary, const ConvexBoundary::Face& face) {
  const auto at = [&](std::uint32_t i) -> const Vec3& { return boundary.vertices[boundary.loops[face.first + i]]; };
  Vec3 sum(0.0);
  for (std::uint32_t i = 1; i + 1 < face.count; ++i) sum += glm::cross(at(i) - at(0), at(i + 1) - at(0));
  return sum;
}

double area_of(const ConvexBoundary& boundary) {
  double sum = 0.0;
  for (const auto& face : boundary.faces) sum += 0.5 * glm::length(area_normal(boundary, face));
  return sum;
}

double volume_of(const ConvexBoundary& boundary) {
  double sum = 0.0;
  for (const auto& face : boundary.faces) {
    const Vec3 foot = boundary.vertices[boundary.loops[face.first]] - boundary.vertices[0];
    sum += glm::dot(area_normal(boundary, face), foot) / 6.0;
  }
  return sum;
}

double length_of(const ConvexBoundary& boundary, const ConvexBoundary::Face& face) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < face.count; ++i) {
    const std::uint32_t next = i + 1 == face.count ? 0 : i + 1;
    sum += glm::length(boundary.vertices[boundary.loops[face.first + next]] -
                       boundary.vertices[boundary.loops[face.first + i]]);
  }
  return sum;
}

}  // namespace gridcull
