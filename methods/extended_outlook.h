// All maps of a viewing cell, and who is hidden behind them (paper section 6.1).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "gridcull/methods/extended_cell.h"
#include "gridcull/methods/extended_pieces.h"
#include "gridcull/methods/extended_plane.h"

namespace gridcull::extended {

/// One projection plane with its map.
struct Outlook {
  Facing facing{};
  Plane plane{};
  DepthMap map{};
};

/// Out of one cell in all directions.
struct Outlooks {
  ViewCell cell{};
  double floor = -std::numeric_limits<double>::infinity();  ///< z: what reaches below it is not judged, so not hidden
  std::vector<Outlook> planes{};

  /// `box`: in the cell's axes, grown by its error. `all`: hidden from the whole cell by one plane's map. `none`: no
  /// part of it is.
  Cover cover(const Bounds& box, std::uint64_t& looked_at) const;
  /// Whether all of the box is hidden from the whole cell: at once, or halved up to `halvings` times, part by part and
  /// each by its own plane.
  bool hides(const Bounds& box, int halvings, std::uint64_t& looked_at) const;
};

/// The box of an occludee, and of a box, in the cell's axes, grown by what rounding may have done to it.
Bounds box_in(const ViewCell& cell, const Occludee& occludee);
Bounds box_in(const ViewCell& cell, const Bounds& world);

}  // namespace gridcull::extended
