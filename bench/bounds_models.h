// Models to measure bounding volumes on, after those of Bartz, Klosowski, Staneker 2005, section 5: parts as triangles
// in world axes, and a path around or through them. The same bits for the same seed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull::bench {

struct Part {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< outward, counter-clockwise
  bool convex = true;
};

struct Model {
  std::string name;
  std::vector<Part> parts;
  std::vector<View> views;
};

/// A round case of plates, two of them left out, full of parts in all directions up to its inside (the screw driver).
Model make_tool();
/// A box-shaped case full of parts along the axes (the boom box).
Model make_radio();
/// A street of houses with pitched roofs, turned anyhow, furniture to the walls within (the city).
Model make_houses();

/// The same model and path turned by 45 degrees about (1, 1, 1).
Model turned(const Model& model);

/// As objects of a scene: convex parts as `Convex`, others as `Faces`; all static. Parts of more than 64 triangles do
/// not occlude: each triangle would be an occluder of its own.
std::vector<Object> objects_of(const Model& model);

std::size_t triangles_of(const Model& model);

}  // namespace gridcull::bench
