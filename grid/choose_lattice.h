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

/// `bounds` and `cell` as asked where given, else derived from the objects' extents (their whole way is
/// not known here: pass what frames will add too) and sizes. An empty world gets one cell.
LatticeChoice choose_lattice(int dimension, std::span<const Object> objects, std::optional<Bounds> bounds,
                             std::optional<double> cell);

}  // namespace gridcull
