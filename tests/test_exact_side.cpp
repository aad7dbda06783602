// The grid's exact signs against the reference's, which come another way.
#include <random>

#include <doctest/doctest.h>

#include "gridcull/core/predicates.h"
#include "gridcull/grid/exact_side.h"

using namespace gridcull;

namespace {

/// Ties on purpose: small whole numbers, a shared scale, or a last bit off.
double coordinate(std::mt19937_64& random, int kind) {
  const double whole = static_cast<double>(random() % 7) - 3.0;
  if (kind == 0) return whole;
  if (kind == 1) return whole * 0.1 + 1e6;
  if (kind == 2) return 0.5 + static_cast<double>(random() % 64) * 0x1p-53;
  if (kind == 3) return whole * 1e-30;
  return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5;
}

}  // namespace

TEST_CASE("sides of lines and planes are exact") {
  std::mt19937_64 random(17);
  int zeros = 0;
  for (int round = 0; round < 60000; ++round) {
    CAPTURE(round);
    const int kind = round % 5;
    const auto any = [&] {
      return Vec3(coordinate(random, kind), coordinate(random, kind), coordinate(random, round % 7 == 0 ? 0 : kind));
    };
    const Vec3 a = any(), b = any(), c = any();
    // Often all but on the line or plane of the others.
    Vec3 p = any();
    if (round % 3 == 0) p = a + 0.3 * (b - a) + 0.45 * (c - a);
    const int plane = side_of_plane(a, b, c, p), line = side_of_line(Vec2(a), Vec2(b), Vec2(p));
    REQUIRE(plane == orientation(a, b, c, p));
    REQUIRE(line == orientation(Vec2(a), Vec2(b), Vec2(p)));
    zeros += (plane == 0) + (line == 0);
  }
  CHECK(zeros > 1000);
}

TEST_CASE("sides of lines: points about a line at the last bit") {
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec2 p(0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53);
      CHECK(side_of_line({12, 12}, {24, 24}, p) == (j > i) - (j < i));
    }
  }
}
