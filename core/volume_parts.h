// The parts of a volume's body; internal to core/volume*.cpp.
#pragma once

#include <vector>

#include "gridcull/core/volume.h"

namespace gridcull {

/// What rounding may do to a place in or about the box on its way to the object's local axes, and 16 times more; in
/// steps of the lattice.
double rounding_in_lattice(const ScalarField& field, const LatticeBox& box);

/// Corners of a polyhedron of at most 26 faces about the volume, whose body has points; local axes, metres.
std::vector<Vec3> corners_about(const Volume& volume);

/// Few boxes whose points are all inside, at least two along each axis; largest first.
std::vector<LatticeBox> solid_boxes(const InsidePoints& points);

}  // namespace gridcull
