// Claim. The extended projection of what lies in the projection plane is itself: a ray through such a point meets it
// there, from wherever it comes. A pixel inside the solid is therefore covered, at the plane's own depth.
//
// The paper intersects the faces with the plane and scan-converts the contour. We ask the other way round, since a face
// all but parallel to the plane has no well-defined contour: a pixel is a flat quadrilateral, and it lies in the prism
// when, in the prism's axes, its four corners lie between base and top and its ground plan keeps clear of every edge of
// the outline and has a corner inside (even-odd rule). Clear: all four corners lie on one side of the edge's line, or
// their box and the edge's do not meet; either by more than `error` and the roundings of these lines.
#include "gridcull/methods/extended_slice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gridcull/methods/even_odd.h"

namespace gridcull::extended {
namespace {

using Quad = std::array<Vec2, 4>;

bool clear_of(const Quad& quad, const Vec2& a, const Vec2& b, double margin) {
  for (int k = 0; k < 2; ++k) {
    const auto [low, high] = std::minmax({quad[0][k], quad[1][k], quad[2][k], quad[3][k]});
    if (low > std::max(a[k], b[k]) + margin || high < std::min(a[k], b[k]) - margin) return true;
  }
  const Vec2 along = b - a;
  const double least = margin * glm::length(along);
  int left = 0, right = 0;
  for (const Vec2& p : quad) {
    const double side = cross2(along, p - a);
    left += side > least;
    right += side < -least;
  }
  return left == 4 || right == 4;
}

bool holds_quad(const ConcavePrism& prism, const std::array<Vec3, 4>& corners, double margin) {
  Quad quad;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(corners[i].z > margin && corners[i].z < prism.height - margin)) return false;
    quad[i] = Vec2(corners[i]);
  }
  const std::vector<Vec2>& o = prism.outline;
  for (std::size_t i = 0, j = o.size() - 1; i < o.size(); j = i++) {
    if (!clear_of(quad, o[j], o[i], margin)) return false;
  }
  return even_odd(o, quad[0]);
}

/// A point of the plane, from a facing's axes to the cell's.
Vec3 turned_back(const Facing& facing, const Vec3& p) {
  Vec3 out;
  out[(facing.axis + 1) % 3] = p.x;
  out[(facing.axis + 2) % 3] = p.y;
  out[facing.axis] = facing.sign * p.z;
  return out;
}

/// Rows or columns of the map that the span may touch.
std::array<int, 2> pixels_of(double low, double high, double extent, double pixel, int resolution) {
  const double first = std::floor((low + extent) / pixel) - 1.0, last = std::floor((high + extent) / pixel) + 1.0;
  return {static_cast<int>(std::clamp(first, 0.0, resolution + 0.0)),
          static_cast<int>(std::clamp(last, -1.0, resolution - 1.0))};
}

}  // namespace

bool cover_slice(const ViewCell& cell, const Facing& facing, const Plane& plane, const ConcavePrism& prism,
                 double error, DepthMap& map) {
  Bounds box;  // in the facing's axes
  for (const double z : {0.0, prism.height}) {
    for (const Vec2& p : prism.outline) {
      box.add(facing(into_cell(cell, prism.position + prism.turn * Vec3(p, z))));
    }
  }
  if (!(box.min.z < plane.distance && plane.distance < box.max.z)) return false;
  double reach = prism.height;
  for (const Vec2& p : prism.outline) reach = std::max(reach, std::fabs(p.x) + std::fabs(p.y));
  const double margin = error + 1e-13 * (reach + plane.extent.x + plane.extent.y + plane.distance);
  const Vec2 pixel = plane.pixel();
  const auto columns = pixels_of(box.min.x, box.max.x, plane.extent.x, pixel.x, plane.resolution);
  const auto rows = pixels_of(box.min.y, box.max.y, plane.extent.y, pixel.y, plane.resolution);
  const auto into_prism = [&](int column, int row) {
    const Vec3 at{column * pixel.x - plane.extent.x, row * pixel.y - plane.extent.y, plane.distance};
    return prism.turn.inverse(cell.centre - prism.position + cell.axes * turned_back(facing, at));
  };
  const float depth =
      std::nextafter(static_cast<float>(plane.distance + margin), std::numeric_limits<float>::infinity());
  bool any = false;
  for (int y = rows[0]; y <= rows[1]; ++y) {
    std::array<Vec3, 4> corners{into_prism(columns[0], y), into_prism(columns[0], y + 1), {}, {}};
    for (int x = columns[0]; x <= columns[1]; ++x) {
      corners[2] = into_prism(x + 1, y);
      corners[3] = into_prism(x + 1, y + 1);
      // What the prism's convex pieces cover needs no second look: what is left are the seams between them.
      if (map.at(x, y) > depth && holds_quad(prism, corners, margin)) {
        map.cover(y, x, x, depth);
        any = true;
      }
      corners[0] = corners[2];
      corners[1] = corners[3];
    }
  }
  return any;
}

}  // namespace gridcull::extended
