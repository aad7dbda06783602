// Brute force: rays inside a silhouette must meet the shape no later than its key.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "gridcull/grid/angular_hull.h"
#include "gridcull/grid/occluder_pieces.h"
#include "gridcull/grid/piece_sections.h"
#include "gridcull/grid/piece_silhouette.h"
#include "random_solids.h"
#include "ray_truth.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// A random direction of the cone spanned by the rays, often near its border.
Long3 inside(const Outline& outline, std::mt19937_64& random) {
  Long3 sum{0, 0, 0};
  const bool border = random() % 2 == 0;
  const std::size_t first = random() % static_cast<std::size_t>(outline.count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(outline.count); ++i) {
    const long double share = static_cast<long double>(random() >> 11) * 0x1p-53L;
    const bool edge = i == first || i == (first + 1) % static_cast<std::size_t>(outline.count);
    sum = sum + (border && !edge ? 1e-9L * share : share) * longer(outline.rays[i]);
  }
  return sum;
}

struct Counts {
  int used = 0, refused = 0, rays = 0, sections = 0;
};

void check_rays(const RayTruth& truth, const Outline& outline, double key, std::mt19937_64& random, Counts& counts) {
  for (int k = 0; k < 12; ++k) {
    const auto at = truth.entrance(inside(outline, random));
    ++counts.rays;
    REQUIRE(at.has_value());
    REQUIRE(*at <= static_cast<long double>(key));
  }
}

void check(const Placement& placed, std::mt19937_64& random, Counts& counts) {
  const RayTruth truth(placed.shape, placed.pose, placed.eye);
  if (truth.holds_eye()) return;
  const SightFrame frame = sight_frame(placed.pose, rotation_of(placed.pose.orientation), placed.eye);
  for (const ConvexPiece& piece : make_occluder_pieces(placed.shape).pieces) {
    Outline outline;
    if (!silhouette({piece, frame}, outline)) {
      ++counts.refused;
      continue;
    }
    ++counts.used;
    check_rays(truth, outline, outline.farthest, random, counts);
    std::array<Section, max_sections> nested;
    const int count = sections({piece, frame}, nested);
    REQUIRE(count >= 1);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      check_rays(truth, nested[i].outline, nested[i].key, random, counts);
      if (i > 0) REQUIRE(nested[i - 1].key < nested[i].key);
    }
    counts.sections += count;
  }
}

}  // namespace

TEST_CASE("silhouettes and sections: every ray inside meets the shape by the key") {
  std::mt19937_64 random(5);
  Counts counts;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    CAPTURE(seed);
    check(random_placement(seed), random, counts);
  }
  MESSAGE(counts.used << " pieces used, " << counts.refused << " refused, " << counts.sections << " sections, "
                      << counts.rays << " rays");
  CHECK(counts.used > 4 * counts.refused);
  CHECK(counts.sections > counts.used);
}

// A lid of 32 corners, seen from above its middle: the circle in which the section at its one key between cuts the
// lid's plane crosses 30 edges twice. That is more points than an outline has room for.
TEST_CASE("sections: what has too many corners is left out, and nothing beyond an outline is written") {
  const double spike = 1.25, circle = std::sqrt(std::sqrt(1.0 + spike * spike) - 1.0);
  const double pi = std::numbers::pi, gap = std::acos(circle / spike), step = 2.0 * (pi - gap) / 30.0;
  const double radius = circle / std::cos(0.25 * step);
  Prism lid{{{spike, 0.0}}, 1.0};
  for (int k = 0; k <= 30; ++k) {
    const double angle = gap + step * k;
    lid.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  const OccluderPieces made = make_occluder_pieces(lid);
  REQUIRE(made.pieces.size() == 1);
  std::array<Section, max_sections> nested;
  const int count = sections({made.pieces[0], sight_frame({}, rotation_of({}), Vec3(0, 0, 2))}, nested);
  REQUIRE(count >= 1);
  for (int i = 0; i < count; ++i) CHECK(nested[static_cast<std::size_t>(i)].outline.count <= Outline::max_rays);
  // The points on a circle, one more than fit.
  std::vector<SeenPoint> points;
  for (int k = 0; k < Outline::max_rays + 1; ++k) {
    const double angle = 2.0 * pi * k / (Outline::max_rays + 1);
    points.push_back({{std::cos(angle), std::sin(angle), 1.0}, {}});
  }
  Outline out;
  CHECK_FALSE(angular_hull(points, {0, 0, 1}, out));
  CHECK(out.count == 0);
  points.pop_back();
  CHECK(angular_hull(points, {0, 0, 1}, out));
  CHECK(out.count == Outline::max_rays);
}

TEST_CASE("sections: a long wall seen from its near end hides there early") {
  const Shape wall = Cuboid{{100, 0.3, 20}};
  const Pose pose{{50, 5, 10}, {}};
  const Vec3 eye(0, 0, 1.6);
  const OccluderPieces made = make_occluder_pieces(wall);
  std::array<Section, max_sections> nested;
  REQUIRE(sections({made.pieces[0], sight_frame(pose, rotation_of(pose.orientation), eye)}, nested) == 4);
  CHECK(nested[0].key < 12);
  CHECK(nested[3].key > 100);
  const auto holds = [](const Outline& outline, const Vec3& d) {
    for (int i = 0; i < outline.count; ++i) {
      const Vec3 a = outline.rays[static_cast<std::size_t>(i)];
      const Vec3 b = outline.rays[static_cast<std::size_t>((i + 1) % outline.count)];
      if (!(glm::dot(glm::cross(a, b), d) > 0.0)) return false;
    }
    return true;
  };
  CHECK(holds(nested[0].outline, {1, 5, 0}));
  CHECK_FALSE(holds(nested[0].outline, {40, 5, 0}));
  CHECK(holds(nested[3].outline, {90, 5, 0}));
}
