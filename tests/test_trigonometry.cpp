#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/pose.h"
#include "gridcull/core/trigonometry.h"

using namespace gridcull;

TEST_CASE("trigonometry: exact at zero and the same bits for ever") {
  CHECK(stable_sincos(0.0).sin == 0.0);
  CHECK(stable_sincos(0.0).cos == 1.0);
  // Bits written down once: another compiler, processor or optimisation level must give them again.
  CHECK(std::bit_cast<std::uint64_t>(stable_sincos(1.0).sin) == 0x3FEA'ED54'8F09'0CEEull);
  CHECK(std::bit_cast<std::uint64_t>(stable_sincos(1.0).cos) == 0x3FE1'4A28'0FB5'068Cull);
}

TEST_CASE("trigonometry: within 2 ulp of the C library, on the unit circle, odd and even") {
  std::mt19937_64 random(3);
  for (const double span : {1e-3, 1.0, 10.0, 1e5}) {
    std::uniform_real_distribution<double> angle(-span, span);
    for (int i = 0; i < 5000; ++i) {
      const double a = angle(random);
      CAPTURE(a);
      const SinCos sc = stable_sincos(a);
      // 2 ulp of the value, or of what is left of the angle after reduction near a zero.
      CHECK(std::fabs(sc.sin - std::sin(a)) <= 4.5e-16 * std::fabs(sc.sin) + 1e-26 * span);
      CHECK(std::fabs(sc.cos - std::cos(a)) <= 4.5e-16 * std::fabs(sc.cos) + 1e-26 * span);
      CHECK(std::fabs(sc.sin * sc.sin + sc.cos * sc.cos - 1.0) < 1e-15);
      CHECK(stable_sincos(-a).sin == -sc.sin);
      CHECK(stable_sincos(-a).cos == sc.cos);
    }
  }
  CHECK(std::isfinite(stable_sincos(1e300).sin));
}

TEST_CASE("trigonometry: many angles at a time give the bits of one at a time") {
  std::mt19937_64 random(5);
  std::vector<double> angles{0.0, -0.0, 5e-324, -5e-324, 1e5, -1e5, 0.25 * std::numbers::pi, -0.25 * std::numbers::pi};
  // Where the quarter changes, and on both sides of it.
  for (int i = -2000; i < 2000; ++i) {
    const double middle = i * (0.25 * std::numbers::pi);
    for (const double a : {middle, std::nextafter(middle, 1e9), std::nextafter(middle, -1e9)}) angles.push_back(a);
  }
  for (const double span : {1e-300, 1e-3, 1.0, 10.0, 1e5}) {
    std::uniform_real_distribution<double> angle(-span, span);
    for (int i = 0; i < 3000; ++i) angles.push_back(angle(random));
  }
  angles.push_back(1e9);  // its neighbours take the other way too
  std::vector<SinCos> out(angles.size());
  stable_sincos(angles, out);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const SinCos one = stable_sincos(angles[i]);
    differing += std::bit_cast<std::uint64_t>(one.sin) != std::bit_cast<std::uint64_t>(out[i].sin) ||
                 std::bit_cast<std::uint64_t>(one.cos) != std::bit_cast<std::uint64_t>(out[i].cos);
  }
  CHECK(differing == 0);
}

TEST_CASE("pose: turns about z, headings and composition") {
  for (double heading = -3.0; heading < 3.1; heading += 0.25) {
    CAPTURE(heading);
    const Quat q = turn_about_z(heading);
    CHECK(heading_of(q) == doctest::Approx(heading).epsilon(1e-14));
    const Rotation r = rotation_of(q);
    const Vec3 v(1.25, -2.5, 3.75);
    CHECK((r * v).z == v.z);
    CHECK(glm::length(r.inverse(r * v) - v) < 1e-14);
    const Pose base{{1, 2, 3}, q}, local{{0.5, 0.25, 1}, turn_about_z(0.3)};
    const Vec3 twice = to_world(base, r, to_world(local, rotation_of(local.orientation), v));
    const Pose both = compose(base, local);
    CHECK(glm::length(to_world(both, rotation_of(both.orientation), v) - twice) < 1e-14);
  }
  const Rotation still = rotation_of(turn_about_z(0.0));
  CHECK(still * Vec3(0.1, 0.2, 0.3) == Vec3(0.1, 0.2, 0.3));
}
