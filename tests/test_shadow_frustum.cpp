// Brute force: what a shadow frustum, or two together, call hidden must be behind the occluder along every sampled ray.
#include <doctest/doctest.h>

#include "gridcull/methods/image_polygon.h"
#include "gridcull/methods/shadow_frustum.h"
#include "random_solids.h"
#include "ray_truth.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
Vec3 cube(std::mt19937_64& random) { return 2.0 * Vec3(unit(random), unit(random), unit(random)) - 1.0; }

/// A ball as RayTruth has none.
struct BallTruth {
  Long3 centre;
  long double radius;

  bool hides(const Long3& p) const {
    const long double t = std::clamp(dot(centre, p) / dot(p, p), 0.0L, 1.0L);
    return length(t * p - centre) < radius;
  }
};

bool hides(const RayTruth& truth, const Long3& p) {
  const auto at = truth.entrance(p);
  return at.has_value() && *at < length(p);
}

struct Counts {
  int frusta = 0, refused = 0, inside = 0, partial = 0, outside = 0;
};

/// Weights of the part's points, positive: anywhere in its hull, near a corner, or on the line of two corners, which is
/// where shadows end, but for rounding.
std::vector<double> weights(std::size_t count, std::mt19937_64& random) {
  std::vector<double> out(count, 0.0);
  const int kind = static_cast<int>(random() % 3);
  const std::size_t first = random() % count, second = random() % count;
  for (std::size_t i = 0; i < count; ++i) {
    if (kind == 0) out[i] = unit(random) + 1e-9;
    if (kind == 1) out[i] = i == first ? 1.0 : 1e-3 * unit(random);
    if (kind == 2 && (i == first || i == second)) out[i] = unit(random) + 1e-9;
  }
  return out;
}

/// A point in or near the shadow of the part, often at its border and close behind it.
Vec3 near_shadow(const OccluderPart& part, const Pose& pose, const Vec3& eye, std::mt19937_64& random) {
  const Rotation r = rotation_of(pose.orientation);
  std::vector<Vec3> points = part.vertices;
  if (points.empty()) {  // a ball: in it, or where rays touch it
    const Vec3 to_eye = eye - pose.position;
    const double d = glm::length(to_eye), share = part.radius / d;
    const Vec3 across = glm::normalize(glm::cross(to_eye, cube(random)));
    points = {part.radius * cube(random), part.radius * cube(random)};
    if (random() % 2 == 0 && share < 1.0) {
      points = {part.radius * (share * to_eye / d + std::sqrt(1.0 - share * share) * across)};
    }
  }
  const std::vector<double> weight = weights(points.size(), random);
  Vec3 p(0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    p += weight[i] * (to_world(pose, r, points[i]) - eye);
    sum += weight[i];
  }
  p /= sum;
  const int kind = static_cast<int>(random() % 4);
  const double stretch = kind == 0   ? 1.0
                         : kind == 1 ? 1.0 + std::pow(2.0, -52.0 * unit(random))
                                     : 1.0 + 9.0 * unit(random);
  return eye + stretch * p;
}

Bounds box_about(const Vec3& p, double scale, std::mt19937_64& random) {
  if (random() % 3 == 0) return {p, p};
  const Vec3 half = scale * std::pow(2.0, -50.0 * unit(random)) * (0.5 + 0.5 * cube(random));
  return {p - half, p + half};
}

template <class Hides>
void check_box(const ShadowFrustum& frustum, const Bounds& box, const Vec3& eye, const Hides& is_hidden,
               std::mt19937_64& random, Counts& counts) {
  std::uint64_t tests = 0;
  const Overlap place = frustum.overlap(SightBox(box, eye), tests);
  REQUIRE(tests > 0);
  ++(place == Overlap::inside ? counts.inside : place == Overlap::partial ? counts.partial : counts.outside);
  if (place != Overlap::inside) return;
  for (int k = 0; k < 16; ++k) {
    const Vec3 f = k < 8 ? Vec3(k & 1, k >> 1 & 1, k >> 2) : Vec3(unit(random), unit(random), unit(random));
    const Vec3 p = glm::clamp(box.min + f * box.size(), box.min, box.max);
    REQUIRE(is_hidden(longer(p) - longer(eye)));
  }
}

/// The truth leaves out crossings of faces that the viewer sees edge-on but for rounding.
bool is_edge_on(const OccluderPart& part, const Pose& pose, const Vec3& eye) {
  if (part.kind != OccluderPart::Kind::face) return false;
  const Rotation r = rotation_of(pose.orientation);
  std::vector<Long3> p;
  for (const Vec3& v : part.vertices) p.push_back(longer(to_world(pose, r, v)) - longer(eye));
  const Long3 normal = cross(p[1] - p[0], p[2] - p[0]);
  return std::fabs(dot(normal, p[0])) <= 1e-9L * length(normal) * length(p[0]);
}

void check_placement(const Placement& placed, std::mt19937_64& random, Counts& counts) {
  const RayTruth truth(placed.shape, placed.pose, placed.eye);
  if (truth.holds_eye()) return;
  const Rotation rotation = rotation_of(placed.pose.orientation);
  for (const OccluderPart& part : make_occluder_parts(placed.shape)) {
    ShadowFrustum frustum;
    SilhouetteTrack track;
    if (is_edge_on(part, placed.pose, placed.eye)) continue;
    if (!frustum.build(part, placed.pose, rotation, placed.eye, track)) {
      ++counts.refused;
      continue;
    }
    ++counts.frusta;
    for (int k = 0; k < 12; ++k) {
      const Vec3 p = near_shadow(part, placed.pose, placed.eye, random);
      check_box(
          frustum, box_about(p, part.radius, random), placed.eye,
          [&](const Long3& at) { return truth.runs_along_a_wall(at) || hides(truth, at); }, random, counts);
    }
  }
}

OccluderPart only_part(const Shape& shape) {
  auto parts = make_occluder_parts(shape);
  REQUIRE(parts.size() == 1);
  return parts[0];
}

}  // namespace

TEST_CASE("shadow frusta: a box called inside is hidden along every ray") {
  std::mt19937_64 random(11);
  Counts counts;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    CAPTURE(seed);
    check_placement(random_placement(seed), random, counts);
  }
  MESSAGE(counts.frusta << " frusta, " << counts.refused << " refused, boxes inside " << counts.inside << ", partial "
                        << counts.partial << ", outside " << counts.outside);
  CHECK(counts.frusta > 4 * counts.refused);
  CHECK(counts.inside > counts.frusta);
}

TEST_CASE("shadow frusta: behind a ball, boxes and balls") {
  std::mt19937_64 random(12);
  Counts counts;
  int balls = 0;
  for (int k = 0; k < 20000; ++k) {
    CAPTURE(k);
    const double far = k % 4 == 0 ? 1e7 : k % 4 == 1 ? 1e4 : 10.0;
    const Pose pose{far * cube(random), {}};
    const double radius = std::pow(2.0, 8.0 * unit(random) - 4.0);
    const Vec3 eye = pose.position + radius * std::pow(2.0, 6.0 * unit(random) - 1.0) * cube(random);
    const BallTruth truth{longer(pose.position) - longer(eye), radius};
    const OccluderPart part = only_part(Sphere{radius});
    ShadowFrustum frustum;
    SilhouetteTrack track;
    if (!frustum.build(part, pose, {}, eye, track)) continue;
    const Vec3 p = near_shadow(part, pose, eye, random);
    const auto is_hidden = [&](const Long3& at) { return truth.hides(at); };
    check_box(frustum, box_about(p, radius, random), eye, is_hidden, random, counts);
    const double size = radius * std::pow(2.0, -20.0 * unit(random));
    std::uint64_t tests = 0;
    if (frustum.overlap(SightBall(p, size, eye), tests) != Overlap::inside) continue;
    ++balls;
    for (int i = 0; i < 20; ++i) {
      const Long3 d = longer(cube(random));
      REQUIRE(truth.hides(longer(p) - longer(eye) + (size / length(d)) * d));
    }
  }
  CHECK(counts.inside > 1000);
  CHECK(balls > 1000);
}

TEST_CASE("shadow frusta: outlines, alone and behind two occluders together") {
  std::mt19937_64 random(13);
  UnionScratch scratch;
  ImagePolygon polygon;
  int alone = 0, together = 0;
  for (int k = 0; k < 60000; ++k) {
    CAPTURE(k);
    const double far = k % 3 == 0 ? 1e7 : 0.0;
    const Vec3 origin = glm::floor(far * cube(random));
    const Shape shape = Cuboid{{1.0 + 3.0 * unit(random), 1.0 + 3.0 * unit(random), 1.0 + 3.0 * unit(random)}};
    const OccluderPart part = only_part(shape);
    const Vec3 eye = origin + Vec3(0.0, 0.0, 0.5);
    // Two boxes side by side in front of the viewer; a smaller one behind both.
    const double apart = 4.0 * unit(random) - 0.5;
    const std::array<Pose, 2> poses{Pose{origin + Vec3(6, apart, unit(random)), turn_about_z(3.0 * unit(random))},
                                    Pose{origin + Vec3(7, -apart, unit(random)), turn_about_z(3.0 * unit(random))}};
    std::array<ShadowFrustum, 2> frusta;
    std::vector<RayTruth> truths;
    bool built = true;
    for (std::size_t i = 0; i < 2; ++i) {
      SilhouetteTrack track;
      built = built && frusta[i].build(part, poses[i], rotation_of(poses[i].orientation), eye, track);
      truths.emplace_back(shape, poses[i], eye);
    }
    REQUIRE(built);
    std::vector<Vec3> world, points;
    const Vec3 middle = origin + Vec3(15, 6.0 * unit(random) - 3.0, 1.5 * unit(random));
    for (int i = 0; i < 6; ++i) world.push_back(middle + 1.5 * unit(random) * cube(random));
    for (const Vec3& p : world) points.push_back(p - eye);
    const double blur = blur_of(origin, 20.0, eye);
    REQUIRE(polygon.build(points, middle - eye, blur, false));
    std::uint64_t tests = 0;
    const bool one = overlap(polygon, frusta[0], tests) == Overlap::inside && frusta[0].beyond(points, blur, tests);
    const bool two = inside_union(polygon, frusta[0], frusta[1], scratch, tests) &&
                     frusta[0].beyond(points, blur, tests) && frusta[1].beyond(points, blur, tests);
    alone += one ? 1 : 0;
    together += two && !one ? 1 : 0;
    if (!one && !two) continue;
    for (int i = 0; i < 24; ++i) {
      Long3 sum{0, 0, 0};
      long double weights = 0;
      for (const Vec3& p : world) {
        const long double w = i < 6 && &p != &world[static_cast<std::size_t>(i)] ? 0.0L : unit(random) + 1e-9;
        sum = sum + w * (longer(p) - longer(eye));
        weights += w;
      }
      const Long3 at = (1 / weights) * sum;
      REQUIRE((hides(truths[0], at) || (two && hides(truths[1], at))));
    }
  }
  MESSAGE(alone << " behind one, " << together << " behind two together");
  CHECK(alone > 500);
  CHECK(together > 500);
}

TEST_CASE("shadow frusta: outcomes on plain cases") {
  const OccluderPart wall = only_part(Cuboid{{1, 40, 20}});
  const Vec3 eye(0, 0, 0);
  ShadowFrustum frustum;
  SilhouetteTrack track;
  REQUIRE(frustum.build(wall, {{10, 0, 0}, {}}, {}, eye, track));
  std::uint64_t tests = 0;
  const auto place = [&](const Vec3& low, const Vec3& high) {
    return frustum.overlap(SightBox({low, high}, eye), tests);
  };
  CHECK(place({15, -1, -1}, {17, 1, 1}) == Overlap::inside);
  CHECK(place({10.6, 17, -1}, {11, 18, 1}) == Overlap::inside);  // before the near plane, behind the wall's face
  CHECK(place({15, 25, -1}, {17, 60, 1}) == Overlap::partial);
  CHECK(place({9, -1, -1}, {17, 1, 1}) == Overlap::partial);
  CHECK(place({1, -1, -1}, {2, 1, 1}) == Overlap::outside);
  CHECK(place({-20, -1, -1}, {-15, 1, 1}) == Overlap::outside);
  CHECK(place({15, 60, -1}, {17, 65, 1}) == Overlap::outside);
  // The wall itself, and what touches it on the viewer's side.
  CHECK(place({9.5, -20, -10}, {10.5, 20, 10}) == Overlap::partial);
  CHECK(place({9.0, -1, -1}, {9.5, 1, 1}) != Overlap::inside);
  // Thin walls of triangles hide too, from either side.
  const OccluderPart face = only_part(Faces{{{10, -9, -9}, {10, 9, -9}, {10, 0, 9}}, {{0, 1, 2}}});
  for (const double x : {0.0, 20.0}) {
    REQUIRE(frustum.build(face, {}, {}, {x, 0, 0}, track));
    const Vec3 behind(20.0 - x, 0, 0);
    CHECK(frustum.overlap(SightBox({behind - 0.5, behind + 0.5}, {x, 0, 0}), tests) == Overlap::inside);
  }
  // From within, or from its own plane, nothing.
  CHECK(!frustum.build(wall, {{10, 0, 0}, {}}, {}, {10, 0, 0}, track));
  CHECK(!frustum.build(face, {}, {}, {10, 0, 20}, track));
}

TEST_CASE("shadow frusta: a silhouette is walked anew only when other faces look at the viewer") {
  const OccluderPart box = only_part(Cuboid{{2, 2, 2}});
  ShadowFrustum frustum;
  SilhouetteTrack track;
  for (int k = 0; k < 100; ++k) {
    const Vec3 eye(5.0, 0.06 * k - 3.0, 3.0);  // sees one side at first, two or three sides and the top later
    REQUIRE(frustum.build(box, {}, {}, eye, track));
    CHECK(frustum.sides().size() >= 4);
  }
  CHECK(track.walks == 3);
}
