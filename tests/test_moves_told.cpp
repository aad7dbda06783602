// Moves told in one go are the moves told one by one: the same answers and counts, and refused as a whole. Objects that
// move on their leash are met where they are.
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/core/error.h"
#include "gridcull/grid/engine.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

constexpr ObjectId count = 60;
constexpr double seconds = 0.1, greatest_speed = 20.0;

GridOptions options(int dimension, Hiding hiding, TbvMode tbv) {
  GridOptions o{.dimension = dimension, .bounds = {{0, 0, 0}, {60, 60, dimension == 3 ? 30.0 : 0.0}}, .cell = 1.0};
  o.tbv = tbv;
  o.hiding = hiding;
  return o;
}

Object object_of(ObjectId id, int dimension, Random& random) {
  const bool box = id % 2 == 0;
  Shape shape = Disc{random.uniform(0.3, 2.0)};
  if (dimension == 2 && box) shape = Rectangle{{6, 2}};
  if (dimension == 3) shape = box ? Shape(Cuboid{{4, 2, 3}}) : Shape(Sphere{random.uniform(0.3, 2.0)});
  Object o = make_object(id, shape, {random.uniform(0, 60), random.uniform(0, 60), 0});
  if (dimension == 3) o.pose.position.z = random.uniform(0, 30);
  o.is_static = id % 5 == 0;
  if (id % 7 != 0) o.max_speed = greatest_speed;
  return o;
}

/// Some moves, small and great, some objects more than once.
std::vector<Move> some_moves(std::vector<Object>& objects, Random& random) {
  std::vector<Move> moves;
  for (int i = 0; i < 50; ++i) {
    Object& o = objects[random.below(count)];
    const double way = random.below(12) == 0 ? 40.0 : greatest_speed * seconds;
    o.pose.position += way * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.0);
    if (random.below(3) == 0) o.pose.orientation = turn_about_z(random.uniform(-3, 3));
    moves.push_back({o.id, o.pose});
  }
  return moves;
}

void check_same(const Answers& a, const Answers& b) {
  REQUIRE(a.views.size() == b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    CHECK(a.views[i].visible == b.views[i].visible);
    CHECK(a.views[i].work.object_tests == b.views[i].work.object_tests);
    CHECK(a.views[i].work.tbv_tests == b.views[i].work.tbv_tests);
  }
  CHECK(a.stats.jumps == b.stats.jumps);
  CHECK(a.stats.positions_read == b.stats.positions_read);
  CHECK(a.stats.tbv_active == b.stats.tbv_active);
}

void run(int dimension, Hiding hiding, TbvMode tbv, std::uint64_t seed) {
  CAPTURE(dimension);
  CAPTURE(static_cast<int>(hiding));
  CAPTURE(static_cast<int>(tbv));
  CAPTURE(seed);
  Random random(seed);
  const GridOptions o = options(dimension, hiding, tbv);
  GridEngine single(o), whole(o);
  std::vector<Object> objects;
  for (ObjectId id = 0; id < count; ++id) objects.push_back(object_of(id, dimension, random));
  for (const Object& object : objects) single.add(object), whole.add(object);
  for (int frame = 0; frame < 20; ++frame) {
    CAPTURE(frame);
    const std::vector<Move> moves = some_moves(objects, random);
    for (const Move& m : moves) single.move(m.object, m.pose);
    // One that is refused, at any place, changes nothing.
    std::vector<Move> bad = moves;
    for (Move& m : bad) m.pose.position.x += 3.0;
    Move& fault = bad[random.below(static_cast<std::uint32_t>(bad.size()))];
    if (frame % 3 == 0) fault.object = count + 5;
    if (frame % 3 == 1) fault.pose.position.y = std::numeric_limits<double>::quiet_NaN();
    if (frame % 3 == 2) fault.pose.orientation = {2, 0, 0, 0};
    CHECK_THROWS_AS(whole.move_all(bad), Error);
    whole.move_all(moves);
    const std::vector<View> views{make_view(1, {30, 30, dimension == 3 ? 10.0 : 0.0}),
                                  make_view(2, objects[3].pose.position)};
    Answers a, b, c;
    single.query(seconds * (frame + 1), views, a);
    whole.query(seconds * (frame + 1), views, b);
    check_same(a, b);
    if (hiding == Hiding::voxel) continue;
    // Who has a leash or a volume changes no answer of `silhouette`.
    GridEngine fresh(options(dimension, hiding, TbvMode::off));
    for (const Object& object : objects) fresh.add(object);
    fresh.query(1.0, views, c);
    for (std::size_t i = 0; i < views.size(); ++i) CHECK(b.views[i].visible == c.views[i].visible);
  }
}

}  // namespace

TEST_CASE("moves told together are moves told one by one, and one that is refused refuses them all") {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    for (const Hiding hiding : {Hiding::silhouette, Hiding::voxel}) {
      for (const TbvMode tbv : {TbvMode::off, TbvMode::solid, TbvMode::automatic}) {
        run(2, hiding, tbv, seed);
        run(3, hiding, tbv, seed);
      }
    }
  }
}

TEST_CASE("an object that creeps is met where it is, however small its steps") {
  for (const bool pulls : {false, true}) {
    CAPTURE(pulls);
    GridOptions small = options(3, Hiding::silhouette, TbvMode::off);
    small.bounds = {{0, 0, 0}, {80, 48, 12}};
    GridEngine engine(small);
    Random random(5);
    ProbedWorld source;
    // A crowd behind a wall, whose nodes are hidden as nodes.
    std::vector<Object> objects{make_static(0, Cuboid{{2, 6, 20}}, {16, 20, 6})};
    for (ObjectId id = 1; id <= 1000; ++id) {
      const Vec3 place(random.uniform(60, 64), random.uniform(16, 22), random.uniform(5, 7));
      objects.push_back(make_object(id, Sphere{0.2 + 0.01 * (id % 20)}, place, 5.0));
      source.poses[id] = objects.back().pose;
    }
    for (const Object& o : objects) engine.add(o);
    if (pulls) engine.set_source(&source);
    std::size_t hidden_at_first = 0;
    for (int frame = 0; frame < 120; ++frame) {
      CAPTURE(frame);
      // All one way, out of the wall's shadow, each at its own pace.
      std::vector<Move> moves;
      for (Object& o : objects) {
        if (o.is_static) continue;
        o.pose.position.y += 0.003 * (1 + o.id % 50);
        source.poses[o.id] = o.pose;
        moves.push_back({o.id, o.pose});
      }
      if (!pulls) engine.move_all(moves);
      View narrow = make_view(1, {-1, 20, 6});
      narrow.frustum.emplace();
      const std::vector<View> views{narrow, make_view(2, {5, 20, 6})};
      Answers answers, expected;
      engine.query(0.03 * (frame + 1), views, answers);
      GridEngine fresh(small);
      for (const Object& o : objects) fresh.add(o);
      fresh.query(1.0, views, expected);
      for (std::size_t i = 0; i < views.size(); ++i) CHECK(answers.views[i].visible == expected.views[i].visible);
      if (frame == 0) hidden_at_first = objects.size() - answers.views[0].visible.size();
      if (frame == 119) CHECK(answers.views[0].visible.size() > 50);
    }
    CHECK(hidden_at_first > 990);
  }
}

TEST_CASE("the round of pushes comes round again and is not taken for the one before") {
  GridEngine engine(options(3, Hiding::silhouette, TbvMode::off));
  engine.add(make_object(1, Sphere{0.5}, {10, 10, 10}, 1.0));
  Answers answers;
  std::uint64_t jumps = 0;
  double time = 0.0;
  engine.query(time += 1.0, {}, answers);
  engine.move(1, {{10.5, 10, 10}});
  for (int frame = 0; frame < 65535; ++frame) {
    engine.query(time += 1.0, {}, answers);
    jumps += answers.stats.jumps;
  }
  CHECK(jumps == 0);
  // 65,535 rounds later, from where it has stood all the time: a jump, once.
  engine.move(1, {{20, 10, 10}});
  engine.query(time += 1.0, {}, answers);
  CHECK(answers.stats.jumps == 1);
}

// Times are as the simulator counts them: what the index holds must not depend on where they begin.
TEST_CASE("nobody is missed at whatever time the first frame is, and at the next") {
  for (const double first : {-1000.0, -1.0, -0.1, 0.0, 1.0, 1.7e9, 1e300}) {
    for (const bool is_static : {false, true}) {
      GridEngine engine({.dimension = 3, .bounds = {{0, 0, 0}, {128, 128, 128}}, .cell = 1.0});
      Object beam = make_object(1, Cuboid{{100, 2, 2}}, {64, 64, 64}, 1e9);
      beam.is_static = is_static;
      engine.add(beam);
      const View view = [] {
        View v = make_view(1, {5, 64, 64});
        v.range = 12;
        return v;
      }();
      Answers answers;
      CAPTURE(first);
      CAPTURE(is_static);
      for (const double time : {first, first < 0.0 ? 0.0 : 2.0 * first + 1.0}) {
        engine.query(time, {&view, 1}, answers);
        CHECK(answers.views.at(0).visible == std::vector<ObjectId>{1});
        beam.pose.position.y += 0.01;
        engine.move(1, beam.pose);
      }
    }
  }
}

}  // namespace gridcull::test
