// A 2D ray caster that is too simple to be wrong: for one direction, who is seen? Used to judge the sweep.
#pragma once

#include <span>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull::test {

/// Ids (ascending) seen along one direction (unit, world axes). Containers of the viewer are reported in every
/// direction, and ties within 1e-9 m count as seen. An object that the viewer touches is seen in all directions if
/// `generous`, otherwise only in those that lead into it.
std::vector<ObjectId> seen_along(std::span<const Object> world, const View& view, const Vec2& direction, bool generous);

/// Random small 2D world, many of its coordinates on a lattice, so that walls abut, coincide and line up.
std::vector<Object> random_world_2d(std::uint64_t seed, int count);

/// A view into such a world: sometimes on a corner, on a wall or inside an object, sometimes with limits.
View random_view_2d(std::uint64_t seed, std::span<const Object> world);

}  // namespace gridcull::test
