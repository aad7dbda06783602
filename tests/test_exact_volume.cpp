// The reference's stretches of rays in volumes, against samples along them.
#include <cmath>

#include <doctest/doctest.h>

#include "gridcull/core/exact.h"
#include "gridcull/core/exact_3d_volume.h"
#include "gridcull/core/volume.h"
#include "random_volumes.h"
#include "volume_truth.h"

using namespace gridcull;
using test::field_of;
using test::random_volume;
using test::VolumeTruth;

namespace {

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 any(std::mt19937_64& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

bool within(const std::vector<exact::Stretch>& stretches, double t) {
  for (const auto& s : stretches) {
    if (t > s.begin && t < s.end) return true;
  }
  return false;
}

/// A ball of this radius in metres, a level set of edge 1 / 10.
Volume ball(double radius) {
  const int n = static_cast<int>(radius * 10) + 4;
  auto field = field_of({0.1, {}}, 1.0f, LatticePoint(-n), LatticePoint(n),
                        [&](const LatticePoint& p) { return static_cast<float>(0.1 * glm::length(Vec3(p)) - radius); });
  return make_volume(std::make_shared<const ScalarField>(std::move(field)), 0.0, true);
}

}  // namespace

TEST_CASE("along a ray a volume begins and ends where its value does") {
  std::mt19937_64 random(3);
  int inside = 0, beside = 0;
  for (int round = 0; round < 400; ++round) {
    CAPTURE(round);
    const Volume volume = random_volume(random, 1.0);
    Pose pose{any(random, 3.0), normalised({1.2, uniform(random, -1, 1), uniform(random, -1, 1), 0.3})};
    if (round % 4 == 0) pose = {};
    const exact::RayVolume rays(volume, pose);
    const VolumeTruth truth(volume, pose);
    for (int i = 0; i < 20; ++i) {
      const LatticeBox box = volume.body->points->bounds();
      Vec3 from = any(random, 4.0);
      Vec3 to = truth.world(0.5 * (Vec3(box.first) + Vec3(box.last)) +
                            0.6 * any(random, 1.0) * Vec3(box.last - box.first + LatticePoint(2)));
      if (i % 5 == 0) {  // along the lattice's own points and lines
        from = truth.world(Vec3(box.first) + Vec3(0, 0, -7)), to = truth.world(Vec3(box.first));
      }
      const Vec3 ray = glm::normalize(to - from);
      std::vector<exact::Stretch> stretches;
      rays.add_stretches(from, ray, stretches);
      for (std::size_t k = 0; k < stretches.size(); ++k) {
        CHECK(stretches[k].begin < stretches[k].end);
        if (k > 0) CHECK(stretches[k].begin > stretches[k - 1].end);
      }
      for (int s = 0; s < 400; ++s) {
        const double t = uniform(random, -6.0, 12.0);
        const double depth = truth.depth(from + t * ray);
        if (std::fabs(depth) < 1e-9) continue;
        CHECK(within(stretches, t) == (depth < 0.0));
        ++(depth < 0.0 ? inside : beside);
      }
    }
    for (const Vec3& p : rays.inside_points()) CHECK(rays.surely_inside(p));
  }
  CHECK(inside > 100000);
  CHECK(beside > 100000);
}

TEST_CASE("a ball of voxels is met where the ball is") {
  const Volume volume = ball(2.0);
  const exact::RayVolume rays(volume, {{10, 0, 0}});
  std::vector<exact::Stretch> stretches;
  rays.add_stretches({0, 0, 0}, {1, 0, 0}, stretches);
  REQUIRE(stretches.size() == 1);
  CHECK(stretches[0].begin == doctest::Approx(8.0).epsilon(0.001));
  CHECK(stretches[0].end == doctest::Approx(12.0).epsilon(0.001));
  CHECK(rays.surely_inside({10, 1.9, 0}));
  CHECK_FALSE(rays.surely_inside({10, 2.1, 0}));
}

TEST_CASE("the reference sees a volume, past one and through the hole of a ring") {
  if (!ExactRays::available()) return;
  auto ring_field = field_of({0.1, {}}, 3.0f, LatticePoint(-34), LatticePoint(34), [](const LatticePoint& p) {
    return static_cast<float>(std::hypot(std::hypot(0.1 * p.y, 0.1 * p.z) - 2.0, 0.1 * p.x) - 1.0);
  });
  const Volume ring = make_volume(std::make_shared<const ScalarField>(std::move(ring_field)), 0.0, true);
  const auto sphere = [](ObjectId id, const Vec3& at, double radius) {
    Object o{id, Sphere{radius}, {at}};
    o.is_static = true;
    return o;
  };
  std::vector<Object> world{{1, ring, {{10, 0, 0}}}, sphere(2, {20, 0, 0}, 0.3), sphere(3, {20, 4, 0}, 0.3)};
  View view;
  view.viewer = 1;
  CHECK(ExactRays(world, 64).visible(view).visible == std::vector<ObjectId>{1, 2});
  world[0].shape = ball(2.5);
  CHECK(ExactRays(world, 64).visible(view).visible == std::vector<ObjectId>{1});
  CHECK_FALSE(ExactRays(world, 64).confirm(view, 2, {1, 0, 0}));
  CHECK(ExactRays(world, 64).confirm(view, 1, {1, 0, 0}));
  // From within it is reported, and hides nothing.
  view.pose.position = {9, 0, 0};
  CHECK(ExactRays(world, 64).visible(view).visible == std::vector<ObjectId>{1, 2, 3});
}
