// Flat faces of static objects that lie in one plane and abut or overlap, merged into larger convex polygons: 400 tiles
// in a row leak through every seam of a mask of pixels, one rectangle does not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/grid/convex_piece.h"

namespace gridcull {

/// A static occluder where it stands.
struct PlacedSource {
  ObjectId owner;
  const Shape* shape;
  Pose pose;
};

/// A flat occluder in world coordinates (its frame: sight_frame(Pose{}, Rotation{}, viewpoint)). Whoever crosses it
/// enters, leaves or crosses one of the owners, so a viewer must skip it when it leaves out any of them (rides on it,
/// or is inside it).
struct MergedFace {
  ConvexPiece piece;
  std::vector<ObjectId> owners;  ///< ascending, at least two

  std::uint64_t bytes() const;
};

/// Faces of boxes, walls of prisms, faces of hulls, triangles. Their union lies in the union of the sources' faces,
/// exactly. The same answer for the same list, largest face first.
std::vector<MergedFace> merge_static_faces(std::span<const PlacedSource> sources);

}  // namespace gridcull
