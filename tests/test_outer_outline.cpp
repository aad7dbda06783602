// Brute force: every point of an object lies in its outer cone, every front point in its slice's.
#include <algorithm>

#include <doctest/doctest.h>

#include "gridcull/grid/bound_piece.h"
#include "gridcull/grid/occluder_pieces.h"
#include "gridcull/grid/outer_outline.h"
#include "random_solids.h"
#include "ray_truth.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// Strictly within the convex hull of the directions: no plane between two rays that has all others on its other side.
/// Rays that are equal but for rounding span no plane of their own; one of them stands for all.
bool holds(const Outline& outline, const Long3& d) {
  std::vector<Long3> rays;
  const auto apart = [](const Long3& a, const Long3& b) {
    return length(cross(a, b)) > 0x1p-32L * length(a) * length(b);
  };
  for (int i = 0; i < outline.count; ++i) {
    const Long3 ray = longer(outline.rays[static_cast<std::size_t>(i)]);
    if (rays.empty() || apart(rays.back(), ray)) rays.push_back(ray);
  }
  while (rays.size() > 1 && !apart(rays.back(), rays.front())) rays.pop_back();
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!(dot(cross(rays[i], rays[(i + 1) % rays.size()]), d) > 0)) return false;
  }
  return true;
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

void check(const Placement& placed, const ConvexPiece& hull, std::mt19937_64& random, Counts& counts) {
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
    const Placement placed = random_placement(seed);
    check(placed, make_outer_hull(placed.shape), random, counts);
  }
  MESSAGE(counts.outlines << " outlines, " << counts.unknown << " unknown, " << counts.slices << " slices, "
                          << counts.unknown_slices << " unknown, " << counts.empty_slices << " empty");
  CHECK(counts.outlines > 2 * counts.unknown);
  CHECK(counts.slices > counts.unknown_slices);
}

TEST_CASE("outlines and slices of bounding volumes hold the object") {
  std::mt19937_64 random(7);
  for (const BoundKind kind : all_bound_kinds) {
    if (kind == BoundKind::sphere) continue;  // tested as a ball
    CAPTURE(name_of(kind));
    Counts counts;
    for (std::uint64_t seed = 20000; seed < 20800; ++seed) {
      CAPTURE(seed);
      const Placement placed = random_placement(seed);
      const ConvexPiece piece = bound_piece(placed.shape, kind);
      REQUIRE(!piece.empty());
      check(placed, piece, random, counts);
    }
    MESSAGE(name_of(kind) << ": " << counts.outlines << " outlines, " << counts.unknown << " unknown");
    CHECK(counts.outlines > counts.unknown);
    CHECK(counts.slices > counts.unknown_slices);
  }
}

TEST_CASE("pieces of bounding volumes: boxes stay boxes, large hulls become 26-DOPs, flat shapes get a thickness") {
  for (const BoundKind kind :
       {BoundKind::box, BoundKind::obb, BoundKind::dop14, BoundKind::dop18, BoundKind::dop26, BoundKind::hull}) {
    CAPTURE(name_of(kind));
    CHECK(bound_piece(Cuboid{{2, 3, 4}}, kind).face_count() == 6);
    CHECK(bound_piece(Cuboid{{2, 3, 4}}, kind).vertex_count() == 8);
    const Faces triangle{{{1, 1, 1}, {4, 1, 1}, {1, 3, 1}}, {{0, 1, 2}}};
    const ConvexPiece flat = bound_piece(triangle, kind);
    REQUIRE(!flat.empty());
    CHECK(flat.inradius > 1e-6);
    CHECK(flat.inradius < 1e-3);
    const bool round = kind == BoundKind::hull;
    CHECK(bound_piece(Sphere{2.0}, kind).empty() == round);
  }
  Convex many;
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const auto u = [&] { return static_cast<double>(unit(random)) - 0.5; };
    many.vertices.push_back(glm::normalize(Vec3(u(), u(), u())));
  }
  CHECK(bound_piece(many, BoundKind::hull).faces.size() == 26);
  CHECK(bound_piece(many, BoundKind::sphere).empty());
}
