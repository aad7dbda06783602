#include <cstdlib>
#include <numbers>

#include <doctest/doctest.h>

#include "gridcull/sim/import_petrack.h"
#include "gridcull/sim/world.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

struct Result {
  Imported imported;
  std::vector<Frame> frames;
};

Result import(const std::string& text, PetrackOptions options = {}) {
  const TemporaryFolder folder;
  options.trajectories = folder.with("t.txt", text);
  Result out;
  out.imported = import_petrack(options, [&](const Frame& frame) { out.frames.push_back(frame); });
  return out;
}

const std::string header = "# by hand\n# framerate: 10 fps\n# id frame x/m y/m z/m\n";

}  // namespace

TEST_CASE("rows in any order become frames") {
  const Result r =
      import(header + "7\t1\t1.5\t2\t1.7\n7 0 1 2 1.7\n3 1 5 5 1.8\n7 3 2 3 1.7\n3 2 5 5 1.8\n3 3 5 5 1.8\n");
  CHECK(r.imported.frames == 4);
  CHECK(r.imported.movers == 2);
  CHECK(r.imported.scene.objects.empty());
  CHECK(r.imported.scene.bounds->min == Vec3(0, 1, 0));
  CHECK(r.imported.scene.bounds->max == Vec3(6, 6, 0));
  REQUIRE(r.frames.size() == 4);
  CHECK(r.frames[0].time == 0.0);
  CHECK(r.frames[1].time == 0.1);
  CHECK(r.frames[0].add.at(0).object.id == 7);
  CHECK(r.frames[0].add.at(0).name == "7");
  CHECK(r.frames[0].add.at(0).object.max_speed == 5.0);
  CHECK(std::get<Disc>(r.frames[0].add.at(0).object.shape).radius == 0.25);
  CHECK(r.frames[1].set.at(0).position == Vec3(1.5, 2, 0));
  // Person 7 is missing in frame 2.
  CHECK(r.frames[2].remove == std::vector<ObjectId>{7});
  CHECK(r.frames[2].drop_viewers == std::vector<ViewerId>{7});
  CHECK(r.frames[3].add.at(0).object.id == 7);
  World world(r.imported.scene);
  for (const Frame& frame : r.frames) world.apply(frame);
  REQUIRE(world.views().size() == 2);
  CHECK(world.views()[0].range == 25.0);
  CHECK(world.views()[0].fov == doctest::Approx(170.0 * std::numbers::pi / 180.0));
}

TEST_CASE("headings follow the motion and are kept while standing") {
  std::string rows = header;
  const auto row = [&](int frame, double x, double y) {
    rows += "1 " + std::to_string(frame) + " " + std::to_string(x) + " " + std::to_string(y) + " 0\n";
  };
  for (int f = 0; f < 10; ++f) row(f, 0.0, 0.0);             // stands
  for (int f = 10; f < 20; ++f) row(f, 0.0, (f - 9) * 1.0);  // walks north
  for (int f = 20; f < 30; ++f) row(f, 0.0, 10.0);           // stands again
  const Result r = import(rows);
  CHECK(*r.frames[0].add.at(0).heading == 1.570796);
  for (std::size_t f = 1; f < 30; ++f) CHECK(*r.frames[f].set.at(0).heading == 1.570796);
}

TEST_CASE("centimetres") {
  const Result r = import("# framerate: 16.0\n# id frame x/cm y/cm z/cm\n1 8 250 -50 170\n");
  CHECK(r.frames[0].time == 0.5);
  CHECK(r.frames[0].add.at(0).object.pose.position == Vec3(2.5, -0.5, 0));
  // As an editor on Windows leaves it.
  const Result same = import("\xEF\xBB\xBF# framerate: 16.0\r\n# id frame x/cm y/cm z/cm\r\n1 8 250 -50 170\r\n");
  CHECK(same.frames[0].time == 0.5);
}

TEST_CASE("bad trajectories are refused by line") {
  const auto said = [](const std::string& text, ErrorCode code = ErrorCode::bad_message) {
    const std::string line = refusal(code, [&] { import(text); });
    const std::size_t name = line.find("t.txt");
    return name == std::string::npos ? line : line.substr(name);
  };
  CHECK(said("") == "t.txt: expected header lines and rows, found an empty file");
  CHECK(said("# id frame x/m y/m\n1 0 0 0\n").starts_with("t.txt:2: expected a header line \"# framerate"));
  CHECK(said("# framerate: 25\n1 0 0 0\n").starts_with("t.txt:2: expected a header line that names the unit"));
  CHECK(said("# framerate: 0 fps\n").starts_with("t.txt:1: expected a frame rate above 0"));
  CHECK(said("# framerate: fast\n").starts_with("t.txt:1: expected a frame rate above 0"));
  CHECK(said(header + "1 0 0\n").starts_with("t.txt:4: expected a row \"id frame x y z\", found \"1 0 0\""));
  CHECK(said(header + "1 0 0 nan 0\n")
            .starts_with("t.txt:4: expected a coordinate of magnitude at most 1e9, found \"nan\""));
  CHECK(said(header + "1 0 1e300 0 0\n").starts_with("t.txt:4: expected a coordinate"));
  CHECK(said(header + "-1 0 0 0 0\n").starts_with("t.txt:4: expected an id"));
  CHECK(said(header + "1 0.5 0 0 0\n").starts_with("t.txt:4: expected a frame"));
  CHECK(said(header + "1 0 0 0 0\n2 0 0 0 0\n1 0 3 0 0\n") ==
        "t.txt:6: expected a person once in a frame, found id 1 twice in frame 0");
  CHECK(refusal(ErrorCode::usage, [] { import(header, {.radius = 0.0}); }).starts_with("radius: "));
  CHECK(refusal(ErrorCode::usage, [] { import(header, {.fov_degrees = 400.0}); }).starts_with("fov-degrees: "));
}

TEST_CASE("a header without rows is an empty world") {
  const Result r = import(header);
  CHECK(r.frames.empty());
  CHECK_FALSE(r.imported.scene.bounds);
}

TEST_CASE("the bottleneck imports and applies") {
  const char* data = std::getenv("GRIDCULL_DATA");
  if (!data) {
    MESSAGE("skipped: the environment variable GRIDCULL_DATA does not name the folder of the real data");
    return;
  }
  PetrackOptions options;
  options.trajectories = std::string(data) + "/bottleneck/040_c_56_h.txt";
  options.viewers = parse_viewer_choice("10");
  std::vector<Frame> frames;
  const Imported imported = import_petrack(options, [&](const Frame& frame) { frames.push_back(frame); });
  CHECK(imported.movers == 75);
  World world(imported.scene);
  for (const Frame& frame : frames) {
    world.apply(frame);
    CHECK(world.views().size() == std::min<std::size_t>(10, world.objects().size()));
  }
}
