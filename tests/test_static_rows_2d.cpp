// Static objects of a flat world in rows: who is where, and that coming, going and being moved by hand change no
// answer.
#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/grid/engine.h"
#include "gridcull/grid/static_rows_2d.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

using Member = StaticRows2D::Member;

std::vector<Member> some_members(std::size_t count, Random& random) {
  std::vector<Member> members;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 low(random.uniform(-50, 50), random.below(3) == 0 ? 7.0 : random.uniform(0, 300));
    const Vec2 size(random.uniform(0, 4), random.below(4) == 0 ? 0.0 : random.uniform(0, 9));
    members.push_back({static_cast<Slot>(3 * i + 1), random.below(2) == 0, {low, low + size}});
  }
  return members;
}

bool within(const Box2D& inner, const Box2D& outer) {
  return inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

/// All members below a row, each once and within every box above it.
void visit(const StaticRows2D& rows, StaticRows2D::RowId id, const Box2D& around, std::map<Slot, Member>& met) {
  const StaticRows2D::Row& row = rows.row(id);
  for (std::size_t lane = 0; lane < StaticRows2D::lanes; ++lane) {
    if ((row.there >> lane & 1) == 0) continue;
    const Box2D box = StaticRows2D::box_of(row, lane);
    CHECK(within(box, around));
    if (id.level > 0) {
      visit(rows, {id.level - 1, row.what[lane]}, box, met);
    } else {
      CHECK(met.emplace(row.what[lane], Member{row.what[lane], (row.occluders >> lane & 1) != 0, box}).second);
    }
  }
}

void check(const StaticRows2D& rows, const std::vector<Member>& expected) {
  std::map<Slot, Member> met;
  if (!rows.empty()) visit(rows, {rows.top(), 0}, rows.box(), met);
  CHECK(rows.size() == expected.size());
  REQUIRE(met.size() == expected.size());
  for (const Member& m : expected) {
    REQUIRE(met.contains(m.slot));
    CHECK(rows.holds(m.slot));
    CHECK(met[m.slot].occluder == m.occluder);
    CHECK(met[m.slot].box.low == m.box.low);
    CHECK(met[m.slot].box.high == m.box.high);
  }
  std::size_t listed = 0;
  rows.for_each([&](Slot slot, bool, const Box2D&) { listed += met.count(slot); });
  CHECK(listed == expected.size());
}

}  // namespace

TEST_CASE("rows hold all members, each within the boxes of the rows above it") {
  Random random(5);
  for (const std::size_t count : {0, 1, 7, 8, 9, 63, 64, 65, 100, 512, 513, 3000}) {
    CAPTURE(count);
    std::vector<Member> members = some_members(count, random);
    StaticRows2D rows;
    std::vector<Member> given = members;
    rows.build(given);
    check(rows, members);
    CHECK(rows.holes() == 0);
    CHECK_FALSE(rows.holds(0));
    // In whatever order they come they stand in the same rows.
    std::mt19937 shuffler(7);
    given = members;
    std::shuffle(given.begin(), given.end(), shuffler);
    StaticRows2D others;
    others.build(given);
    std::vector<Slot> order, other_order;
    rows.for_each([&](Slot slot, bool, const Box2D&) { order.push_back(slot); });
    others.for_each([&](Slot slot, bool, const Box2D&) { other_order.push_back(slot); });
    CHECK(order == other_order);
    for (std::size_t i = 0; i < count; i += 3) rows.remove(members[i].slot);
    rows.remove(0);  // is not there
    std::vector<Member> left;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % 3 != 0) left.push_back(members[i]);
    }
    check(rows, left);
    CHECK(rows.holes() == count - left.size());
  }
}

// A city is wider than it is deep: rows are as good as they are compact.
TEST_CASE("rows of a town are compact") {
  Random random(6);
  std::vector<Member> members;
  for (Slot i = 0; i < 1024; ++i) {
    const Vec2 low(20.0 * (i % 64), 20.0 * static_cast<double>(i / 64));
    members.push_back({i, true, {low, low + Vec2(10, 8)}});
  }
  StaticRows2D rows;
  rows.build(members);
  double sum = 0.0;
  for (std::uint32_t number = 0; number < 16; ++number) {
    const StaticRows2D::Row& of_rows = rows.row({1, number});
    for (std::size_t lane = 0; lane < StaticRows2D::lanes; ++lane) {
      const Box2D box = StaticRows2D::box_of(of_rows, lane);
      sum += (box.high.x - box.low.x) + (box.high.y - box.low.y);
    }
  }
  CHECK(sum / 128 == doctest::Approx(98.0));  // blocks of 4 x 2 buildings
}

TEST_CASE("statics that come, go and are moved by hand are answered where they are") {
  Random random(8);
  const GridOptions options{.dimension = 2, .bounds = {{0, 0, 0}, {100, 100, 0}}, .cell = 1.0};
  GridEngine engine(options);
  std::map<ObjectId, Object> world;
  const auto place = [&] {
    return Vec3(random.uniform(-2, 102), random.uniform(-2, 102), 0);  // some reach out of the lattice
  };
  const auto add = [&](ObjectId id) {
    Shape shape = Rectangle{{random.uniform(1, 8), random.uniform(1, 8)}};
    if (id % 5 == 0) shape = Disc{random.uniform(0.5, 3)};
    if (id % 7 == 0) shape = Polyline{{{0, 0}, {random.uniform(1, 9), 3}, {5, 9}}};
    Object o = id % 4 == 0 ? make_object(id, shape, place(), 5.0) : make_static(id, shape, place());
    o.occluder = id % 9 != 0;
    world[id] = o;
    engine.add(o);
  };
  for (ObjectId id = 1; id <= 120; ++id) add(id);
  Answers answers, fresh_answers;
  for (int frame = 0; frame < 200; ++frame) {
    CAPTURE(frame);
    const auto some = [&] { return static_cast<ObjectId>(1 + random.below(120)); };
    for (std::uint32_t k = 0, changes = random.below(frame % 10 == 0 ? 40 : 3); k < changes; ++k) {
      const ObjectId id = some();
      if (!world.contains(id)) {
        add(id);
      } else if (random.below(3) == 0) {
        engine.remove(id);
        world.erase(id);
      } else {
        Pose& pose = world[id].pose;
        pose = {place(), turn_about_z(random.uniform(-3, 3))};
        engine.move(id, pose);
      }
    }
    std::vector<View> views{make_view(1, {50, 50, 0}), make_view(2, place())};
    views[1].range = 40;
    if (world.contains(3)) views[1].rides = 3;
    engine.query(frame, views, answers);
    GridEngine fresh(options);
    for (const auto& [id, object] : world) fresh.add(object);
    fresh.query(frame, views, fresh_answers);
    for (std::size_t i = 0; i < views.size(); ++i) {
      CHECK(answers.views[i].visible == fresh_answers.views[i].visible);
    }
  }
  CHECK(answers.views[0].visible.size() > 5);
}

TEST_CASE("statics that are told where they stand anyway keep their rows") {
  GridEngine engine({.dimension = 2, .bounds = {{0, 0, 0}, {100, 100, 0}}, .cell = 1.0});
  std::vector<Object> walls;
  for (ObjectId id = 1; id <= 64; ++id) {
    walls.push_back(make_static(id, Rectangle{{2, 2}}, {12.0 * (id % 8) + 2, 12.0 * static_cast<double>(id / 8), 0}));
    engine.add(walls.back());
  }
  const std::vector<View> views{make_view(1, {50, 50, 0})};
  Answers answers;
  engine.query(0.0, views, answers);
  const WorkCounts first = answers.views[0].work;
  for (const Object& wall : walls) engine.move(wall.id, wall.pose);
  engine.query(1.0, views, answers);
  CHECK(answers.views[0].work.cells_visited == first.cells_visited);
  CHECK(answers.views[0].work.object_tests == first.object_tests);
  // One that does move is found where it is, and nowhere else.
  engine.move(28, {{56, 50, 0}});
  engine.query(2.0, views, answers);
  CHECK(std::count(answers.views[0].visible.begin(), answers.views[0].visible.end(), 28) == 1);
  CHECK(answers.views[0].work.object_tests == first.object_tests);
}

TEST_CASE("a row is met wherever the range reaches one of its members") {
  GridEngine engine({.dimension = 2, .bounds = {{0, 0, 0}, {200, 100, 0}}, .cell = 1.0});
  for (ObjectId id = 0; id < 16; ++id) {
    engine.add(
        make_static(id, Rectangle{{2, 2}}, {100.0 + 5.0 * (id % 4), 50.0 + 5.0 * static_cast<double>(id / 4), 0}));
  }
  Answers answers;
  double time = 0.0;
  for (double away = 1.0; away < 90.0; away += 1.7) {
    CAPTURE(away);
    View view = make_view(1, {99.0 - away, 50.5, 0});
    view.range = away * (1.0 + 1e-6);
    engine.query(++time, std::vector{view}, answers);
    CHECK(answers.views[0].visible == std::vector<ObjectId>{0});
    view.range = away * (1.0 - 1e-6);
    engine.query(++time, std::vector{view}, answers);
    CHECK(answers.views[0].visible.empty());
  }
}

/// A source that is down.
class Silent final : public PositionSource {
 public:
  Pose pose(ObjectId) override { throw std::runtime_error("no answer"); }
};

TEST_CASE("statics that are told of while no frame can be answered take no memory that grows") {
  GridEngine engine({.dimension = 2, .bounds = {{0, 0, 0}, {100, 100, 0}}, .cell = 1.0});
  Silent source;
  for (ObjectId id = 0; id < 32; ++id) {
    engine.add(make_static(id, Rectangle{{2, 2}}, {12.0 * (id % 8) + 2, 12.0 * static_cast<double>(id / 8), 0}));
  }
  engine.add(make_object(99, Disc{0.3}, {50, 50, 0}, 1.0));
  engine.set_source(&source);
  Answers answers;
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i) {
      engine.move(5, {{60 + 0.1 * (i % 2), 0, 0}});
      CHECK_THROWS(engine.query(1.0 + i, std::vector{make_view(1, {50, 90, 0})}, answers));
    }
    return engine.memory().total();
  };
  const std::uint64_t before = frames(100);
  CHECK(frames(3000) == before);
}

}  // namespace gridcull::test
