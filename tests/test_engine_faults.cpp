// Faults that a review found: sources that throw, riders that stop riding, numbers out of the contract.
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/grid/engine.h"

namespace gridcull::test {
namespace {

/// A source whose connection breaks now and then.
class BrokenSource final : public PositionSource {
 public:
  Pose pose(ObjectId object) override {
    if (broken) throw std::runtime_error("no connection");
    return poses.at(object);
  }
  std::map<ObjectId, Pose> poses;
  bool broken = false;
};

constexpr std::array modes{TbvMode::off, TbvMode::solid, TbvMode::hollow};

}  // namespace

TEST_CASE("a source that throws costs its frame and nothing else") {
  for (const TbvMode mode : modes) {
    GridOptions options;
    options.hiding = Hiding::voxel;
    options.bounds = {{0, 0, 0}, {128, 128, 0}};
    options.tbv = mode;
    GridEngine engine(options);
    std::vector<Object> world{make_static(0, Rectangle{{6, 70}}, {32, 35, 0})};
    engine.add(world[0]);
    BrokenSource source;
    for (ObjectId id = 1; id <= 20; ++id) {
      world.push_back(make_object(id, Disc{0.3}, {60, 10.0 + id, 0}, 1.0));
      source.poses[id] = world.back().pose;
      engine.add(world.back());
    }
    engine.set_source(&source);
    const std::vector<View> views{make_view(1, {8.5, 64.5, 0})};
    Answers answers;
    int failed = 0;
    for (int frame = 0; frame < 250; ++frame) {
      for (ObjectId id = 1; id <= 20; ++id) {
        if (world[id].pose.position.y < 120) world[id].pose.position.y += 0.48;
        source.poses[id] = world[id].pose;
      }
      source.broken = frame % 7 == 5;
      try {
        engine.query(0.5 * (frame + 1), views, answers);
      } catch (const std::runtime_error&) {
        ++failed;
        continue;
      }
      for (const ObjectId id : exact_visible_2d(world, views[0]).visible) {
        CAPTURE(frame);
        CAPTURE(id);
        CHECK(sees(answers.views[0], id));
      }
    }
    CHECK(failed > 0);
  }
}

TEST_CASE("objects that come and go while a source is down leave nothing behind") {
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    GridEngine engine(
        {.dimension = dimension, .bounds = {{0, 0, 0}, {60, 60, dimension == 3 ? 30.0 : 0.0}}, .cell = 1.0});
    const Shape wall = dimension == 2 ? Shape(Rectangle{{2, 50}}) : Shape(Cuboid{{2, 50, 60}});
    const Shape ball = dimension == 2 ? Shape(Disc{0.5}) : Shape(Sphere{0.5});
    const double z = dimension == 3 ? 15.0 : 0.0;
    engine.add(make_static(0, wall, {30, 30, z}));
    engine.add(make_object(1, ball, {50, 30, z}, 1.0));
    BrokenSource source;
    source.poses[1].position = {50, 30, z};
    engine.set_source(&source);
    Answers answers;
    double time = 0.0;
    const std::vector<View> views{make_view(1, {5, 30, z})};
    engine.query(++time, views, answers);
    source.broken = true;
    const auto frames = [&](int count) {
      for (int i = 0; i < count; ++i) {
        engine.add(make_static(2, ball, {10, 10, z}));
        engine.move(2, {{10, 11, z}});
        engine.add(make_object(3, ball, {10, 20, z}, 1.0));
        engine.move(3, {{10, 21, z}});
        time += 100.0;  // the hidden one is to be read
        CHECK_THROWS_AS(engine.query(time, views, answers), std::runtime_error);
        engine.remove(2);
        engine.remove(3);
      }
      return engine.memory().total();
    };
    const std::uint64_t before = frames(100);
    CHECK(frames(3000) == before);
  }
}

TEST_CASE("a rider that walked into the outline around its own object sees it once it gets off") {
  for (const TbvMode mode : modes) {
    GridOptions options;
    options.hiding = Hiding::voxel;
    options.bounds = {{0, 0, 0}, {100, 100, 0}};
    options.tbv = mode;
    GridEngine engine(options);
    engine.add(make_object(9, Rectangle{{20.0, 0.2}}, {50.5, 50.5, 0}, 0.0));
    Answers answers;
    View view = make_view(1, {50.5, 80.5, 0});
    view.range = 5;
    view.rides = 9;
    double time = 0;
    for (; view.pose.position.y > 52; view.pose.position.y -= 1) {
      engine.query(++time, std::vector<View>{view}, answers);
      CHECK(answers.views[0].visible.empty());
    }
    view.rides = no_id;
    engine.query(++time, std::vector<View>{view}, answers);
    CHECK(sees(answers.views[0], 9));
  }
}

TEST_CASE("a new source is believed at once, and hidden objects are looked at again") {
  for (const TbvMode mode : modes) {
    GridOptions options;
    options.hiding = Hiding::voxel;
    options.bounds = {{0, 0, 0}, {128, 128, 0}};
    options.tbv = mode;
    GridEngine engine(options);
    engine.add(make_static(0, Rectangle{{6, 70}}, {32, 35, 0}));
    engine.add(make_object(1, Disc{0.5}, {60, 20, 0}, 0.0));
    const std::vector<View> views{make_view(1, {8.5, 20.5, 0})};
    Answers answers;
    for (int frame = 1; frame <= 5; ++frame) {
      engine.query(frame, views, answers);
      CHECK(!sees(answers.views[0], 1));
    }
    BrokenSource source;
    source.poses[1] = Pose{{20, 20, 0}, {}};
    engine.set_source(&source);
    engine.query(6, views, answers);
    CHECK(sees(answers.views[0], 1));
  }
}

TEST_CASE("views and poses outside the contract are refused, not answered") {
  GridOptions options;
  options.hiding = Hiding::voxel;
  options.dimension = 3;
  options.bounds = {{0, 0, 0}, {32, 32, 32}};
  GridEngine engine(options);
  engine.add(make_object(1, Sphere{1}, {24, 16, 16}));
  Answers answers;
  View view = make_view(1, {8.5, 16.5, 16.5});
  view.frustum = Frustum{std::nextafter(std::numbers::pi, 0.0), 1e300};
  CHECK_THROWS_AS(engine.query(1, std::vector<View>{view}, answers), Error);
  view.frustum = Frustum{};
  view.pose.orientation.w = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(engine.query(1, std::vector<View>{view}, answers), Error);
  view.pose.orientation = {};
  CHECK_NOTHROW(engine.query(1, std::vector<View>{view}, answers));
  CHECK(sees(answers.views[0], 1));

  options.dimension = 2;
  GridEngine plane(options);
  CHECK_THROWS_AS(plane.add(make_object(1, Disc{1}, {24, 16, 50})), Error);
  plane.add(make_object(1, Disc{1}, {24, 16, 0}));
  CHECK_THROWS_AS(plane.move(1, Pose{{24, 16, 50}, {}}), Error);
  CHECK_THROWS_AS(plane.query(1, std::vector<View>{make_view(1, {8, 8, 1})}, answers), Error);
}

}  // namespace gridcull::test
