// Temporal bounding volumes by counts: what they save, and that nobody is overlooked for it.
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/grid/engine.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

constexpr ObjectId movers = 2000;
constexpr double frame_seconds = 0.1;
constexpr double greatest_speed = 1.0;  // metres a second

const std::vector<View> west{make_view(1, {8.5, 64.5, 0})};

GridOptions hall(TbvMode tbv, Hiding hiding = Hiding::voxel) {
  GridOptions o;
  o.hiding = hiding;
  o.bounds = {{0, 0, 0}, {128, 128, 0}};
  o.tbv = tbv;
  return o;
}

/// Movers that keep to the east of a wall that cuts the world in two.
class Hall {
 public:
  explicit Hall(TbvMode tbv, Hiding hiding = Hiding::voxel) : engine(hall(tbv, hiding)) {
    engine.add(make_static(0, Rectangle{{6, 128}}, {32, 64, 0}));
    for (ObjectId id = 1; id <= movers; ++id) {
      const Pose pose{{random_.uniform(50, 120), random_.uniform(10, 118), 0}};
      world.poses[id] = pose;
      engine.add(make_object(id, Disc{0.3}, pose.position, greatest_speed));
    }
    engine.set_source(&world);
  }

  const Answers& step() {
    for (auto& [id, pose] : world.poses) {
      const Vec3 d{random_.uniform(-0.7, 0.7), random_.uniform(-0.7, 0.7), 0};
      const Vec3 p = pose.position + frame_seconds * greatest_speed * d;
      if (p.x > 45 && p.x < 125 && p.y > 5 && p.y < 123) pose.position = p;
    }
    engine.query(++frame_ * frame_seconds, west, answers);
    return answers;
  }

  GridEngine engine;
  ProbedWorld world;
  Answers answers;

 private:
  Random random_{5};
  int frame_ = 0;
};

}  // namespace

TEST_CASE("hidden movers are not read until their term ends, and terms do not end together") {
  for (const TbvMode tbv : {TbvMode::solid, TbvMode::hollow}) {
    Hall hall(tbv);
    CHECK(hall.step().stats.positions_read == movers);
    CHECK(hall.answers.stats.tbv_active == movers);
    CHECK(hall.answers.views.at(0).visible == std::vector<ObjectId>{0});
    std::uint64_t sum = 0, worst = 0;
    const int frames = 200;
    for (int f = 0; f < frames; ++f) {
      const FrameStats& stats = hall.step().stats;
      REQUIRE(hall.answers.views.at(0).visible == std::vector<ObjectId>{0});
      CHECK(stats.positions_read == stats.tbv_expired);
      CHECK(stats.tbv_active == movers);
      sum += stats.positions_read;
      worst = std::max(worst, stats.positions_read);
    }
    const double mean = static_cast<double>(sum) / frames;
    MESSAGE("positions read a frame of " << movers << " hidden: mean " << mean << ", worst " << worst);
    CHECK(mean > 0.0);
    CHECK(mean < 0.1 * movers);
    CHECK(static_cast<double>(worst) <= 2.5 * mean);
    CHECK(hall.world.reads.count(0) == 0);
  }
}

// A walk takes small groups without asking whether they are hidden: that must not count as having looked there.
TEST_CASE("cars that static blocks hide are seldom read") {
  constexpr int blocks = 10;
  constexpr double pitch = 20.0, side = blocks * pitch;
  constexpr ObjectId cars = 100;
  GridEngine engine({.dimension = 2, .bounds = {{0, 0, 0}, {side, side, 0}}, .cell = 2.0});
  Random random(3);
  ProbedWorld world;
  std::vector<Vec3> speeds;
  for (ObjectId id = 0; id < cars; ++id) {
    const bool east = random.below(2) == 0;
    const double street = pitch * random.below(blocks), along = random.uniform(0, side),
                 speed = random.uniform(5, 13.9);
    world.poses[id].position = east ? Vec3(along, street, 0) : Vec3(street, along, 0);
    speeds.push_back(speed * (east ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
    engine.add(make_object(id, Rectangle{{4.5, 1.8}}, world.poses[id].position, 14.0));
  }
  for (ObjectId i = 0; i < blocks * blocks; ++i) {
    const Vec3 middle(pitch * (static_cast<double>(i % blocks) + 0.5), pitch * (static_cast<double>(i / blocks) + 0.5),
                      0);
    engine.add(make_static(cars + i, Rectangle{{14, 14}}, middle));
  }
  engine.set_source(&world);
  Answers answers;
  std::uint64_t read = 0, seen = 0;
  constexpr int frames = 600;
  for (int frame = 0; frame < frames; ++frame) {
    for (ObjectId id = 0; id < cars; ++id) {
      Vec3& position = world.poses[id].position;
      Vec3 next = position + frame_seconds * speeds[id];
      if (next.x < 0 || next.x > side || next.y < 0 || next.y > side) speeds[id] = -speeds[id], next = position;
      position = next;
    }
    View driver = make_view(1, world.poses[0].position);
    driver.rides = 0, driver.range = 150;
    engine.query(frame_seconds * frame, std::vector{driver}, answers);
    read += answers.stats.positions_read;
    const std::vector<ObjectId>& visible = answers.views[0].visible;
    seen += static_cast<std::uint64_t>(std::lower_bound(visible.begin(), visible.end(), cars) - visible.begin());
  }
  const double mean = static_cast<double>(read) / frames;
  MESSAGE("positions read a frame of " << cars << " cars, " << seen / frames << " of them seen: " << mean);
  CHECK(mean < 0.4 * cars);
}

// Terms start alike and end alike unless they are spread; a simulator feels the worst frame, not the mean.
TEST_CASE("of a thousand frames the worst is at most twice the mean") {
  for (const Hiding hiding : {Hiding::voxel, Hiding::silhouette}) {
    Hall hall(TbvMode::solid, hiding);
    hall.step();  // everything is discretised: apart
    std::array<std::uint64_t, 2> sums{}, worst{};
    const int frames = 1000;
    for (int f = 0; f < frames; ++f) {
      const Answers& answers = hall.step();
      const WorkCounts& work = answers.views.at(0).work;
      const std::uint64_t read = answers.stats.positions_read;
      const std::uint64_t all = read + work.cells_visited + work.object_tests + work.tbv_tests + work.rasters;
      for (const auto& [k, count] : {std::pair{std::size_t{0}, read}, std::pair{std::size_t{1}, all}}) {
        sums[k] += count;
        worst[k] = std::max(worst[k], count);
      }
    }
    CAPTURE(hiding == Hiding::voxel);
    for (const std::size_t k : {0, 1}) {
      const double mean = static_cast<double>(sums[k]) / frames;
      MESSAGE(std::string(k == 0 ? "positions read" : "all work")
              << " a frame: mean " << mean << ", worst " << worst[k]);
      CHECK(mean > 0.0);
      CHECK(static_cast<double>(worst[k]) <= 2.0 * mean);
    }
  }
}

TEST_CASE("without volumes everything that moves is read in every frame") {
  Hall hall(TbvMode::off);
  for (int f = 0; f < 5; ++f) {
    CHECK(hall.step().stats.positions_read == movers);
    CHECK(hall.answers.stats.tbv_active == 0);
  }
  CHECK(hall.world.reads.size() == movers);
}

TEST_CASE("an object is read at most once a frame, however many viewers see or reveal it") {
  Hall hall(TbvMode::solid);
  hall.step();
  hall.world.reads.clear();
  std::vector<View> views;
  for (ViewerId i = 0; i < 10; ++i) views.push_back(make_view(i, {60.0 + 5 * i, 60.5, 0}));
  hall.engine.query(1000.0, views, hall.answers);
  CHECK(hall.answers.views.at(0).visible.size() > 100);
  for (const auto& [id, count] : hall.world.reads) CHECK(count == 1);
  CHECK(hall.answers.stats.positions_read == hall.world.reads.size());
}

TEST_CASE("an object without max_speed is read in every frame, a static one never") {
  GridEngine engine(hall(TbvMode::solid));
  ProbedWorld world;
  engine.add(make_static(1, Rectangle{{6, 128}}, {32, 64, 0}));
  engine.add(make_static(2, Disc{2}, {60, 60, 0}));
  engine.add(make_object(3, Disc{0.5}, {60, 70, 0}));
  engine.add(make_object(4, Disc{0.5}, {60, 50, 0}, 0.0));
  world.poses = {{3, {{60, 70, 0}}}, {4, {{60, 50, 0}}}};
  engine.set_source(&world);
  Answers answers;
  for (int f = 1; f <= 20; ++f) {
    engine.query(f, west, answers);
    CHECK(answers.views.at(0).visible == std::vector<ObjectId>{1});
  }
  CHECK(world.reads == std::map<ObjectId, int>{{3, 20}, {4, 1}});
}

TEST_CASE("who comes into sight is reported in that very frame") {
  // Walks north behind a wall that ends, at the greatest speed that it promised.
  for (const TbvMode tbv : {TbvMode::off, TbvMode::solid, TbvMode::hollow}) {
    GridEngine engine(hall(tbv));
    ProbedWorld world;
    engine.add(make_static(1, Rectangle{{6, 80}}, {40, 40, 0}));
    engine.add(make_object(2, Disc{0.25}, {60, 30, 0}, 2.0));
    engine.set_source(&world);
    Answers answers;
    const View view = make_view(1, {8.5, 40.5, 0});
    bool was_hidden = false, came = false;
    for (int f = 0; f <= 600; ++f) {
      const Vec3 p{60, 30 + 0.2 * f, 0};
      if (p.y > 125) break;
      world.poses[2] = {p};
      engine.query(0.1 * f, {&view, 1}, answers);
      // The line of sight past the wall's nearer corner (37, 80): beyond it the disc's centre shows.
      const bool surely_seen = (p.y - 40.5) / (p.x - 8.5) > (80 - 40.5) / (37 - 8.5);
      if (surely_seen) CHECK_MESSAGE(sees(answers.views.at(0), 2), "frame ", f);
      was_hidden = was_hidden || !sees(answers.views.at(0), 2);
      came = came || surely_seen;
    }
    CHECK(was_hidden);
    CHECK(came);
    if (tbv != TbvMode::off) CHECK(world.reads[2] < 450);
  }
}

TEST_CASE("jumps: pushed ones are noticed and announced ones believed, hidden or not") {
  for (const bool pull : {false, true}) {
    GridEngine engine(hall(TbvMode::solid));
    ProbedWorld world;
    engine.add(make_static(1, Rectangle{{6, 128}}, {32, 64, 0}));
    engine.add(make_object(2, Disc{0.5}, {100, 64, 0}, 0.1));
    world.poses[2] = {{100, 64, 0}};
    if (pull) engine.set_source(&world);
    Answers answers;
    engine.query(0.0, west, answers);
    engine.query(1.0, west, answers);
    CHECK(answers.stats.positions_read == 0);
    CHECK(!sees(answers.views.at(0), 2));
    world.poses[2] = {{16, 64, 0}};
    if (pull) {
      engine.announce_jump(2);
    } else {
      engine.move(2, world.poses[2]);
    }
    engine.query(2.0, west, answers);
    CHECK(answers.stats.jumps == 1);
    CHECK(sees(answers.views.at(0), 2));
    // Seen and jumping behind the wall again.
    world.poses[2] = {{100, 20, 0}};
    if (!pull) engine.move(2, world.poses[2]);
    if (pull) engine.announce_jump(2);
    engine.query(3.0, west, answers);
    CHECK(answers.stats.jumps == 1);
    CHECK(!sees(answers.views.at(0), 2));
  }
}

TEST_CASE("a pushed move inside speed and volume costs no update") {
  GridEngine engine(hall(TbvMode::solid));
  engine.add(make_static(1, Rectangle{{6, 128}}, {32, 64, 0}));
  engine.add(make_object(2, Disc{0.5}, {100, 64, 0}, 1.0));
  Answers answers;
  engine.query(0.0, west, answers);
  std::uint64_t read = 0;
  for (int f = 1; f <= 100; ++f) {
    engine.move(2, {{100 + 0.005 * f, 64, 0}});
    engine.query(0.01 * f, west, answers);
    CHECK(answers.stats.jumps == 0);
    read += answers.stats.positions_read;
  }
  CHECK(read <= 3);
}

TEST_CASE("a static object moved by hand is answered where it stands now") {
  GridEngine engine(hall(TbvMode::solid));
  engine.add(make_static(1, Rectangle{{6, 128}}, {32, 64, 0}));
  engine.add(make_static(2, Disc{1}, {100, 64, 0}));
  Answers answers;
  engine.query(0.0, west, answers);
  CHECK(answers.views.at(0).visible == std::vector<ObjectId>{1});
  engine.move(1, {{200, 64, 0}});
  engine.query(1.0, west, answers);
  CHECK(sees(answers.views.at(0), 2));
  engine.move(1, {{32, 64, 0}});
  engine.query(2.0, west, answers);
  CHECK(answers.views.at(0).visible == std::vector<ObjectId>{1});
}

}  // namespace gridcull::test
