// Volumes must hold their objects until they expire: runners that make for the open at the greatest speed that they
// promised, asked for only when the engine wants them, are reported in the very frame in which the exact reference
// sees them.
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/core/exact.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

constexpr ObjectId wall = 1, first_runner = 10;
constexpr int runners = 400, frames = 120;
constexpr double step_seconds = 0.1;

/// Behind a wall; each runs straight on, north or south, at a speed of its own.
struct Race {
  Race() {
    Random dice(31);
    objects.push_back(make_static(wall, Rectangle{{4, 24}}, {30, 48, 0}));
    for (int i = 0; i < runners; ++i) {
      const double speed = dice.uniform(0.5, 6.0), way = i % 2 == 0 ? 1.0 : -1.0;
      const Vec3 start{dice.uniform(36, 70), 48 + dice.uniform(-8, 8), 0};
      objects.push_back(make_object(first_runner + static_cast<ObjectId>(i), Disc{0.05}, start, speed));
      objects.back().occluder = false;
      velocities.push_back({0, way * speed, 0});
      world.poses[objects.back().id] = {start};
    }
  }
  void step() {
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      Vec3& p = objects[i + 1].pose.position;
      p += step_seconds * velocities[i];
      world.poses[objects[i + 1].id] = {p};
    }
  }

  std::vector<Object> objects;
  std::vector<Vec3> velocities;  // of objects[1] on
  ProbedWorld world;
};

void run_race(const MethodEntry& method, const char* tbv) {
  Race race;
  MethodOptions options;
  options.bounds = {{0, 0, 0}, {96, 96, 0}};
  options.tbv = tbv;
  const auto culler = method.make(options);
  for (const Object& object : race.objects) culler->add(object);
  culler->set_source(&race.world);
  const View view = make_view(1, {8.3, 48.4, 0});
  Answers answers;
  std::uint64_t read = 0, seen = 0;
  for (int frame = 0; frame < frames; ++frame) {
    CAPTURE(frame);
    culler->query(step_seconds * frame, {&view, 1}, answers);
    const ExactAnswer exact = exact_visible_2d(race.objects, view);
    for (const ObjectId id : exact.visible) CHECK_MESSAGE(sees(answers.views.at(0), id), "object ", id);
    read += answers.stats.positions_read;
    seen += exact.visible.size();
    race.step();
  }
  CHECK(seen > 20 * frames);
  // Volumes are at work: most of those that are hidden are not asked for.
  if (method.options.find("--tbv") != std::string_view::npos) CHECK(read < std::uint64_t{runners} * frames * 3 / 4);
}

}  // namespace

TEST_CASE("runners that leave their hiding place at full speed are reported at once") {
  for (const MethodEntry& method : method_catalog()) {
    if (method.info.guarantee != Guarantee::conservative || !method.info.takes_2d) continue;
    CAPTURE(std::string(method.info.name));
    for (const char* tbv : {"solid", "hollow"}) {
      CAPTURE(std::string(tbv));
      run_race(method, tbv);
    }
  }
}

}  // namespace gridcull::test
