// What a 2D viewer has around it: bodies made of walls, in coordinates relative to the viewer.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/exact_turn.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull::exact {

/// Metres below which two places count as one: relative to the magnitude of the numbers they come from.
inline constexpr double tie = 1e-12;
/// Rounding of a vertex or centre, relative likewise: a few units in the last place.
inline constexpr double rounding = 8e-16;

/// A straight wall or a disc's whole outline; the viewer is the origin.
struct Wall {
  Vec2 a;              ///< straight: the clockwise end; disc: the centre
  Vec2 along;          ///< straight: from a to the counter-clockwise end
  double radius;       ///< disc: metres; straight: 0
  double power;        ///< straight: cross2(a, along) >= 0; disc: |a|^2 - radius^2 >= 0
  double slack;        ///< what rounding may shift it, times its length (straight) or radius (disc)
  double nearest;      ///< least distance from the viewer
  Sector span;         ///< directions that meet it: less than half a turn (disc: at most half)
  std::uint32_t body;  ///< index of its body
};

enum class BodyKind { disc, solid, thin };

struct Body {
  ObjectId id;
  BodyKind kind;
  bool occluder;
  double nearest;  ///< least distance of its outline from the viewer
};

/// The walls that matter to one view. Riders and containers are gone, and so is what lies beyond the range
/// or outside the field of view.
struct Surroundings {
  std::vector<Wall> walls;
  std::vector<Body> bodies;
  std::vector<ObjectId> containers;  ///< objects whose open interior holds the viewer
  Sector sector;                     ///< the field of view
  double range;
  double magnitude;  ///< of the viewer's coordinates
};

/// Throws Error(bad_scene) for 3D shapes, Error(bad_frame) for a view out of range.
Surroundings look_around(std::span<const Object> world, const View& view);

}  // namespace gridcull::exact
