// Random 3D shapes, poses and viewpoints for the tests of occluder pieces: aligned and turned, thin and huge,
// viewpoints on face planes, on edges' lines, close by and far away.
#pragma once

#include <random>

#include "gridcull/core/object.h"

namespace gridcull::test {

struct Placement {
  Shape shape;
  Pose pose;
  Vec3 eye;
};

/// No Sphere. The same for the same seed.
Placement random_placement(std::uint64_t seed);

/// An outline: convex, concave, star-shaped, self-crossing, with repeated and collinear points or a courtyard.
std::vector<Vec2> random_outline(std::mt19937_64& random);

}  // namespace gridcull::test
