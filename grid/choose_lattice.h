// Bounds and cell size where a scene names none: "model no more than a scene needs".
#pragma once

#include <optional>
#include <span>
#include <string>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull {

struct LatticeChoice {
  Bounds bounds;
  double cell;
  std::string bounds_reason;  ///< one clause: where the bounds come from
  std::string cell_reason;    ///< one clause: where the cell size comes from
};

/// `bounds` and `cell` as asked where given, else derived from the objects' extents and sizes. `ways`: where
/// they will go besides, for those who know. An empty world gets one cell.
///
/// The rule for the cell: a quarter of the median smaller dimension of the occluders that have an interior
/// (a disc's diameter, a box's or a local bounding box's smallest side), so that a typical occluder holds
/// whole cells at any heading; where nothing occludes, of all objects; rounded down to 1, 1.5, 2, 3, 4, 5, 6
/// or 8 times a power of ten, then made larger until there are at most `most_cells`. Cost grows with the
/// number of cells in view, accuracy with their number in an occluder; a quarter is where both are moderate.
/// The rule for the bounds: the box of all objects, rounded outward to whole cells and moved by a 1024th of a
/// cell, because faces at round coordinates (the ground) would lie on cell boundaries, and a cell that touches
/// a face from inside does not lie wholly inside. Objects and viewers may leave the bounds; they are answered
/// correctly there, only not hidden by the grid.
LatticeChoice choose_lattice(int dimension, std::span<const Object> objects, std::optional<Bounds> bounds,
                             std::optional<double> cell, const Bounds& ways = {});

/// Cells that a derived cell size leads to, at most.
inline constexpr double most_cells = 4e6;

/// Adds the object's box (exact up to rounding for outlines and vertices, the ball's box for round shapes).
void add_extent(const Object& object, Bounds& bounds);

/// The shape's smallest local side, metres: what a cell must be small against. 0 for thin shapes.
double smaller_dimension(const Shape& shape);

}  // namespace gridcull
