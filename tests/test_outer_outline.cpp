// Brute force: every point of an object lies in its outer cone, every front point in its slice's.
#include <algorithm>

#include <doctest/doctest.h>

#include "gridcull/grid/occluder_pieces.h"
#include "gridcull/grid/outer_outline.h"
#include "random_solids.h"
#include "ray_truth.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// Strictly within the convex hull of the directions: no plane between two rays that has all others on its other side.
bool holds(const Outline& outline, const Long3& d) {
  bool inside_all = true;
  for (std::size_t i = 0, n = static_cast<std::size_t>(outline.count); i < n && inside_all; ++i) {
    inside_all = dot(cross(longer(outline.rays[i]), longer(outline.rays[(i + 1) % n])), d) > 0;
  }
  return inside_all;
}

long double unit(std::mt19937_64& random) { return static_cast<long double>(random() >> 11) * 0x1p-53L; }

/// A vertex, a point of an edge or triangle of vertices, of the hull, relative to the eye; of Faces only vertices.
Long3 point_of(const std::vector<Vec3>& vertices, const Vec3& eye, bool corner, std::mt19937_64& random) {
  Long3 sum = longer(vertices[random() % vertices.size()]) - longer(eye);
  for (int k = 0; k < 2 && !corner; ++k) {
    sum = sum + unit(random) * (longer(vertices[random() % vertices.size()]) - longer(eye) - sum);
  }
  return sum;
}

struct Counts {
  int outlines = 0, unknown = 0, points = 0, slices = 0, unknown_slices = 0, empty_slices = 0;
};

void check_slices(const Placement& placed, const PlacedPiece& hull, const Outline& whole,
                  const std::vector<Vec3>& vertices, std::mt19937_64& random, Counts& counts) {
  const RayTruth truth(placed.shape, placed.pose, placed.eye);
  const double middle = whole.nearest + 0.4 * (whole.farthest - whole.nearest);
  const std::array<double, 4> at{whole.nearest, middle, 0.5 * (middle + whole.farthest), whole.farthest};
  std::array<Outline, 3> outline;
  std::array<Slice, 3> slice;
  for (std::size_t s = 0; s < 3; ++s) {
    slice[s] = outer_slice(hull, at[s], at[s + 1], outline[s]);
    ++(slice[s] == Slice::unknown ? counts.unknown_slices
       : slice[s] == Slice::empty ? counts.empty_slices
                                  : counts.slices);
  }
  for (int k = 0; k < 20; ++k) {
    const Long3 d = point_of(vertices, placed.eye, false, random);
    if (truth.runs_along_a_wall(d)) continue;
    const long double front = truth.entrance(d).value_or(length(d));
    bool found = false;
    for (std::size_t s = 0; s < 3; ++s) {
      found = found ||
              (front >= at[s] && (slice[s] == Slice::unknown || (slice[s] == Slice::outline && holds(outline[s], d))));
    }
    REQUIRE(found);
  }
}

void check(const Placement& placed, std::mt19937_64& random, Counts& counts) {
  const ConvexPiece hull = make_outer_hull(placed.shape);
  const SightFrame frame = sight_frame(placed.pose, rotation_of(placed.pose.orientation), placed.eye);
  Outline outline;
  if (!outer_outline({hull, frame}, outline)) {
    ++counts.unknown;
    return;
  }
  ++counts.outlines;
  const std::vector<Vec3> vertices = world_vertices(placed.shape, placed.pose);
  for (int k = 0; k < 30; ++k) {
    const Long3 p = point_of(vertices, placed.eye, k % 2 == 0, random);
    ++counts.points;
    REQUIRE(length(p) >= static_cast<long double>(outline.nearest));
    REQUIRE(holds(outline, p));
  }
  check_slices(placed, {hull, frame}, outline, vertices, random, counts);
}

}  // namespace

TEST_CASE("outer outlines and slices hold the object") {
  std::mt19937_64 random(6);
  Counts counts;
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    CAPTURE(seed);
    check(random_placement(seed), random, counts);
  }
  MESSAGE(counts.outlines << " outlines, " << counts.unknown << " unknown, " << counts.slices << " slices, "
                          << counts.unknown_slices << " unknown, " << counts.empty_slices << " empty");
  CHECK(counts.outlines > 2 * counts.unknown);
  CHECK(counts.slices > counts.unknown_slices);
}
