// What follows from a volume's field, for the methods; the reference makes no use of it.
#pragma once

#include <memory>
#include <vector>

#include "gridcull/core/scalar_field.h"
#include "gridcull/core/vec.h"

namespace gridcull {

class InsidePoints;

/// Points of a lattice from one corner to the other, both inclusive; and the box in space between those corners.
struct LatticeBox {
  LatticePoint first{0}, last{-1};

  bool empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
};

struct VolumeBody {
  std::shared_ptr<const InsidePoints> points;
  /// Corners of a convex polyhedron that holds the volume, the object's local axes, metres; rounding included.
  std::vector<Vec3> outer;
  /// Boxes of lattice cells that lie wholly in the interior, largest first; they may overlap. None for what is thinner
  /// than two cells everywhere.
  std::vector<LatticeBox> inner;
};

}  // namespace gridcull
