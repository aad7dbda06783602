// What a horizontal plane shows of an object: its outline in the picture.
#pragma once

#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull {

/// A disc, or polygons and chains; empty when the plane misses the object.
struct Slice {
  double radius = 0.0;  ///< > 0: a disc about `centre`
  Vec2 centre{0.0};
  std::vector<std::vector<Vec2>> rings{};   ///< closed outlines
  std::vector<std::vector<Vec2>> chains{};  ///< open ones: thin shapes

  bool empty() const { return radius <= 0.0 && rings.empty() && chains.empty(); }
};

/// 2D: the object itself. 3D: its cut at height `z` (metres); of boxes, prisms and hulls the cut of their
/// convex hull, unless an upright prism gives its outline.
Slice slice_of(const Object& object, double z);

/// The view volume's cut by the plane through the viewpoint, clipped to `reach` metres: a closed outline,
/// empty when the volume does not meet the plane. `all_round` views give a circle of 180 corners.
std::vector<Vec2> view_outline(const View& view, int dimension, double reach);

}  // namespace gridcull
