// Random static worlds about a random viewing cell, for the tests of extended projections.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/methods/extended_cell.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {

struct ExtendedWorld {
  std::vector<Object> objects{};  ///< all static, occluders of every 3D shape and occludees; ids ascend
  extended::ViewCell cell{};

  std::vector<const Object*> pointers() const;
};

/// The same for the same seed. Occluders stand mostly between the cell and the occludees; some touch the cell, hold it,
/// or run through it. Every third cell is oriented.
ExtendedWorld random_extended_world(std::uint64_t seed);

/// A point of the cell: inside, on a side, an edge or a corner.
Vec3 random_viewpoint(const extended::ViewCell& cell, Random& random);

}  // namespace gridcull::test
