// A small box around points, at any turn.
#pragma once

#include <span>

#include "gridcull/core/convex_boundary.h"
#include "gridcull/core/pose.h"

namespace gridcull {

struct OrientedBox {
  Vec3 centre{0.0};
  Rotation axes{};    ///< of length 1 and square to each other up to rounding; 2D: z stays
  Vec3 half{0.0};     ///< half its sizes along the axes; metres; 2D: z is 0
  double size = 0.0;  ///< greatest magnitude of a coordinate that went in
};

/// 3D, O(n): the local axes' box or the least of the frames of T. Larsson and L. Kaellberg, "Fast computation of
/// tight-fitting oriented bounding boxes" (2011), from the points farthest along the 13 directions of a 26-DOP. 2D:
/// the rectangle of least area, which has a side on the hull (H. Freeman and R. Shapira 1975). Not empty. `half` holds
/// the points up to less than 2^-46 of the coordinates.
OrientedBox oriented_box_around(std::span<const Vec3> points, int dimension);

/// The box with these axes.
OrientedBox box_along(std::span<const Vec3> points, const Rotation& axes);

/// Its corners and faces, every side moved out by `grown`: for 2^-40 of the coordinates and more the hull of the stored
/// corners contains every point within grown - 2^-44 size of the points. Overwrites `out`.
void oriented_boundary(const OrientedBox& box, double grown, int dimension, ConvexBoundary& out);

}  // namespace gridcull
