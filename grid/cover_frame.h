// What every discretisation kernel needs of the lattice: metres to ranges of cells along an axis.
//
// Rounding. With M the greatest |coordinate| in play, (metres - origin) * inverse is off by a few ulp of M,
// metres in cells; the margin that every caller has already added is about 500 ulp of M, so a plain floor
// is on the safe side without looking back at Lattice::boundary.
#pragma once

#include <algorithm>
#include <cstdint>

#include "gridcull/grid/lattice.h"

namespace gridcull::covering {

/// Cells first .. last of a row; none when last < first.
struct Range {
  std::int64_t first = 0, last = -1;
  bool empty() const { return last < first; }
};

/// floor(t) clamped to [low, high]; t may be infinite, not NaN. (std::floor is a call on plain x86-64.)
inline std::int64_t floor_within(double t, std::int64_t low, std::int64_t high) {
  t = std::max(std::min(t, static_cast<double>(high)), static_cast<double>(low));
  const auto i = static_cast<std::int64_t>(t);
  return i - static_cast<std::int64_t>(t < static_cast<double>(i));
}

/// ceil(t), likewise.
inline std::int64_t ceil_within(double t, std::int64_t low, std::int64_t high) {
  return -floor_within(-t, -high, -low);
}

/// One axis of the lattice.
struct Axis {
  double origin, cell, inverse;  ///< metres; inverse = 1 / cell
  std::int64_t cells;

  Axis(const Lattice& lattice, int axis)
      : origin(lattice.origin()[axis]),
        cell(lattice.cell()),
        inverse(1.0 / lattice.cell()),
        cells(axis == 0   ? lattice.cells().x
              : axis == 1 ? lattice.cells().y
                          : lattice.cells().z) {}

  double boundary(std::int64_t i) const { return origin + static_cast<double>(i) * cell; }
  /// Position in cells from the lattice's lower boundary.
  double in_cells(double metres) const { return (metres - origin) * inverse; }

  /// Cells that meet [low, high] (metres, grown by the margin already), clipped to the lattice; sets
  /// `outside` when the interval reaches beyond it.
  Range touched(double low, double high, bool& outside) const {
    const double first = in_cells(low), last = in_cells(high);
    outside = outside || first < 0.0 || last >= static_cast<double>(cells);
    return {floor_within(first, 0, cells), floor_within(last, -1, cells - 1)};
  }
};

}  // namespace gridcull::covering
