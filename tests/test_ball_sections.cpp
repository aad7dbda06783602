// Brute force in long doubles: entrances of rays into a ball against the keys and radii of its sections and slices.
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "gridcull/grid/ball_sections.h"

using namespace gridcull;

namespace {

double in(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Entrance of the ray that passes the centre at `off`.
long double entrance(long double distance, long double radius, long double off) {
  return std::sqrt((distance - off) * (distance + off)) - std::sqrt((radius - off) * (radius + off));
}

}  // namespace

TEST_CASE("balls: a section's rays have entered by its key") {
  std::mt19937_64 random(1);
  for (int round = 0; round < 20000; ++round) {
    const double radius = std::pow(10.0, in(random, -3, 4));
    const double distance = radius * (1.0 + std::pow(10.0, in(random, -7, 5)));
    std::array<BallSection, 4> out;
    const std::array<double, 4> fractions{0.3, 0.7, 1.0 - std::pow(2.0, in(random, -25, -2)), 1.0};
    const int count = ball_sections(distance, radius, fractions, out);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      CAPTURE(radius);
      CAPTURE(distance);
      REQUIRE(out[i].radius < radius);
      for (const double share : {1.0, in(random, 0, 1)}) {
        REQUIRE(entrance(distance, radius, share * static_cast<long double>(out[i].radius)) <=
                static_cast<long double>(out[i].key));
      }
      REQUIRE(out[i].key < distance * 1.001);
      if (i > 0) REQUIRE(out[i].key >= out[i - 1].key);
    }
  }
}

TEST_CASE("balls: a slice holds the rays that enter by its far end") {
  std::mt19937_64 random(2);
  for (int round = 0; round < 20000; ++round) {
    const double radius = std::pow(10.0, in(random, -3, 4));
    const double distance = radius * (1.0 + std::pow(10.0, in(random, -9, 5)));
    const auto [nearest, farthest] = ball_entrance(distance, radius);
    REQUIRE(nearest <= static_cast<double>(entrance(distance, radius, 0)));
    REQUIRE(static_cast<long double>(farthest) >= entrance(distance, radius, radius));
    const double far = in(random, nearest, farthest);
    const double slice = ball_slice_radius(distance, radius, far);
    for (int k = 0; k < 10; ++k) {
      const double off = in(random, 0, radius);
      if (entrance(distance, radius, off) <= static_cast<long double>(far)) REQUIRE(off <= slice);
    }
    // Not much more than needed either.
    if (slice < 0.99 * radius) {
      REQUIRE(entrance(distance, radius, slice) <= static_cast<long double>(far + 1e-9 * distance));
    }
  }
}
