// Closed meshes of many kinds, by seed.
#pragma once

#include <random>

#include "gridcull/core/shape.h"

namespace gridcull::test {

/// A lumpy ball, a ring, a hollow box, or a heap of unit cubes (with edges that four triangles share); within `reach`
/// of the origin. Triangles turn the same way about each shell.
Faces random_mesh(std::mt19937_64& random, double reach);

}  // namespace gridcull::test
