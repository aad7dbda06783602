// Eight balls placed together (grid/mask_batch_body.h) are what they would be one by one, with every instruction set.
#include <cstring>

#include <doctest/doctest.h>

#include "mask_truth.h"

using namespace gridcull;
using namespace mask_truth;

namespace {

constexpr double rounding = 0x1p-46;

InstructionSet some_set(Dice& dice) {
  const auto set = static_cast<InstructionSet>(dice.integer(0, 2));
  return is_supported(set) ? set : InstructionSet::scalar;
}

struct World {
  View view;
  masking::Outlook outlook{};
  masking::Balls balls;
};

View view_of(std::uint64_t seed, Dice& dice) {
  View view;
  view.pose.position = dice.power(-1, 4) * dice.direction();
  if (seed % 3 == 0) return view;
  view.frustum = Frustum{dice.real(0.1, 2.0), dice.real(0.5, 2.0)};
  const Vec3 axis = dice.direction();
  const double turn = dice.real(0, 3);
  view.pose.orientation = {std::cos(turn), std::sin(turn) * axis.x, std::sin(turn) * axis.y, std::sin(turn) * axis.z};
  return view;
}

World random_world(std::uint64_t seed, const CoverageMask& mask, const View& view, Dice& dice) {
  World world{view, {}, {}};
  masking::Outlook& from = world.outlook;
  mask.set_outlook(from);
  const Vec3& apex = view.pose.position;
  for (int k = 0; k < 3; ++k) from.apex[k] = apex[k];
  from.apex_size = std::fabs(apex.x) + std::fabs(apex.y) + std::fabs(apex.z);
  from.rounding = rounding;
  const double size = dice.power(-1, 3);
  from.limit = dice.chance(0.5) ? size * 1.2 : std::numeric_limits<double>::infinity();
  world.balls.count = seed % 5 == 0 ? dice.integer(1, 7) : 8;
  for (int k = 0; k < world.balls.count; ++k) {
    const Vec3 centre = apex + size * dice.power(-1, 0.5) * glm::normalize(some_direction(mask, dice));
    world.balls.x[k] = centre.x, world.balls.y[k] = centre.y, world.balls.z[k] = centre.z;
    world.balls.radius[k] = size * dice.power(-3, 0);
    const bool upright = dice.chance(0.5);
    world.balls.wide[k] = upright ? dice.integer(1, 255) : -1.0;
    world.balls.tall[k] = upright ? dice.integer(1, 255) : 255.0;
  }
  return world;
}

/// What the walk asked of a ball before there were batches.
struct Alone {
  Vec3 centre, half;
  double grown, key;
  bool upright;
};

Alone alone(const World& world, int k) {
  const Vec3 place(world.balls.x[k], world.balls.y[k], world.balls.z[k]);
  const double radius = world.balls.radius[k];
  Alone a{place - world.view.pose.position, Vec3(0.0), 0.0, 0.0, world.balls.wide[k] >= 0.0};
  const double size = std::fabs(place.x) + std::fabs(place.y) + std::fabs(place.z);
  a.grown = radius + rounding * (world.outlook.apex_size + size + radius);
  a.half = Vec3(a.grown);
  a.key = glm::length(a.centre) - a.grown;
  if (!a.upright) return a;
  const double part = radius * (1.0 / 255.0), blur = a.grown - radius;
  const double wide = part * world.balls.wide[k] + blur, tall = part * world.balls.tall[k] + blur;
  a.half = {wide, wide, tall};
  const double flat = std::sqrt(a.centre.x * a.centre.x + a.centre.y * a.centre.y);
  const double beside = std::max(0.0, flat - wide), above = std::max(0.0, std::fabs(a.centre.z) - tall);
  a.key = std::max(a.key, std::sqrt(beside * beside + above * above));
  return a;
}

bool open_alone(const CoverageMask& mask, const Alone& a) {
  return a.upright ? mask.open_box(a.centre - a.half, a.centre + a.half) : mask.open_about_ball(a.centre, a.grown);
}

bool same(const masking::Batch& a, const masking::Batch& b, int k) {
  return std::memcmp(&a.key[k], &b.key[k], sizeof(double)) == 0 && a.face[k] == b.face[k] && a.x0[k] == b.x0[k] &&
         a.x1[k] == b.x1[k] && a.y0[k] == b.y0[k] && a.y1[k] == b.y1[k] && a.wide[k] == b.wide[k] &&
         a.tall[k] == b.tall[k] && a.x[k] == b.x[k] && a.y[k] == b.y[k] && a.z[k] == b.z[k];
}

}  // namespace

TEST_CASE("mask batch: keys and first tests are those of one ball alone") {
  int single = 0, hidden = 0, kept = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    const View view = view_of(seed, dice);
    CoverageMask mask(some_set(dice));
    static constexpr int resolutions[] = {16, 72, 128, 328};
    mask.begin(ViewVolume(view, 3), resolutions[dice.integer(0, 3)]);
    for (int i = dice.integer(0, 8); i > 0; --i) cover(mask, random_cone(mask, dice), dice);
    const World world = random_world(seed, mask, view, dice);
    masking::Batch batch;
    mask.place_balls(world.outlook, world.balls, batch);
    CHECK((batch.kept >> world.balls.count) == 0u);
    for (int k = 0; k < world.balls.count; ++k) {
      CAPTURE(k);
      const Alone a = alone(world, k);
      const bool wanted = a.key <= world.outlook.limit && !mask.beyond_window(a.centre, a.grown);
      REQUIRE((batch.kept >> k & 1) == static_cast<unsigned>(wanted));
      if (!wanted) continue;
      ++kept;
      CHECK(batch.key[k] == a.key);
      CHECK(Vec3(batch.x[k], batch.y[k], batch.z[k]) == a.centre);
      CHECK(Vec3(batch.wide[k], batch.wide[k], batch.tall[k]) == a.half);
      if ((batch.single >> k & 1) == 0) continue;
      ++single;
      const bool open = mask.open_pixels(batch.face[k], {batch.x0[k], batch.x1[k], batch.y0[k], batch.y1[k]});
      REQUIRE(open == open_alone(mask, a));
      hidden += !open;
    }
  }
  MESSAGE(kept << " kept, " << single << " placed, " << hidden << " hidden");
  CHECK(single > 5000);
  CHECK(hidden > 500);
}

TEST_CASE("mask batch: every instruction set gives the same bits") {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    const View view = view_of(seed, dice);
    CoverageMask first(InstructionSet::scalar);
    first.begin(ViewVolume(view, 3), 128);
    const World world = random_world(seed, first, view, dice);
    masking::Batch expected;
    first.place_balls(world.outlook, world.balls, expected);
    for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
      if (!is_supported(set)) continue;
      CoverageMask mask(set);
      mask.begin(ViewVolume(view, 3), 128);
      masking::Batch batch;
      mask.place_balls(world.outlook, world.balls, batch);
      REQUIRE(batch.kept == expected.kept);
      REQUIRE((batch.single & batch.kept) == (expected.single & expected.kept));
      for (int k = 0; k < 8; ++k) {
        if ((batch.kept & batch.single) >> k & 1) REQUIRE(same(batch, expected, k));
      }
    }
  }
}
