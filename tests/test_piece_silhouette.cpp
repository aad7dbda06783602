// Brute force: rays inside a silhouette must meet the shape no later than its key.
#include <doctest/doctest.h>

#include "gridcull/grid/occluder_pieces.h"
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
  int used = 0, refused = 0, rays = 0;
};

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
    for (int k = 0; k < 12; ++k) {
      const auto at = truth.entrance(inside(outline, random));
      ++counts.rays;
      REQUIRE(at.has_value());
      REQUIRE(*at <= static_cast<long double>(outline.farthest));
    }
  }
}

}  // namespace

TEST_CASE("silhouettes: every ray inside meets the shape by the key") {
  std::mt19937_64 random(5);
  Counts counts;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    CAPTURE(seed);
    check(random_placement(seed), random, counts);
  }
  MESSAGE(counts.used << " used, " << counts.refused << " refused, " << counts.rays << " rays");
  CHECK(counts.used > 4 * counts.refused);
}
