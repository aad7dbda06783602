// Where people can walk on a floor plan, by Recast: a navigation mesh for Detour.
#pragma once

#include <memory>

#include <recastnavigation/DetourNavMesh.h>

#include "floor_plan.h"

struct NavMeshDeleter {
  void operator()(dtNavMesh* mesh) const { dtFreeNavMesh(mesh); }
};
using NavMesh = std::unique_ptr<dtNavMesh, NavMeshDeleter>;

/// Recast's y is up: a point (x, y) of the plan is (x, 0, y) there. `radius` is a person's, metres. Throws
/// std::runtime_error when there is nowhere to walk.
NavMesh make_nav_mesh(const FloorPlan& plan, float radius);
