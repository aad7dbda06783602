// A viewing cell and the six ways to look out of it (F. Durand, G. Drettakis, J. Thollot, C. Puech, "Conservative
// Visibility Preprocessing using Extended Projections", SIGGRAPH 2000, sections 2.4 and 6.1).
#pragma once

#include <array>
#include <cmath>

#include "gridcull/core/bounds.h"
#include "gridcull/core/pose.h"

namespace gridcull::extended {

/// A closed box of viewpoints, oriented so that it fits a street.
struct ViewCell {
  Vec3 centre{0.0};
  Rotation axes{};
  Vec3 half{0.0};  ///< along its axes, metres, > 0
};

inline Vec3 into_cell(const ViewCell& cell, const Vec3& world) { return cell.axes.inverse(world - cell.centre); }

inline bool holds(const ViewCell& cell, const Vec3& world) {
  const Vec3 p = into_cell(cell, world);
  return std::fabs(p.x) <= cell.half.x && std::fabs(p.y) <= cell.half.y && std::fabs(p.z) <= cell.half.z;
}

/// Half the reach of a cell along a direction of any length.
inline double reach_along(const ViewCell& cell, const Vec3& n) {
  return std::fabs(glm::dot(n, cell.axes.x)) * cell.half.x + std::fabs(glm::dot(n, cell.axes.y)) * cell.half.y +
         std::fabs(glm::dot(n, cell.axes.z)) * cell.half.z;
}

/// Box in the cell's axes about its centre of a box in the world's.
inline Bounds into_cell(const ViewCell& cell, const Bounds& world) {
  const Vec3 middle = into_cell(cell, world.centre()), h = 0.5 * world.size();
  const Rotation& a = cell.axes;
  const auto reach = [&h](const Vec3& n) { return std::fabs(n.x) * h.x + std::fabs(n.y) * h.y + std::fabs(n.z) * h.z; };
  const Vec3 half{reach(a.x), reach(a.y), reach(a.z)};
  return {middle - half, middle + half};
}

/// One of six: out of the cell's side `sign` of `axis`. In a facing's axes z (written w) leaves the cell, x and y
/// (u, v) run along the projection plane; the turn permutes and negates coordinates, so it rounds nothing.
struct Facing {
  int axis = 0;
  double sign = 1.0;

  Vec3 operator()(const Vec3& p) const { return {p[(axis + 1) % 3], p[(axis + 2) % 3], sign * p[axis]}; }
  Bounds operator()(const Bounds& b) const {
    Bounds out{(*this)(b.min), (*this)(b.max)};
    if (sign < 0.0) std::swap(out.min.z, out.max.z);
    return out;
  }
  Vec3 half(const ViewCell& cell) const {
    return {cell.half[(axis + 1) % 3], cell.half[(axis + 2) % 3], cell.half[axis]};
  }
};

inline constexpr std::array<Facing, 6> facings{{{0, 1.0}, {0, -1.0}, {1, 1.0}, {1, -1.0}, {2, 1.0}, {2, -1.0}}};

}  // namespace gridcull::extended
