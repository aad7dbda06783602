// The engine's side of the contract (core/culler.h): what it refuses, and that a refusal changes nothing.
#include <limits>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/core/error.h"
#include "gridcull/core/hash.h"
#include "gridcull/grid/engine.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"

namespace gridcull::test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class F>
bool refuses(ErrorCode code, F&& f) {
  try {
    f();
  } catch (const Error& error) {
    const std::string what = error.what();
    return error.code() == code && !what.empty() && what.find('\n') == std::string::npos;
  }
  return false;
}

GridOptions plane(double side = 32.0, double cell = 1.0) {
  GridOptions o;
  o.hiding = Hiding::voxel;
  o.bounds = {{0, 0, 0}, {side, side, 0}};
  o.cell = cell;
  return o;
}

/// A wall across the middle, one disc before and one behind it.
void furnish(GridEngine& engine) {
  engine.add(make_static(10, Rectangle{{4, 32}}, {16, 16, 0}));
  engine.add(make_object(11, Disc{0.5}, {10, 16, 0}, 1.0));
  engine.add(make_object(12, Disc{0.5}, {28, 16, 0}, 1.0));
}

const std::vector<View> west{make_view(1, {4.5, 16.2, 0})};

}  // namespace

TEST_CASE("what the engine refuses, and that it is then as it was") {
  GridEngine engine(plane());
  furnish(engine);
  Answers answers;
  engine.query(1.0, west, answers);
  const std::vector<ObjectId> expected{10, 11};
  REQUIRE(answers.views.at(0).visible == expected);

  const Pose at{{1, 2, 0}};
  CHECK(refuses(ErrorCode::unknown_object, [&] { engine.remove(99); }));
  CHECK(refuses(ErrorCode::unknown_object, [&] { engine.move(99, at); }));
  CHECK(refuses(ErrorCode::unknown_object, [&] { engine.announce_jump(99); }));
  CHECK(refuses(ErrorCode::unknown_object, [&] { engine.move(no_id, at); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { engine.add(make_object(11, Disc{1}, {1, 1, 0})); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { engine.add(make_object(no_id, Disc{1}, {1, 1, 0})); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { engine.add(make_object(20, Sphere{1}, {1, 1, 0})); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { engine.add(make_object(20, Disc{-1}, {1, 1, 0})); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { engine.add(make_object(20, Polygon{{{0, 0}, {1, 1}}}, {1, 1, 0})); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { engine.add(make_object(20, Disc{1}, {1, 1, 0}, -1.0)); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { engine.add(make_object(20, Disc{1}, {1, 1, 0}, not_a_number)); }));
  CHECK_THROWS_AS(engine.add(make_object(20, Disc{1}, {not_a_number, 1, 0})), Error);
  CHECK(refuses(ErrorCode::bad_frame, [&] { engine.move(11, {{not_a_number, 0, 0}}); }));
  CHECK(refuses(ErrorCode::bad_frame, [&] { engine.move(11, {{1e300, 0, 0}}); }));
  CHECK(refuses(ErrorCode::bad_frame, [&] { engine.move(11, {{1, 1, 0}, {0, 0, 0, 0}}); }));

  // None of it left a trace; id 20 is still free.
  engine.query(2.0, west, answers);
  CHECK(answers.views.at(0).visible == expected);
  CHECK(answers.stats.jumps == 0);
  engine.add(make_object(20, Disc{1}, {6, 20, 0}));
  engine.query(3.0, west, answers);
  CHECK(sees(answers.views.at(0), 20));
}

TEST_CASE("times that do not go on and views that cannot be are refused before anything happens") {
  GridEngine engine(plane());
  furnish(engine);
  Answers answers;
  engine.query(5.0, west, answers);
  for (const double time : {5.0, 4.0, -1e9, not_a_number, std::numeric_limits<double>::infinity()}) {
    CHECK(refuses(ErrorCode::bad_frame, [&] { engine.query(time, west, answers); }));
  }
  std::vector<View> bad = west;
  bad.push_back(west[0]);
  bad[1].range = 0.0;
  CHECK(refuses(ErrorCode::bad_frame, [&] { engine.query(6.0, bad, answers); }));
  bad[1].range = 5.0;
  bad[1].fov = 7.0;
  CHECK(refuses(ErrorCode::bad_frame, [&] { engine.query(6.0, bad, answers); }));
  bad[1].fov = 1.0;
  bad[1].pose.position.x = not_a_number;
  CHECK(refuses(ErrorCode::bad_frame, [&] { engine.query(6.0, bad, answers); }));
  // The frame at 6 s was never taken, so it still can be.
  engine.query(5.5, west, answers);
  engine.query(6.0, west, answers);
  CHECK(answers.views.at(0).visible == std::vector<ObjectId>{10, 11});
}

TEST_CASE("options out of range") {
  const auto make = [](auto&& change) {
    GridOptions o = plane();
    change(o);
    const GridEngine engine(o);
  };
  CHECK(refuses(ErrorCode::usage, [&] { make([](GridOptions& o) { o.threads = 0; }); }));
  CHECK(refuses(ErrorCode::usage, [&] { make([](GridOptions& o) { o.threads = 257; }); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { make([](GridOptions& o) { o.dimension = 4; }); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { make([](GridOptions& o) { o.cell = 0.0; }); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { make([](GridOptions& o) { o.cell = not_a_number; }); }));
  CHECK(refuses(ErrorCode::bad_scene, [&] { make([](GridOptions& o) { o.bounds = {}; }); }));
  CHECK(refuses(ErrorCode::limit, [&] { make([](GridOptions& o) { o.cell = 1e-6; }); }));
  CHECK(refuses(ErrorCode::limit, [&] { make([](GridOptions& o) { o.max_memory = 100; }); }));
  CHECK_NOTHROW(make([](GridOptions& o) { o.threads = 256; }));
}

TEST_CASE("a frame without views, a world without objects") {
  GridEngine engine(plane());
  Answers answers;
  engine.query(0.0, {}, answers);
  CHECK(answers.views.empty());
  engine.query(1.0, west, answers);
  CHECK(answers.views.at(0).visible.empty());
  CHECK(answers.views.at(0).viewer == 1);
}

TEST_CASE("two engines in one process do not touch each other") {
  const auto world = [](GridEngine& engine, double shift) {
    engine.add(make_static(1, Rectangle{{4, 20}}, {16 + shift, 16, 0}));
    for (ObjectId id = 2; id < 12; ++id) engine.add(make_object(id, Disc{0.4}, {29, 4 + 2.0 * id, 0}, 1.0));
  };
  const auto step = [](GridEngine& engine, int frame, double speed, Answers& answers) {
    for (ObjectId id = 2; id < 12; ++id) engine.move(id, {{29 - speed * frame, 4 + 2.0 * id, 0}});
    engine.query(frame, west, answers);
  };
  GridEngine alone_a(plane()), alone_b(plane(32, 0.5)), a(plane()), b(plane(32, 0.5));
  world(alone_a, 0), world(a, 0), world(alone_b, 5), world(b, 5);
  std::vector<std::vector<ObjectId>> expected_a, expected_b;
  Answers answers;
  for (int f = 1; f <= 25; ++f) step(alone_a, f, 0.9, answers), expected_a.push_back(answers.views.at(0).visible);
  for (int f = 1; f <= 25; ++f) step(alone_b, f, 0.4, answers), expected_b.push_back(answers.views.at(0).visible);
  for (int f = 1; f <= 25; ++f) {
    const auto i = static_cast<std::size_t>(f - 1);
    step(a, f, 0.9, answers);
    CHECK(answers.views.at(0).visible == expected_a[i]);
    step(b, f, 0.4, answers);
    CHECK(answers.views.at(0).visible == expected_b[i]);
  }
  CHECK(expected_a.front() != expected_a.back());
}

TEST_CASE("memory: under 8 bytes a cell and 200 an object on 5,000 spheres") {
  GenerateOptions options;
  options.count = 5000;
  options.frames = 12;
  const auto generator = make_generator("spheres", options);
  const Scene& scene = generator->scene();
  GridOptions o;
  o.hiding = Hiding::voxel;
  o.dimension = 3;
  o.bounds = scene.bounds.value();
  for (const double cell : {2.0, 1.0}) {
    o.cell = cell;
    GridEngine engine(o);
    const auto frames = make_generator("spheres", options);
    Replay replay(engine, scene, frames.get());
    while (replay.step()) {
    }
    const MemoryUse use = engine.memory();
    const std::uint64_t cells = engine.lattice().cell_count();
    CAPTURE(cell);
    CAPTURE(use.matrices);
    CAPTURE(use.viewers);
    CAPTURE(use.entries);
    CAPTURE(use.objects);
    // 8 bytes a cell and 200 an object are kept where cells are not few: on 75,000 cells the objects weigh
    // more, some 420 bytes each with their shapes.
    CHECK(use.total() < 8 * cells + (cells > 500'000 ? 200 : 500) * 5000);
    // And no less than what must be there: O, O_s and the heads of I, and every object's pose.
    CHECK(use.matrices > cells / 64 * 20);
    CHECK(use.objects > 5000 * sizeof(Pose));
  }
}

TEST_CASE("memory: what waits to be settled at the next frame counts") {
  GridEngine engine(plane());
  constexpr ObjectId crowd = 1000;
  for (ObjectId id = 0; id < crowd; ++id) {
    engine.add(make_object(id, Disc{0.1}, {1.0 + 0.01 * static_cast<double>(id), 5, 0}, 1.0));
  }
  Answers answers;
  engine.query(0.0, west, answers);
  const std::uint64_t before = engine.memory().objects;
  for (ObjectId id = 0; id < crowd; ++id) {
    engine.move(id, {{1.0 + 0.01 * static_cast<double>(id), 5.01, 0}});
  }
  // From where each came, at least.
  CHECK(engine.memory().objects >= before + crowd * sizeof(Vec3));
}

TEST_CASE("removed ids can be used again, by another shape at another place") {
  GridEngine engine(plane());
  furnish(engine);
  Answers answers;
  engine.query(0.0, west, answers);
  CHECK(!sees(answers.views.at(0), 12));
  engine.remove(10);
  engine.add(make_object(10, Polyline{{{0, -1}, {0, 1}}}, {30, 30, 0}));
  engine.query(1.0, west, answers);
  CHECK(answers.views.at(0).visible == std::vector<ObjectId>{10, 11, 12});
  engine.remove(12);
  engine.query(2.0, west, answers);
  CHECK(answers.views.at(0).visible == std::vector<ObjectId>{10, 11});
}

TEST_CASE("answers do not depend on the number of threads") {
  GenerateOptions options;
  options.count = 300;
  options.viewers = 24;
  options.frames = 10;
  const auto generator = make_generator("discs", options);
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 4}) {
    GridOptions o;
    o.hiding = Hiding::voxel;
    o.bounds = generator->scene().bounds.value();
    o.cell = 2.0;
    o.threads = threads;
    GridEngine engine(o);
    const auto frames = make_generator("discs", options);
    Replay replay(engine, generator->scene(), frames.get());
    StableHash hash;
    while (replay.step()) {
      for (const Answer& answer : replay.answers().views) hash.add(answer);
    }
    hashes.push_back(hash.value());
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

}  // namespace gridcull::test
