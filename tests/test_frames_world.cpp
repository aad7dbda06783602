// What frames do to a world.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "gridcull/sim/world.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

Scene small_town() {
  return parse_scene(R"({"format": "gridcull.scene/1", "dimension": 2, "objects": [
    {"id": 0, "static": true, "shape": {"type": "box", "size": [4, 2]}, "position": [1, 1], "heading": 0.5},
    {"id": 5, "shape": {"type": "disc", "radius": 1}, "position": [5, 5], "max_speed": 2},
    {"id": 9, "shape": {"type": "box", "size": [4, 2]}, "position": [10, 0], "heading": 1.5707963267948966}],
    "viewers": [{"id": 30, "position": [3, 4]}, {"id": 10, "follows": 9, "offset": [2, 1], "range": 50},
                {"id": 20, "follows": 9, "heading": 0, "fov_degrees": 90}]})",
                     "town");
}

void apply(World& world, const std::string& line) { world.apply(parse_frame(line, 2, "f:7")); }

/// Everything one can see of a world, as text.
std::string state_of(const World& world) {
  Scene scene;
  std::vector<Object> objects(world.objects().begin(), world.objects().end());
  std::sort(objects.begin(), objects.end(), [](const Object& a, const Object& b) { return a.id < b.id; });
  for (const Object& object : objects) scene.objects.push_back({object, "", {}});
  std::string out = scene_text(scene);
  for (const View& view : world.views()) {
    out += std::to_string(view.viewer) + " " + std::to_string(view.pose.position.x) + " " +
           std::to_string(view.pose.position.y) + " " + std::to_string(heading_of(view.pose.orientation)) + " " +
           std::to_string(view.range) + " " + std::to_string(view.fov) + " " + std::to_string(view.rides) + "\n";
  }
  return out + std::to_string(world.viewer_count()) + " " + std::to_string(world.time().value_or(-1));
}

}  // namespace

TEST_CASE("views come in viewer order, placed and turned by what they follow") {
  const World world(small_town());
  const std::vector<View> views = world.views();
  REQUIRE(views.size() == 3);
  CHECK(views[0].viewer == 10);
  CHECK(views[0].rides == 9);
  // The offset (2, 1) of an object that heads along +y.
  CHECK(views[0].pose.position.x == doctest::Approx(9.0));
  CHECK(views[0].pose.position.y == doctest::Approx(2.0));
  CHECK(heading_of(views[0].pose.orientation) == doctest::Approx(0.5 * std::numbers::pi));
  CHECK(views[0].range == 50.0);
  // A heading of its own is absolute.
  CHECK(views[1].viewer == 20);
  CHECK(views[1].pose.position == Vec3(10, 0, 0));
  CHECK(heading_of(views[1].pose.orientation) == 0.0);
  CHECK(views[1].fov == doctest::Approx(0.5 * std::numbers::pi));
  CHECK(views[2].viewer == 30);
  CHECK(views[2].rides == no_id);
  CHECK(heading_of(views[2].pose.orientation) == 0.0);
  CHECK(std::isinf(views[2].range));
}

TEST_CASE("set keeps what it does not name and applies to static objects") {
  World world(small_town());
  apply(world, R"({"time": 1, "set": [{"id": 0, "position": [7, 8]}, {"id": 9, "heading": 0}]})");
  CHECK(world.object(0).pose.position == Vec3(7, 8, 0));
  CHECK(heading_of(world.object(0).pose.orientation) == doctest::Approx(0.5));
  CHECK(world.object(9).pose.position == Vec3(10, 0, 0));
  CHECK(heading_of(world.object(9).pose.orientation) == 0.0);
  CHECK(world.views()[0].pose.position == Vec3(12, 1, 0));
  CHECK(world.time() == 1.0);
}

TEST_CASE("remove comes before add, add before set, drop_viewers before viewers") {
  World world(small_town());
  apply(world, R"({"time": 1, "viewers": [{"id": 10, "follows": 5, "range": 3}], "drop_viewers": [10],
    "set": [{"id": 5, "position": [2, 2]}],
    "add": [{"id": 5, "shape": {"type": "disc", "radius": 4}, "position": [0, 0]}], "remove": [5]})");
  CHECK(world.object(5).pose.position == Vec3(2, 2, 0));
  CHECK(std::get<Disc>(world.object(5).shape).radius == 4.0);
  CHECK_FALSE(world.object(5).max_speed);
  // Dropped and made anew: its offset is gone.
  CHECK(world.views()[0].pose.position == Vec3(2, 2, 0));
  CHECK(world.views()[0].range == 3.0);
  CHECK(world.objects().size() == 3);
}

TEST_CASE("a viewer whose object is gone gives no view until it is back") {
  World world(small_town());
  apply(world, R"({"time": 1, "remove": [9]})");
  REQUIRE(world.views().size() == 1);
  CHECK(world.views()[0].viewer == 30);
  CHECK(world.viewer_count() == 3);
  // It may be changed meanwhile, its object named again included.
  apply(world, R"({"time": 2, "viewers": [{"id": 10, "follows": 9, "range": 7}]})");
  CHECK(world.views().size() == 1);
  apply(world, R"({"time": 3, "add": [{"id": 9, "shape": {"type": "disc", "radius": 1}, "position": [1, 1]}]})");
  REQUIRE(world.views().size() == 3);
  CHECK(world.views()[0].range == 7.0);
  CHECK(world.views()[0].pose.position == Vec3(3, 2, 0));
}

TEST_CASE("a viewer named again keeps what the line does not mention") {
  World world(small_town());
  apply(
      world,
      R"({"time": 1, "viewers": [{"id": 20, "range": 9}, {"id": 10, "offset": [0, 0]}, {"id": 30, "fov_degrees": 180}]})");
  std::vector<View> views = world.views();
  CHECK(views[1].range == 9.0);
  CHECK(views[1].rides == 9);
  CHECK(views[1].fov == doctest::Approx(0.5 * std::numbers::pi));
  CHECK(views[0].pose.position == Vec3(10, 0, 0));
  CHECK(views[0].range == 50.0);
  CHECK(views[2].pose.position == Vec3(3, 4, 0));
  CHECK(views[2].fov == doctest::Approx(std::numbers::pi));
  // `position` ends `follows`: without a direction of its own it looks along +x.
  apply(world, R"({"time": 2, "viewers": [{"id": 10, "position": [1, 2]}, {"id": 30, "follows": 5}]})");
  views = world.views();
  CHECK(views[0].pose.position == Vec3(1, 2, 0));
  CHECK(views[0].rides == no_id);
  CHECK(heading_of(views[0].pose.orientation) == 0.0);
  CHECK(views[0].range == 50.0);
  // `follows` ends `position`, which does not become an offset.
  CHECK(views[2].pose.position == Vec3(5, 5, 0));
  CHECK(views[2].rides == 5);
}

TEST_CASE("a refused frame changes nothing") {
  struct Bad {
    const char* line;
    const char* said;
    ErrorCode code = ErrorCode::unknown_object;
  };
  // Each has a good part that must not stay.
  for (
      const Bad& bad : {
          Bad{R"({"time": 2, "remove": [5, 77]})",
              "f:7: /remove/1: expected the id of an object that is there, found 77"},
          Bad{R"({"time": 2, "set": [{"id": 5, "position": [0, 0]}, {"id": 78, "heading": 0}]})",
              "f:7: /set/1/id: expected the id of an object that is there, found 78"},
          Bad{R"({"time": 2, "remove": [5], "set": [{"id": 5, "heading": 0}]})",
              "f:7: /set/0/id: expected the id of an object"},
          Bad{R"({"time": 2, "remove": [9], "add": [{"id": 5, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}]})",
              "f:7: /add/0/id: expected a new id, found 5", ErrorCode::bad_frame},
          Bad{R"({"time": 2, "remove": [9], "drop_viewers": [10, 11]})",
              "f:7: /drop_viewers/1: expected the id of a viewer that is there, found 11"},
          Bad{R"({"time": 2, "remove": [9], "viewers": [{"id": 20, "range": 1}, {"id": 30, "follows": 66}]})",
              "f:7: /viewers/1/follows: expected the id of an object that is there, found 66"},
          Bad{R"({"time": 2, "remove": [5], "viewers": [{"id": 30, "follows": 5}]})",
              "f:7: /viewers/0/follows: expected the id of an object"},
          Bad{R"({"time": 2, "remove": [5], "viewers": [{"id": 31, "range": 5}]})",
              "f:7: /viewers/0: a new viewer needs", ErrorCode::bad_frame},
          Bad{R"({"time": 2, "drop_viewers": [20], "viewers": [{"id": 20, "range": 5}]})",
              "f:7: /viewers/0: a new viewer needs", ErrorCode::bad_frame},
          Bad{R"({"time": 2, "remove": [5], "viewers": [{"id": 30, "offset": [1, 1]}]})",
              "f:7: /viewers/0: \"offset\" needs an object", ErrorCode::bad_frame},
          Bad{R"({"time": 2, "remove": [5], "viewers": [{"id": 30, "position": [1, 1], "follows": 9}]})",
              "f:7: /viewers/0: expected either", ErrorCode::bad_frame},
          Bad{R"({"time": 1, "remove": [5]})", "f:7: /time: expected a time after 1, found 1", ErrorCode::bad_frame},
      }) {
    World world(small_town());
    apply(world, R"({"time": 1})");
    const std::string before = state_of(world);
    const std::string line = refusal(bad.code, [&] { apply(world, bad.line); });
    CAPTURE(line);
    CHECK(line.starts_with(bad.said));
    CHECK(state_of(world) == before);
  }
}

TEST_CASE("the objects of a set are found again, whatever has come and gone between") {
  World world(small_town());
  const auto placed = [&](std::size_t i, ObjectId id, double x) {
    CHECK(world.set_object(i).id == id);
    CHECK(world.object(id).pose.position.x == x);
  };
  apply(
      world,
      R"({"time": 1, "set": [{"id": 0, "position": [1, 0]}, {"id": 5, "position": [2, 0]}, {"id": 9, "position": [3, 0]}]})");
  placed(0, 0, 1), placed(1, 5, 2), placed(2, 9, 3);
  // The last object moves into the hole of the first; the same frame sets it and another in a new order.
  apply(world, R"({"time": 2, "remove": [0], "set": [{"id": 9, "position": [4, 0]}, {"id": 5, "position": [5, 0]}]})");
  placed(0, 9, 4), placed(1, 5, 5);
  apply(world, R"({"time": 3, "add": [{"id": 0, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}],
                  "set": [{"id": 0, "position": [6, 0]}, {"id": 9, "position": [7, 0]}, {"id": 5, "position": [8, 0]}]})");
  placed(0, 0, 6), placed(1, 9, 7), placed(2, 5, 8);
  CHECK_THROWS_AS(apply(world, R"({"time": 4, "set": [{"id": 0, "position": [9, 0]}, {"id": 77}]})"), Error);
  CHECK_THROWS_AS(apply(world, R"({"time": 4, "remove": [9], "set": [{"id": 0}, {"id": 9}]})"), Error);
  apply(world, R"({"time": 5, "set": [{"id": 0, "position": [10, 0]}]})");
  placed(0, 0, 10);
  CHECK(world.object(9).pose.position.x == 7);
}

TEST_CASE("frames made by a program are checked as files are") {
  World world(small_town());
  const std::string before = state_of(world);
  const auto refused = [&](const Frame& frame, ErrorCode code) {
    const std::string line = refusal(code, [&] { world.apply(frame); });
    CHECK(state_of(world) == before);
    return line;
  };
  Frame twice;
  twice.remove = {5, 5};
  CHECK(refused(twice, ErrorCode::bad_frame) == "frame: /remove/1: expected each id once, found 5 twice");
  Frame solid;
  solid.add.push_back({{50, Sphere{1.0}, {}, {}, true, false}, "", {}});
  CHECK(refused(solid, ErrorCode::bad_frame) == "frame: /add/0/shape: expected a 2D shape");
  Frame nameless;
  nameless.add.push_back({{no_id, Disc{1.0}, {}, {}, true, false}, "", {}});
  CHECK(refused(nameless, ErrorCode::bad_frame) == "frame: /add/0/id: expected an id");
  Frame bulk;
  bulk.bulk = {{5, 77}, std::vector<Pose>(2), {}, true, false};
  CHECK(refused(bulk, ErrorCode::unknown_object) ==
        "frame: /set_ids: expected the id of an object that is there, found 77 at place 1");
  bulk.bulk.ids = {5, 5};
  CHECK(refused(bulk, ErrorCode::bad_frame) == "frame: /set_ids: expected each id once, found 5 twice");
  Frame both;
  both.set.push_back({5, Vec3{1, 2, 0}, {}, {}});
  both.bulk = {{5}, std::vector<Pose>(1), {}, true, false};
  CHECK(refused(both, ErrorCode::bad_frame) == "frame: /set: expected moves in a list or in bulk, found both");
}

TEST_CASE("scenes made by a program are checked too") {
  Scene scene = small_town();
  scene.objects.push_back(scene.objects[0]);
  CHECK(refusal(ErrorCode::bad_scene, [&] { World w(scene); }) == "object 0: the id is there twice");
  scene = small_town();
  scene.viewers[0].follows = 1;
  CHECK(refusal(ErrorCode::bad_scene, [&] { World w(scene); }) == "viewer 30: follows object 1, which is not there");
  scene = small_town();
  scene.viewers[0].id = 10;
  CHECK(refusal(ErrorCode::bad_scene, [&] { World w(scene); }) == "viewer 10: the id is there twice");
  scene = small_town();
  scene.objects[0].object.shape = Sphere{1.0};
  CHECK(refusal(ErrorCode::bad_scene, [&] { World w(scene); }) ==
        "object 0: its shape is not of the scene's dimension");
  CHECK(refusal(ErrorCode::unknown_object, [&] { World(small_town()).object(4); }) == "object 4 is not there");
}

TEST_CASE("objects stay contiguous and found through many adds and removes") {
  World world(small_town());
  double time = 0.0;
  for (ObjectId id = 100; id < 400; ++id) {
    Frame frame;
    frame.time = ++time;
    frame.add.push_back({{id, Disc{1.0}, {{static_cast<double>(id), 0.0, 0.0}, {}}, {}, true, false}, "", {}});
    if (id % 3 == 0) frame.remove.push_back(id == 102 ? 0 : id - 3);
    if (id == 102) frame.remove = {0};
    world.apply(frame);
  }
  for (const Object& object : world.objects()) {
    CHECK(world.object(object.id).id == object.id);
    if (object.id >= 100) CHECK(object.pose.position.x == object.id);
  }
  CHECK_FALSE(world.has(0));
  CHECK_FALSE(world.has(102));
  CHECK(world.has(399));
  CHECK(world.objects().size() == 3 + 300 - 100);
}
