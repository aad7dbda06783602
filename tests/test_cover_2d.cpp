// 2D discretisation against a brute-force classifier (cover_truth.h).
#include <numbers>

#include "cover_check.h"
#include "gridcull/core/error.h"

using namespace gridcull;
using cover_check::compare;
using cover_check::Findings;
using cover_check::Random;

namespace {

constexpr double tolerance = 1e-9;

Lattice random_lattice(Random& random) {
  const double cell = random.one_in(2) ? 1.0 : random.in(0.3, 2.5);
  const Vec3 low(random.coordinate(-20, 5), random.coordinate(-20, 5), 0.0);
  const Vec3 size(cell * (1 + random.below(40)), cell * (1 + random.below(40)), 0.0);
  return Lattice(2, {low, low + size}, cell, std::uint64_t{1} << 30);
}

/// Mostly of the lattice's size; sometimes far below a cell, sometimes far above the lattice.
double random_size(Random& random) {
  if (random.one_in(8)) return random.in(1e-6, 0.2);
  if (random.one_in(10)) return random.in(30.0, 3000.0);
  return random.coordinate(0.25, 15.0) + 0.01;
}

std::vector<Vec2> random_chain(Random& random, std::size_t least) {
  std::vector<Vec2> points;
  const std::size_t count = least + static_cast<std::size_t>(random.below(9));
  const double reach = random_size(random);
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 1 && random.one_in(10)) {
      points.push_back(points[i - 2]);  // a spike without width
    } else {
      points.emplace_back(random.coordinate(-reach, reach), random.coordinate(-reach, reach));
    }
  }
  return points;
}

Shape random_shape(Random& random) {
  switch (random.below(4)) {
    case 0: return Disc{random_size(random)};
    case 1: return Rectangle{{random_size(random), random_size(random)}};
    case 2: return Polygon{random_chain(random, 3)};
    default: return Polyline{random_chain(random, 2)};
  }
}

/// Mostly inside the lattice, sometimes beside it or far away.
Pose random_pose(Random& random, const Lattice& lattice) {
  const double away = random.one_in(6) ? 40.0 : 1.0;
  const Bounds box = lattice.box();
  Pose pose;
  pose.position = {random.coordinate(box.min.x - away, box.max.x + away),
                   random.coordinate(box.min.y - away, box.max.y + away), 0.0};
  if (!random.one_in(3)) pose.orientation = turn_about_z(random.in(-4.0, 4.0));
  if (random.one_in(4)) pose.orientation = turn_about_z(0.5 * std::numbers::pi * random.below(4));
  return pose;
}

bool valid(const Shape& shape) {
  try {
    validate(shape);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

TEST_CASE("2D covers hold every touched cell and only opaque cells, and no others") {
  CoverScratch scratch;
  Cover cover;
  int touched = 0, opaque = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Random random(seed);
    const Lattice lattice = random_lattice(random);
    const Shape shape = random_shape(random);
    if (!valid(shape)) continue;
    const Pose pose = random_pose(random, lattice);
    PreparedShape(shape).cover(lattice, pose, scratch, cover);
    const Findings f = compare(lattice, shape, pose, cover, tolerance);
    touched += f.touched;
    opaque += f.opaque;
    INFO("seed ", seed, ", ", name_of(shape), ": ", f.text());
    CHECK(f.safe());
    if (cover_check::reaches_beyond(lattice, shape, pose, tolerance)) CHECK(cover.outside);
    CHECK(f.tight());
    if (cover.outside) CHECK(cover_check::reaches_beyond(lattice, shape, pose, -tolerance));
    if (is_thin(shape)) CHECK(f.opaque == 0);
  }
  CHECK(touched > 100000);
  CHECK(opaque > 20000);
}
