// 3D discretisation against a brute-force classifier (cover_truth.h).
#include "cover_check.h"
#include "gridcull/core/error.h"
#include "random_meshes.h"

using namespace gridcull;
using cover_check::compare;
using cover_check::Findings;
using cover_check::Random;

namespace {

constexpr double tolerance = 1e-9;

Lattice random_lattice(Random& random) {
  const double cell = random.one_in(2) ? 1.0 : random.in(0.5, 2.0);
  const Vec3 low(random.coordinate(-10, 5), random.coordinate(-10, 5), random.coordinate(-10, 5));
  const Vec3 size = cell * Vec3(1 + random.below(11), 1 + random.below(11), 1 + random.below(11));
  return Lattice(3, {low, low + size}, cell, std::uint64_t{1} << 30);
}

double random_size(Random& random) {
  if (random.one_in(10)) return random.in(1e-5, 0.2);
  if (random.one_in(12)) return random.in(20.0, 500.0);
  return random.coordinate(0.25, 8.0) + 0.01;
}

Vec3 random_point(Random& random, double reach) {
  return {random.coordinate(-reach, reach), random.coordinate(-reach, reach), random.coordinate(-reach, reach)};
}

std::vector<Vec3> random_points(Random& random, int least, int more) {
  const double reach = random_size(random);
  std::vector<Vec3> points;
  const int count = least + random.below(more);
  for (int i = 0; i < count; ++i) points.push_back(random_point(random, reach));
  return points;
}

Prism random_prism(Random& random) {
  Prism p{{}, random_size(random)};
  for (const Vec3& v : random_points(random, 3, 7)) p.vertices.emplace_back(v);
  return p;
}

Faces random_faces(Random& random) {
  Faces f{random_points(random, 3, 6), {}};
  f.triangles.push_back({0, 1, 2});
  for (int i = random.below(5); i > 0; --i) {
    const auto any = [&] { return static_cast<std::uint32_t>(random.below(static_cast<int>(f.vertices.size()))); };
    f.triangles.push_back({any(), any(), any()});
  }
  return f;
}

/// Mostly inside the lattice, sometimes beside it or far away.
Pose random_pose(Random& random, const Lattice& lattice) {
  const double away = random.one_in(6) ? 20.0 : 0.5;
  const Bounds box = lattice.box();
  return {{random.coordinate(box.min.x - away, box.max.x + away), random.coordinate(box.min.y - away, box.max.y + away),
           random.coordinate(box.min.z - away, box.max.z + away)},
          random.turn()};
}

bool valid(const Shape& shape) {
  try {
    validate(shape);
    return true;
  } catch (const Error&) {
    return false;
  }
}

struct Totals {
  int touched = 0, opaque = 0;
};

/// Runs `count` random covers of shapes made by `make`; `exact` asks for tightness too.
template <class Make, class Exact>
Totals run(std::uint64_t first_seed, int count, const Make& make, const Exact& exact) {
  CoverScratch scratch;
  Cover cover;
  Totals totals;
  for (std::uint64_t seed = first_seed; seed < first_seed + static_cast<std::uint64_t>(count); ++seed) {
    Random random(seed);
    const Lattice lattice = random_lattice(random);
    const Shape shape = make(random);
    if (!valid(shape)) continue;
    const Pose pose = random_pose(random, lattice);
    PreparedShape(shape).cover(lattice, pose, scratch, cover);
    const Findings f = compare(lattice, shape, pose, cover, tolerance);
    totals.touched += f.touched;
    totals.opaque += f.opaque;
    INFO("seed ", seed, ", ", name_of(shape), ": ", f.text());
    CHECK(f.safe());
    if (cover_check::reaches_beyond(lattice, shape, pose, tolerance)) CHECK(cover.outside);
    if (exact(pose)) CHECK(f.tight());
    if (exact(pose) && cover.outside) CHECK(cover_check::reaches_beyond(lattice, shape, pose, -tolerance));
    if (is_thin(shape)) CHECK(f.opaque == 0);
  }
  return totals;
}

bool always(const Pose&) { return true; }
bool upright(const Pose& pose) { return std::abs(rotation_of(pose.orientation).z.z) == 1.0; }

}  // namespace

TEST_CASE("covers of spheres are exact") {
  const Totals t = run(
      1, 800, [](Random& r) { return Shape(Sphere{random_size(r)}); }, always);
  CHECK(t.touched > 2500);
  CHECK(t.opaque > 5000);
}

TEST_CASE("covers of oriented boxes are exact") {
  const auto make = [](Random& r) { return Shape(Cuboid{{random_size(r), random_size(r), random_size(r)}}); };
  const Totals t = run(10001, 500, make, always);
  CHECK(t.touched > 2500);
  CHECK(t.opaque > 500);
}

TEST_CASE("covers of convex hulls are exact") {
  const auto make = [](Random& r) { return Shape(Convex{random_points(r, 4, 6)}); };
  const Totals t = run(20001, 300, make, always);
  CHECK(t.touched > 2500);
  CHECK(t.opaque > 500);
}

TEST_CASE("covers of upright prisms are exact, those of tilted ones are safe") {
  const Totals t = run(
      30001, 500, [](Random& r) { return Shape(random_prism(r)); }, upright);
  CHECK(t.touched > 2500);
  CHECK(t.opaque > 500);
}

TEST_CASE("covers of faces are exact and never opaque") {
  const Totals t = run(
      40001, 500, [](Random& r) { return Shape(random_faces(r)); }, always);
  CHECK(t.touched > 2500);
}

TEST_CASE("covers of closed meshes are exact") {
  const auto make = [](Random& r) {
    std::mt19937_64 random(static_cast<std::uint64_t>(r.below(1 << 30)));
    return Shape(test::random_mesh(random, random_size(r)));
  };
  const Totals t = run(50001, 400, make, always);
  CHECK(t.touched > 2500);
  CHECK(t.opaque > 500);
}
