// How far the edges of a closed outline keep from each other.
#pragma once

#include <span>
#include <vector>

#include "gridcull/grid/outline_2d.h"

namespace gridcull {

/// Least distance between two edges, or between an edge and the far end of its neighbour; at most `enough`.
double clearance_of(std::span<const Vec2> points, double enough);

/// The parts of edges that keep at least `least` from all others but those that leave the same point at an angle.
void usable_parts(std::span<const Vec2> points, double least, std::vector<Outline2D::Part>& out);

}  // namespace gridcull
