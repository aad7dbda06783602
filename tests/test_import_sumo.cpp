#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <doctest/doctest.h>

#include "gridcull/sim/import_sumo.h"
#include "gridcull/sim/world.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

const std::string buildings = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- a town -->
<additional>
    <poly id="church" type="building.church" shape="100.25,200.5 110.25,200.5 110.25,208.5 100.25,200.5"/>
    <poly id="lake" type="water" shape="0,0 50,0 50,50"/>
    <poly id="line" type="building" shape="1,1 2,2 1,1"/>
    <poly id="house" type="building" shape="0,0,5 10,0,5 10,8,5 0,8,5"/>
</additional>
)";

const std::string fcd = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- written by hand; <timestep time="9"> in a comment is not one -->
<fcd-export>
    <timestep time="10.00">
        <vehicle id="a" x="50.00" y="60.00" z="0.00" angle="90.00" type="t" speed="4.98" lane="e_0"/>
        <vehicle id="b &amp; c" x="70.00" y="60.00" angle="0.00"/>
        <person id="a" x="20.00" y="30.00" angle="180.00" speed="1" edge="e"/>
    </timestep>
    <timestep time="10.50"/>
    <timestep time="11.00">
        <vehicle id="d" x="1.00" y="2.00" angle="270.00"/>
        <vehicle id="a" x="52.00" y="60.00" angle="360.00"/>
    </timestep>
    <timestep time="11.50">
        <person id="a" x="21.00" y="30.00" angle="90"/>
        <vehicle id="a" x="52.00" y="61.00" angle="0.00"/>
    </timestep>
</fcd-export>
)";

struct Result {
  Imported imported;
  std::vector<Frame> frames;
};

Result import(SumoOptions options, const TemporaryFolder& folder, const std::string& steps = fcd,
              const std::string& polygons = buildings) {
  options.fcd = folder.with("fcd.xml", steps);
  options.buildings = folder.with("b.xml", polygons);
  Result out;
  out.imported = import_sumo(options, [&](const Frame& frame) { out.frames.push_back(frame); });
  return out;
}

std::vector<ViewerId> viewers_of(const Frame& frame) {
  std::vector<ViewerId> out;
  for (const ViewerUpdate& viewer : frame.viewers) out.push_back(viewer.id);
  return out;
}

}  // namespace

TEST_CASE("buildings come first, in file order, about their middle") {
  const TemporaryFolder folder;
  const Result result = import({}, folder);
  const Scene& scene = result.imported.scene;
  CHECK(scene.dimension == 2);
  REQUIRE(scene.objects.size() == 2);
  const SceneObject& church = scene.objects[0];
  CHECK(church.object.id == 0);
  CHECK(church.name == "church");
  CHECK(church.object.is_static);
  CHECK(church.object.pose.position == Vec3(105, 204, 0));
  const std::vector<Vec2> outline = world_outline(church.object.shape, church.object.pose);
  CHECK(outline == std::vector<Vec2>{{100.25, 200.5}, {110.25, 200.5}, {110.25, 208.5}});
  CHECK(scene.objects[1].name == "house");
  CHECK(scene.objects[1].object.id == 1);
  REQUIRE(result.imported.notes.size() == 1);
  CHECK(result.imported.notes[0] ==
        folder.file("b.xml") + ":6: polygon \"line\": 2 distinct points, at least 3 are needed: skipped");
  // Whole metres about everything: the church in the upper right, the vehicle "d" in the lower left.
  REQUIRE(scene.bounds);
  CHECK(scene.bounds->max == Vec3(111, 209, 0));
  CHECK(scene.bounds->min == Vec3(0, -1, 0));
}

TEST_CASE("vehicles and persons: places, headings, coming and going") {
  const TemporaryFolder folder;
  const Result result = import({}, folder);
  REQUIRE(result.frames.size() == 4);
  CHECK(result.imported.frames == 4);
  CHECK(result.imported.movers == 4);
  const Frame& first = result.frames[0];
  CHECK(first.time == 10.0);
  REQUIRE(first.add.size() == 3);
  // East: the box's centre is half a length west of the bumper.
  CHECK(first.add[0].object.id == 2);
  CHECK(first.add[0].name == "a");
  CHECK(first.add[0].heading == 0.0);
  CHECK(first.add[0].object.pose.position == Vec3(47.5, 60, 0));
  CHECK(first.add[0].object.max_speed == 60.0);
  CHECK(std::get<Rectangle>(first.add[0].object.shape).size == Vec2(5.0, 1.8));
  // North.
  CHECK(first.add[1].name == "b & c");
  CHECK(*first.add[1].heading == doctest::Approx(0.5 * std::numbers::pi));
  CHECK(first.add[1].object.pose.position.x == doctest::Approx(70.0));
  CHECK(first.add[1].object.pose.position.y == doctest::Approx(57.5));
  // A person is where SUMO says, and is not the vehicle of the same name.
  CHECK(first.add[2].object.id == 4);
  CHECK(first.add[2].object.pose.position == Vec3(20, 30, 0));
  CHECK(std::get<Disc>(first.add[2].object.shape).radius == 0.25);
  CHECK(first.add[2].object.max_speed == 10.0);
  // An empty step removes all.
  CHECK(result.frames[1].remove == std::vector<ObjectId>{2, 3, 4});
  CHECK(result.frames[1].set.empty());
  // "a" comes back under its id, "d" is new.
  REQUIRE(result.frames[2].add.size() == 2);
  CHECK(result.frames[2].add[0].object.id == 2);
  CHECK(result.frames[2].add[1].object.id == 5);
  CHECK(*result.frames[2].add[1].heading == doctest::Approx(std::numbers::pi));
  CHECK(result.frames[2].add[1].object.pose.position.x == doctest::Approx(3.5));
  // A vehicle that stays is set.
  REQUIRE(result.frames[3].set.size() == 1);
  CHECK(result.frames[3].set[0].id == 2);
  CHECK(result.frames[3].set[0].position->y == doctest::Approx(58.5));
  CHECK(result.frames[3].add[0].object.id == 4);
  CHECK(result.frames[3].remove == std::vector<ObjectId>{5});
}

TEST_CASE("the frames of an import apply, and read back from their files") {
  const TemporaryFolder folder;
  const Result result = import({.range = 50.0}, folder);
  World world(parse_scene(scene_text(result.imported.scene), "scene"));
  for (const Frame& frame : result.frames) world.apply(parse_frame(frame_text(frame, 2), 2, ""));
  CHECK(world.objects().size() == 4);
  REQUIRE(world.views().size() == 1);
  CHECK(world.views()[0].rides == 2);
  CHECK(world.views()[0].range == 50.0);
}

TEST_CASE("who carries a viewer") {
  const TemporaryFolder folder;
  SumoOptions options;
  SUBCASE("all vehicles") {
    const Result r = import(options, folder);
    CHECK(viewers_of(r.frames[0]) == std::vector<ViewerId>{2, 3});
    CHECK(r.frames[1].drop_viewers == std::vector<ViewerId>{2, 3});
    CHECK(viewers_of(r.frames[2]) == std::vector<ViewerId>{2, 5});
    CHECK(r.frames[3].drop_viewers == std::vector<ViewerId>{5});
  }
  SUBCASE("a number, filled up by the lowest ids") {
    options.viewers = parse_viewer_choice("1");
    const Result r = import(options, folder);
    CHECK(viewers_of(r.frames[0]) == std::vector<ViewerId>{2});
    CHECK(viewers_of(r.frames[2]) == std::vector<ViewerId>{2});
    CHECK(viewers_of(r.frames[3]).empty());
  }
  SUBCASE("a number: the next vehicle takes over") {
    options.viewers = parse_viewer_choice("1");
    const Result r =
        import(options, folder,
               with(fcd, "<timestep time=\"10.50\"/>",
                    "<timestep time=\"10.50\"><vehicle id=\"b &amp; c\" x=\"1\" y=\"1\" angle=\"0\"/></timestep>"));
    CHECK(r.frames[1].drop_viewers == std::vector<ViewerId>{2});
    CHECK(viewers_of(r.frames[1]) == std::vector<ViewerId>{3});
  }
  SUBCASE("chosen ones, persons too") {
    options.viewers = parse_viewer_choice("a");
    const Result r = import(options, folder);
    CHECK(viewers_of(r.frames[0]) == std::vector<ViewerId>{2, 4});
  }
  SUBCASE("nobody") {
    options.viewers = parse_viewer_choice("0");
    for (const Frame& frame : import(options, folder).frames) CHECK(frame.viewers.empty());
  }
  SUBCASE("one that never comes") {
    options.viewers = parse_viewer_choice("a,zeppelin");
    CHECK(refusal(ErrorCode::usage, [&] { import(options, folder); }) ==
          "viewers: expected ids that the file has, found \"zeppelin\", which never appears");
  }
}

TEST_CASE("the choice of viewers on the command line") {
  CHECK(parse_viewer_choice("all").all);
  CHECK(parse_viewer_choice("40").count == 40u);
  CHECK(parse_viewer_choice("17,veh9").names == std::vector<std::string>{"17", "veh9"});
  CHECK(parse_viewer_choice("17,").names == std::vector<std::string>{"17"});
  for (const char* bad : {"", ",", "a,,b", ",a"}) CHECK_THROWS_AS(parse_viewer_choice(bad), Error);
}

TEST_CASE("a box leaves out what is outside, step by step") {
  const TemporaryFolder folder;
  SumoOptions options;
  options.box = {0.0, 0.0, 60.0, 65.0};
  const Result r = import(options, folder);
  REQUIRE(r.imported.scene.objects.size() == 1);
  CHECK(r.imported.scene.objects[0].name == "house");
  CHECK(r.imported.scene.objects[0].object.id == 0);
  CHECK(r.imported.scene.bounds->min == Vec3(0, 0, 0));
  CHECK(r.imported.scene.bounds->max == Vec3(60, 65, 0));
  // "b & c" at x = 70 is left out and gets no id.
  REQUIRE(r.frames[0].add.size() == 2);
  CHECK(r.frames[0].add[1].object.id == 2);
  CHECK(r.imported.movers == 3);
}

TEST_CASE("a byte order mark and Windows' line ends change nothing") {
  const TemporaryFolder folder;
  const auto frames_of = [&](const std::string& steps) {
    std::string text;
    for (const Frame& frame : import({}, folder, steps).frames) text += frame_text(frame, 2) + "\n";
    return text;
  };
  std::string windows = "\xEF\xBB\xBF";
  for (const char c : fcd) windows += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(frames_of(windows) == frames_of(fcd));
}

TEST_CASE("every second step") {
  const TemporaryFolder folder;
  SumoOptions options;
  options.every = 2;
  const Result r = import(options, folder);
  REQUIRE(r.frames.size() == 2);
  CHECK(r.frames[1].time == 11.0);
  CHECK(r.frames[1].set.size() == 1);
  CHECK(r.frames[1].remove == std::vector<ObjectId>{3, 4});
}

TEST_CASE("floating-car data cut anywhere are refused") {
  const TemporaryFolder folder;
  const std::size_t whole = fcd.find("</fcd-export>") + std::string("</fcd-export>").size();
  for (std::size_t size = 0; size < whole; ++size) {
    const std::string line = refusal(ErrorCode::bad_message, [&] { import({}, folder, fcd.substr(0, size)); });
    CAPTURE(size);
    CAPTURE(line);
    REQUIRE(line.starts_with(folder.file("fcd.xml") + ":"));
    REQUIRE(line.ends_with(", found the end of the file (cut short?)"));
  }
  CHECK(refusal(ErrorCode::bad_message, [&] { import({}, folder, fcd.substr(0, fcd.find("52.00"))); }) ==
        folder.file("fcd.xml") + ":10: expected the end of <timestep>, found the end of the file (cut short?)");
}

TEST_CASE("bad floating-car data are refused by line") {
  const TemporaryFolder folder;
  const auto said = [&](const char* from, const char* to) {
    return refusal(ErrorCode::bad_message, [&] { import({}, folder, with(fcd, from, to)); })
        .substr(folder.file("fcd.xml").size());
  };
  CHECK(said("y=\"60.00\" z", "y=\"nan\" z") ==
        ":5: <vehicle>: attribute \"y\": expected a number of magnitude at most 1e9, found \"nan\"");
  CHECK(said("y=\"60.00\" z", "z") == ":5: <vehicle>: missing attribute \"y\"");
  CHECK(said("x=\"70.00\"", "x=\"7e99\"").starts_with(":6: <vehicle>: attribute \"x\""));
  CHECK(said("angle=\"180.00\"", "angle=\"\"").starts_with(":7: <person>: attribute \"angle\""));
  CHECK(said("\"b &amp; c\"", "\"a\"").starts_with(":4: expected each id once in a step, found \"a\" twice"));
  CHECK(said("11.50", "11.00") == ":14: expected a time after 11, found 11");
  CHECK(said("time=\"11.50\"", "time=\"0:01:00\"").starts_with(":14: <timestep>: attribute \"time\""));
  CHECK(said("<vehicle id=\"d\"", "<vehicle id=\"d").starts_with(":1"));
  CHECK(said("<fcd-export>", "<routes>") == ":3: expected XML with the element <fcd-export>, found something else");
  CHECK(said("<timestep time=\"10.50\"/>", "<step/>") ==
        ":9: expected <timestep> or </fcd-export>, found something else");
}

TEST_CASE("bad buildings and options are refused") {
  const TemporaryFolder folder;
  const auto said = [&](const char* from, const char* to) {
    return refusal(ErrorCode::bad_message, [&] { import({}, folder, fcd, with(buildings, from, to)); })
        .substr(folder.file("b.xml").size());
  };
  CHECK(said("0,0,5 10", "0;0 10") ==
        ":7: polygon \"house\": expected a point x,y of magnitude at most 1e9, found \"0;0\"");
  CHECK(said("</additional>", "").starts_with(":"));
  CHECK(holds(said("<additional>", "<net>") + said("<poly id=\"lake\"", "<poly id=\"lake"), "expected XML"));
  const auto refused = [&](const SumoOptions& options) {
    return refusal(ErrorCode::usage, [&] { import(options, folder); });
  };
  CHECK(refused({.box = {{5.0, 0.0, 5.0, 9.0}}}).starts_with("box: "));
  CHECK(refused({.range = 0.0}).starts_with("range: "));
  CHECK(refused({.vehicle_size = {5.0, -1.0}}).starts_with("vehicle-size: width"));
  CHECK(refused({.every = 0}).starts_with("every: "));
  SumoOptions missing;
  missing.fcd = folder.file("none.xml");
  CHECK(
      holds(refusal(ErrorCode::io, [&] { import_sumo(missing, [](const Frame&) {}); }), "none.xml: cannot be opened"));
}

TEST_CASE("the town of Bad Hersfeld imports and applies") {
  const char* data = std::getenv("GRIDCULL_DATA");
  if (!data) {
    MESSAGE("skipped: the environment variable GRIDCULL_DATA does not name the folder of the real data");
    return;
  }
  SumoOptions options;
  options.fcd = std::string(data) + "/bad-hersfeld/fcd.xml.gz";
  options.buildings = std::string(data) + "/bad-hersfeld/buildings.poly.xml";
  options.viewers = parse_viewer_choice("40");
  std::vector<Frame> frames;
  const Imported imported = import_sumo(options, [&](const Frame& frame) { frames.push_back(frame); });
  CHECK(imported.scene.objects.size() + imported.notes.size() == 1856);
  CHECK(frames.size() == 300);
  World world(imported.scene);
  for (const Frame& frame : frames) {
    world.apply(frame);
    CHECK(world.views().size() == 40);
  }
  CHECK(world.objects().size() > imported.scene.objects.size() + 300);
}

TEST_CASE("with a height the world is 3D: prisms, boxes that stand on the ground, drivers' eyes") {
  const TemporaryFolder folder;
  std::string polygons = buildings;
  const std::string house = R"(shape="0,0,5 10,0,5 10,8,5 0,8,5"/>)";
  polygons.replace(polygons.find(house), house.size(),
                   R"(shape="0,0 10,0 10,8 0,8"><param key="height" value="12.5"/></poly>)");
  SumoOptions options;
  options.height = 9.0;
  const Result result = import(options, folder, fcd, polygons);
  const Scene& scene = result.imported.scene;
  CHECK(scene.dimension == 3);
  CHECK(sumo_dimension(options) == 3);
  REQUIRE(scene.objects.size() == 2);
  CHECK(std::get<Prism>(scene.objects[0].object.shape).height == 9.0);
  CHECK(std::get<Prism>(scene.objects[1].object.shape).height == 12.5);
  CHECK(!scene.bounds);  // derived, so that cells begin at the ground
  const Frame& first = result.frames[0];
  CHECK(std::get<Cuboid>(first.add[0].object.shape).size == Vec3(5.0, 1.8, 1.5));
  CHECK(first.add[0].object.pose.position == Vec3(47.5, 60, 0.75));
  CHECK(std::get<Cuboid>(first.add[2].object.shape).size == Vec3(0.5, 0.5, 1.75));
  REQUIRE(first.viewers.size() == 2);
  CHECK(first.viewers[0].offset->z == doctest::Approx(0.45));
  World world(scene);
  for (const Frame& frame : result.frames) world.apply(frame);

  polygons.replace(polygons.find("12.5"), 4, "tall");
  CHECK(holds(refusal(ErrorCode::bad_message, [&] { import(options, folder, fcd, polygons); }),
              "expected a height above 0, at most 1e9, found \"tall\""));
}

TEST_CASE("static objects of another scene come first, and make the world theirs") {
  const TemporaryFolder folder;
  SumoOptions options;
  options.statics = folder.with("model.json", R"({"format": "gridcull.scene/1", "dimension": 3, "objects": [
    {"id": 4, "static": true, "shape": {"type": "sphere", "radius": 2}, "position": [30, 30, 2]},
    {"id": 9, "shape": {"type": "sphere", "radius": 2}, "position": [3, 3, 2]}], "viewers": []})");
  const Result result = import(options, folder);
  REQUIRE(result.imported.scene.objects.size() == 3);
  CHECK(result.imported.scene.dimension == 3);
  CHECK(result.imported.scene.objects[0].object.id == 4);
  CHECK(result.imported.scene.objects[1].object.id == 5);
  CHECK(std::get<Prism>(result.imported.scene.objects[1].object.shape).height == 10.0);
  CHECK(result.frames[0].add[0].object.id == 7);
  options.statics =
      folder.with("flat.json", R"({"format": "gridcull.scene/1", "dimension": 2, "objects": [], "viewers": []})");
  options.height = 3.0;
  CHECK(holds(refusal(ErrorCode::usage, [&] { import(options, folder); }), "static: expected a 3D scene"));
}
