// The view space that the five-dimensional tree divides: where a line of sight begins and which way it goes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "gridcull/core/bounds.h"

namespace gridcull {

/// Dimensions by number: 0 .. 2 position (2D: 0 and 1), then the two angles (2D: turn only).
///
/// The angles are monotone in the paper's theta and phi, but need no arc tangent, whose last bits differ between
/// machines: `turn` in [0, 8] grows from +x counter-clockwise by one in each eighth of a turn (by the tangent within
/// it); `rise` in [-1, 1] is the sine of the elevation, by which equal shares are equal solid angles.
constexpr int turn_axis = 3, rise_axis = 4, view_axes = 5;
constexpr double whole_turn = 8.0;

/// 0 for a direction without x and y.
inline double turn_of(const Vec3& d) {
  const double x = std::fabs(d.x), y = std::fabs(d.y);
  if (x == 0.0 && y == 0.0) return 0.0;
  const double part = y <= x ? y / x : 2.0 - x / y;  // in a quarter: 0 .. 2
  if (d.x > 0.0) return d.y >= 0.0 ? part : whole_turn - part;
  return d.y >= 0.0 ? 4.0 - part : 4.0 + part;
}

inline double rise_of(const Vec3& d) {
  const double length = std::sqrt(glm::dot(d, d));
  return length > 0.0 ? d.z / length : 0.0;
}

/// A box in view space; closed.
struct ViewCell {
  std::array<double, view_axes> low{}, high{};
};

/// What the tree is about. The static objects by ascending id come first in its sets, then the motion boxes.
struct FiveDSpace {
  int dimension = 3;
  int bits = 12;                                ///< q
  Bounds positions{};                           ///< of viewpoints
  std::uint32_t statics = 0;                    ///< static objects
  Bounds region{};                              ///< divided into the motion boxes
  std::array<std::uint32_t, 3> boxes{0, 0, 0};  ///< along each axis; 2D: the last is 1

  std::uint32_t box_count() const { return boxes[0] * boxes[1] * boxes[2]; }
  std::uint32_t members() const { return statics + box_count(); }
  std::size_t words() const { return (members() + 63) / 64; }

  bool has(int axis) const { return axis == 2 || axis == rise_axis ? dimension == 3 : true; }
  double low(int axis) const { return axis < 3 ? positions.min[axis] : axis == turn_axis ? 0.0 : -1.0; }
  double high(int axis) const { return axis < 3 ? positions.max[axis] : axis == turn_axis ? whole_turn : 1.0; }
  std::uint32_t steps() const { return 1u << bits; }
  /// Where a split at this step lies; steps are whole, 1 .. steps() - 1.
  double plane(int axis, std::uint32_t step) const {
    return low(axis) + (high(axis) - low(axis)) * (static_cast<double>(step) / steps());
  }
  /// The nearest step, at least 1 and below steps().
  std::uint32_t nearest_step(int axis, double at) const {
    const double size = high(axis) - low(axis);
    const double step = size > 0.0 ? std::floor((at - low(axis)) / size * steps() + 0.5) : 1.0;
    return static_cast<std::uint32_t>(std::clamp(step, 1.0, static_cast<double>(steps() - 1)));
  }
  ViewCell whole() const {
    ViewCell cell;
    for (int axis = 0; axis < view_axes; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      if (has(axis)) cell.low[k] = low(axis), cell.high[k] = high(axis);
    }
    return cell;
  }
  Bounds box(std::uint32_t number) const {
    const std::array<std::uint32_t, 3> at{number % boxes[0], number / boxes[0] % boxes[1],
                                          number / boxes[0] / boxes[1]};
    Bounds out;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double edge = (region.max[k] - region.min[k]) / boxes[i];
      out.min[k] = region.min[k] + edge * at[i];
      out.max[k] = at[i] + 1 == boxes[i] ? region.max[k] : region.min[k] + edge * (at[i] + 1);
    }
    return out;
  }
};

}  // namespace gridcull
