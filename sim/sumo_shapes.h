// SUMO's vehicles and polygons as ours: what the importer and a live simulation (examples/sumo) share.
//
// SUMO gives the middle of a vehicle's front bumper and its angle in degrees clockwise from north (+y);
// a box of ours has its centre half a length behind.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gridcull/sim/scene.h"

namespace gridcull {

/// Heading in radians, counter-clockwise from +x, -pi < heading <= pi, for an angle of SUMO's (0 .. 360 degrees).
double sumo_heading(double angle);

/// The middle of a vehicle of this length (metres) whose front bumper's middle is at `front`.
Vec3 vehicle_middle(const Vec3& front, double heading, double length);

/// SUMO calls these types buildings: "building", "building.yes", ...
bool is_sumo_building(std::string_view type);

/// A static object, without an id, for a polygon of SUMO's in metres; nothing for fewer than three distinct points.
std::optional<SceneObject> sumo_building(const std::vector<Vec2>& outline, const std::string& name);

/// Distinct points among these.
std::size_t distinct_points(std::vector<Vec2> points);

}  // namespace gridcull
