// Fields and volumes: values, what is inside, what is made of it for the methods.
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/scalar_field.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/core/volume.h"
#include "random_volumes.h"
#include "volume_truth.h"

using namespace gridcull;
using test::field_of;
using test::random_volume;
using test::VolumeTruth;

namespace {

template <class F>
std::string refusal(F&& f) {
  try {
    f();
  } catch (const Error& fault) {
    CHECK(fault.code() == ErrorCode::bad_scene);
    return fault.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Pose random_pose(std::mt19937_64& random) {
  const auto u = [&] { return uniform(random, -1, 1); };
  return {{5 * u(), 5 * u(), 5 * u()}, normalised({u() + 1.1, u(), u(), u()})};
}

FieldBlock block_at(const LatticePoint& origin, float value) {
  FieldBlock block{origin};
  block.values.fill(value);
  return block;
}

}  // namespace

TEST_CASE("a field gives its blocks', its tiles' and else the background's values") {
  FieldBlock block = block_at({-8, 0, 16}, 2.0f);
  block.values[FieldBlock::at({-7, 3, 21})] = 5.0f;
  const ScalarField field({}, 1.0f, {block, block_at({0, 0, 0}, 3.0f)},
                          {{{-128, 0, -128}, 128, 4.0f}, {{8, 0, 0}, 8, 6.0f}});
  CHECK(field.at({-7, 3, 21}) == 5.0f);
  CHECK(field.at({-8, 0, 16}) == 2.0f);
  CHECK(field.at({-1, 7, 23}) == 2.0f);
  CHECK(field.at({-1, 7, 24}) == 1.0f);
  CHECK(field.at({7, 7, 7}) == 3.0f);
  CHECK(field.at({15, 7, 0}) == 6.0f);
  CHECK(field.at({16, 7, 0}) == 1.0f);
  CHECK(field.at({-128, 0, -128}) == 4.0f);
  CHECK(field.at({-1, 127, -1}) == 4.0f);
  CHECK(field.at({-1, 128, -1}) == 1.0f);
  CHECK(field.at({1 << 30, -(1 << 30), 7}) == 1.0f);
}

TEST_CASE("a field that is not one is refused") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  CHECK(holds(refusal([&] { ScalarField({}, nan, {}); }), "expected finite values, found nan"));
  CHECK(holds(refusal([&] { ScalarField({}, 1, {block_at({0, 0, 0}, infinite)}); }), "finite values, found inf"));
  CHECK(holds(refusal([&] { ScalarField({}, 1, {}, {{{0, 0, 0}, 8, nan}}); }), "finite values"));
  CHECK(holds(refusal([&] { ScalarField({}, 1, {block_at({4, 0, 0}, 1)}); }), "multiples of their side"));
  CHECK(holds(refusal([&] { ScalarField({}, 1, {block_at({1 << 23, 0, 0}, 1)}); }), "within 2^22"));
  CHECK(holds(refusal([&] { ScalarField({}, 1, {block_at({0, 0, 0}, 1), block_at({0, 0, 0}, 2)}); }), "once"));
  CHECK(holds(refusal([&] { ScalarField({}, 1, {block_at({0, 0, 0}, 1)}, {{{0, 0, 0}, 128, 1}}); }), "within a tile"));
  CHECK(holds(refusal([&] { ScalarField({}, 1, {}, {{{0, 0, 0}, 12, 1}}); }), "power of two"));
  CHECK(holds(refusal([&] { ScalarField({0.0, {}}, 1, {}); }), "voxel size above 0"));
  CHECK(holds(refusal([&] { ScalarField({1.0, {{1e10, 0, 0}}}, 1, {}); }), "at most 1e9"));
}

TEST_CASE("a volume has an inside, and an end") {
  const auto field = std::make_shared<const ScalarField>(ScalarField({}, 1, {block_at({0, 0, 0}, -1)}));
  CHECK(holds(refusal([&] { make_volume(field, 2.0, true); }), "expected the background outside"));
  CHECK(holds(refusal([&] { make_volume(field, 0.5, false); }), "expected the background outside"));
  CHECK(holds(refusal([&] { make_volume(field, -1.0, true); }), "expected a value below -1"));
  CHECK(holds(refusal([&] { make_volume(field, 1.0, false); }), "expected a value above 1"));
  CHECK(holds(refusal([&] { make_volume(field, std::nan(""), true); }), "finite"));
  // Where the background is the value itself it is outside: a fog volume above 0.
  const auto fog = std::make_shared<const ScalarField>(ScalarField({}, 0, {block_at({0, 0, 0}, 1)}));
  const Volume volume = make_volume(fog, 0.0, false);
  CHECK(interior_holds(volume, {}, {-0.5, 3, 3}));
  CHECK_FALSE(interior_holds(volume, {}, {-1.0, 3, 3}));
  CHECK(interior_holds(volume, {}, {7.999, 7.999, 7.999}));
  CHECK_FALSE(interior_holds(volume, {{1e6, 0, 0}}, {-0.5, 3, 3}));
}

TEST_CASE("inside points: any and all of a box, against one by one") {
  std::mt19937_64 random(11);
  for (int round = 0; round < 200; ++round) {
    const Volume volume = random_volume(random, 1.0);
    const InsidePoints& points = *volume.body->points;
    const VolumeTruth truth(volume, {});
    for (int i = 0; i < 30; ++i) {
      const auto any_int = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
      const LatticePoint first(any_int(60) - 30, any_int(60) - 30, any_int(60) - 30);
      const int most = i % 3 == 0 ? 1 : 12;
      const LatticeBox box{first, first + LatticePoint(any_int(most), any_int(most), any_int(most))};
      bool any = false, all = true;
      truth.for_points(box, [&](double depth) {
        any = any || depth < 0.0;
        all = all && depth < 0.0;
      });
      CHECK(points.any(box) == any);
      CHECK(points.all(box) == all);
    }
  }
}

TEST_CASE("what is inside a large tile is found without walking it") {
  const auto field = std::make_shared<const ScalarField>(
      ScalarField({}, 1, {block_at({-8, 0, 0}, -1)}, {{{0, 0, 0}, 1 << 20, -1.0f}}));
  const Volume volume = make_volume(field, 0.0, true);
  const InsidePoints& points = *volume.body->points;
  CHECK(points.bounds().last.x == (1 << 20) - 1);
  CHECK(points.any({{-8000, -8000, -8000}, {1 << 21, 1 << 21, 1 << 21}}));
  CHECK(points.any({{1 << 19, 5, 5}, {1 << 20, 6, 6}}));
  CHECK_FALSE(points.any({{1 << 20, 5, 5}, {1 << 21, 6, 6}}));
  CHECK(points.all({{-8, 0, 0}, {40, 7, 7}}));
  CHECK_FALSE(points.all({{-8, 0, 0}, {40, 8, 7}}));
}

TEST_CASE("the polyhedron about a volume holds it, the boxes within lie in it") {
  std::mt19937_64 random(5);
  int boxes = 0;
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    const Volume volume = random_volume(random, 1.0);
    const Pose pose = round % 3 == 0 ? Pose{} : random_pose(random);
    const VolumeTruth truth(volume, pose);
    const ViewVolume everywhere(View{}, 3);
    const LatticeBox bounds = volume.body->points->bounds();
    const std::vector<Vec3> outer = world_vertices(volume, pose);
    CHECK(outer.size() >= 4);
    CHECK(outer.size() <= 64);
    for (int i = 0; i < 200; ++i) {
      Vec3 q;
      for (int k = 0; k < 3; ++k) q[k] = uniform(random, bounds.first[k] - 1.0, bounds.last[k] + 1.0);
      const Vec3 world = truth.world(q);
      const double depth = truth.depth(world);
      if (depth < -1e-9) {
        CHECK(interior_holds(volume, pose, world));
        // No plane parts it from the corners.
        for (int d = 0; d < 10; ++d) {
          const Vec3 way(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
          double most = -1e300;
          for (const Vec3& p : outer) most = std::max(most, glm::dot(way, p));
          CHECK(glm::dot(way, world) <= most);
        }
      }
      if (depth > 1e-9) CHECK_FALSE(interior_holds(volume, pose, world));
    }
    for (const LatticeBox& box : volume.body->inner) {
      ++boxes;
      for (int k = 0; k < 3; ++k) CHECK(box.first[k] < box.last[k]);
      truth.for_points(box, [](double depth) { CHECK(depth < 0.0); });
      for (const Vec3& corner : inner_corners(volume, box)) {
        CHECK(interior_holds(volume, pose, to_world(pose, rotation_of(pose.orientation), corner)));
      }
    }
  }
  CHECK(boxes > 300);
}

TEST_CASE("few boxes fill most of a ball") {
  for (const int radius : {6, 20, 100}) {
    const auto field = std::make_shared<const ScalarField>(
        field_of({}, 1.0f, LatticePoint(-radius), LatticePoint(radius),
                 [&](const LatticePoint& p) { return static_cast<float>(glm::length(Vec3(p)) - radius + 0.5); }));
    const Volume volume = make_volume(field, 0.0, true);
    const auto& inner = volume.body->inner;
    CHECK(inner.size() <= 64);
    REQUIRE_FALSE(inner.empty());
    int held = 0, all = 0;
    LatticePoint c;
    for (c.x = -radius; c.x <= radius; ++c.x) {
      for (c.y = -radius; c.y <= radius; ++c.y) {
        for (c.z = -radius; c.z <= radius; c.z += 5) {
          const Vec3 p = Vec3(c) + 0.5;
          if (glm::length(p) > radius - 0.5) continue;
          ++all;
          for (const LatticeBox& b : inner) {
            if (glm::all(glm::lessThan(Vec3(b.first), p)) && glm::all(glm::lessThan(p, Vec3(b.last)))) {
              ++held;
              break;
            }
          }
        }
      }
    }
    MESSAGE("radius " << radius << ": " << inner.size() << " boxes hold " << 100.0 * held / all << " %");
    CHECK(held > 0.6 * all);
  }
}
