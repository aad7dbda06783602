// How long temporal bounding volumes last: per object, adaptive, spread in time (DESIGN section 4).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

/// A term is the longest validity that an object's next volume may get. It starts where the object could move
/// one cell (more where nobody looks), doubles when a volume expires unseen, halves when it is revealed, and
/// stays between a quarter of a cell and the widest that the index of volumes takes of possible movement.
class TbvTerm {
 public:
  explicit TbvTerm(double cell) : cell_(cell) {}

  double first(double max_speed) const { return cell_ / max_speed; }
  /// `most`: metres that a volume may grow beyond the object.
  double longer(double term, double max_speed, double most) const { return std::min(2.0 * term, most / max_speed); }
  /// The most of method `voxel`, whose T is made for volumes of some cells.
  double widest() const { return 3.0 * cell_; }
  double shorter(double term, double max_speed) const { return std::max(0.5 * term, 0.25 * cell_ / max_speed); }

  /// Seconds the next volume is valid, by a hash of the slot and of how many volumes it had, so that objects that
  /// disappeared together do not come back together: between half the term and the whole; the first time, when a
  /// whole world may disappear at once, from a twentieth on.
  static double spread(double term, Slot slot, std::uint32_t renewals) {
    std::uint64_t h = (std::uint64_t{slot} << 32 | renewals) + 0x9E37'79B9'7F4A'7C15ull;  // splitmix64
    h = (h ^ (h >> 30)) * 0xBF58'476D'1CE4'E5B9ull;
    h = (h ^ (h >> 27)) * 0x94D0'49BB'1331'11EBull;
    h ^= h >> 31;
    const double least = renewals == 0 ? 0.05 : 0.5;
    return term * (least + (1.0 - least) * (static_cast<double>(h >> 11) * 0x1p-53));
  }

  /// Radius of the ball that holds the object for `seconds`: it moves at most max_speed * seconds and may turn
  /// at any rate. The relative margin covers the slack with which jumps are recognised (1e-9 a frame) and
  /// every rounding.
  static double radius(double max_speed, double seconds, double reach) {
    return (max_speed > 0.0 ? max_speed * seconds * (1.0 + 1e-6) : 0.0) + reach;
  }

 private:
  double cell_;
};

}  // namespace gridcull
