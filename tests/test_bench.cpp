// The pieces of `gridcull bench`: names of scenes, statistics, CSV, charts. The command itself: tests/cli/bench.sh.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/service/bench_charts.h"
#include "gridcull/service/bench_contender.h"
#include "gridcull/service/bench_course.h"
#include "gridcull/service/bench_report.h"
#include "gridcull/service/bench_run.h"
#include "gridcull/service/bench_sample.h"
#include "gridcull/service/bench_scene.h"
#include "gridcull/service/resolution.h"
#include "sim_helpers.h"

using namespace gridcull;

namespace {

BenchSceneResult small_result(const std::string& scene) {
  const BenchScene opened = open_bench_scene(scene);
  BenchChoice choice;
  choice.methods = {"frustum", "pairwise-rays"};
  choice.threads = {1};
  BenchSettings settings;
  settings.frames = 12;
  settings.repeats = 2;
  settings.judged = 2;
  int ticks = 0;
  const auto contenders = choose_contenders(opened, choice);
  BenchSceneResult result = run_bench_scene(opened, contenders, settings, [&ticks] { ++ticks; });
  CHECK(ticks == 2 * 2 * 12);
  return result;
}

std::size_t commas(const std::string& line) {
  return static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
}

}  // namespace

TEST_CASE("bench: scenes by name, with parameters") {
  const BenchSceneName city = parse_bench_scene("city:12:300:viewers=4:range=90.5:seed=7");
  CHECK(city.kind == "city");
  CHECK(city.options.blocks == 12u);
  CHECK(city.options.count == 300u);
  CHECK(city.options.viewers == 4u);
  CHECK(city.options.range == 90.5);
  CHECK(city.options.seed == 7u);
  CHECK(parse_bench_scene("discs").options.count == std::nullopt);
  CHECK(parse_bench_scene("maze:9:cell=0.25").options.cell == 0.25);
  CHECK(parse_bench_scene("spheres:10:hidden=20").hidden == 20u);
  const BenchSceneName files = parse_bench_scene("here/s.json@there/f.jsonl.gz");
  CHECK(files.kind.empty());
  CHECK(files.scene_path == "here/s.json");
  CHECK(files.frames_path == "there/f.jsonl.gz");
  for (const char* bad : {"volcano", "spheres:x", "spheres:1:2", "city:1:2:3", "discs:-1", "discs:5:wind=3",
                          "discs:5:hidden=3", "spheres:5:hidden=", "town:5:range=far", ""}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(parse_bench_scene(bad), Error);
  }
}

TEST_CASE("bench: scenes of a family differ in one thing") {
  const BenchScene a = open_bench_scene("town:20:viewers=1:range=50"),
                   b = open_bench_scene("town:20:viewers=3:range=50"),
                   c = open_bench_scene("town:40:viewers=1:range=50");
  CHECK(a.family_of_viewers() == b.family_of_viewers());
  CHECK(a.family_of_viewers() != c.family_of_viewers());
  CHECK(a.family_of_objects() == c.family_of_objects());
  CHECK(a.family_of_objects() != b.family_of_objects());
}

TEST_CASE("bench: hidden movers stay hidden inside their box") {
  const BenchScene scene = open_bench_scene("spheres:50:hidden=30");
  CHECK(scene.scene.objects.size() == 81);
  Course course(scene, 100);
  std::uint64_t frames = 0;
  for (CourseFrame frame; course.next(frame); ++frames) {
    for (const auto& [id, pose] : frame.moved) {
      if (id <= 50) continue;
      CHECK(std::fabs(pose.position.x - 50.0) < 26.0 - 1.0);
      CHECK(std::fabs(pose.position.y - 50.0) < 26.0 - 1.0);
      CHECK(std::fabs(pose.position.z - 30.0) < 27.0 - 1.0);
    }
    if (frames > 0) CHECK(frame.moved.size() == 80);
  }
  CHECK(frames == 100);
}

TEST_CASE("bench: every other frame is told what happened in between") {
  const test::TemporaryFolder folder;
  const std::string scene = folder.with("scene.json",
                                        R"({"format": "gridcull.scene/1", "dimension": 2, "objects": [
        {"id": 1, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]},
        {"id": 2, "shape": {"type": "disc", "radius": 1}, "position": [5, 0]}], "viewers": [{"id": 7, "follows": 1}]})");
  const std::string frames = folder.with("frames.jsonl", R"({"format": "gridcull.frames/1"}
{"time": 0}
{"time": 1, "remove": [2], "add": [{"id": 3, "shape": {"type": "disc", "radius": 1}, "position": [8, 8]}], "set": [{"id": 1, "position": [1, 0]}]}
{"time": 2, "add": [{"id": 4, "shape": {"type": "disc", "radius": 1}, "position": [9, 9]}], "set": [{"id": 1, "position": [2, 0]}, {"id": 3, "position": [7, 8]}]}
{"time": 3, "remove": [3], "add": [{"id": 2, "shape": {"type": "disc", "radius": 2}, "position": [3, 3]}, {"id": 5, "shape": {"type": "disc", "radius": 1}, "position": [4, 4]}]}
{"time": 4, "remove": [5], "set": [{"id": 2, "position": [2, 2]}, {"id": 4, "position": [1, 9]}]}
{"time": 5, "set": [{"id": 1, "position": [9, 0]}]}
)");
  const BenchScene opened = open_bench_scene(scene + "@" + frames);
  Course course(opened, 10, 2);
  CourseFrame frame;
  REQUIRE(course.next(frame));
  CHECK(frame.time == 0.0);
  REQUIRE(course.next(frame));
  CHECK(frame.number == 1);
  CHECK(frame.time == 2.0);
  CHECK(frame.removed == std::vector<ObjectId>{2});
  REQUIRE(frame.added.size() == 2);  // 3, where it went since, and 4
  CHECK(frame.added[0].pose.position == Vec3(7.0, 8.0, 0.0));
  REQUIRE(frame.moved.size() == 1);
  CHECK(frame.moved[0].pose.position == Vec3(2.0, 0.0, 0.0));
  REQUIRE(frame.views.size() == 1);
  CHECK(frame.views[0].pose.position == Vec3(2.0, 0.0, 0.0));
  REQUIRE(course.next(frame));
  CHECK(frame.time == 4.0);
  CHECK(frame.removed == std::vector<ObjectId>{3});
  REQUIRE(frame.added.size() == 1);  // 2 is back; 5 came and went
  CHECK(frame.added[0].id == 2);
  CHECK(frame.added[0].pose.position == Vec3(2.0, 2.0, 0.0));
  REQUIRE(frame.moved.size() == 1);
  CHECK(frame.moved[0].object == 4);
  CHECK_FALSE(course.next(frame));  // one frame is left, and two were asked for
}

TEST_CASE("bench: a scene without frames is asked as it stands") {
  const test::TemporaryFolder folder;
  BenchScene opened = open_bench_scene(folder.with(
      "scene.json",
      R"({"format": "gridcull.scene/1", "dimension": 2, "objects": [], "viewers": [{"id": 7, "position": [1, 2]}]})"));
  for (const std::uint64_t still : {std::uint64_t{0}, std::uint64_t{4}}) {
    opened.still = still;
    Course course(opened, 10);
    std::uint64_t frames = 0;
    for (CourseFrame frame; course.next(frame); ++frames) {
      CHECK(frame.time == 0.1 * static_cast<double>(frames));
      CHECK(frame.views.size() == 1);
      CHECK(frame.moved.empty());
    }
    CHECK(frames == (still == 0 ? 1 : 4));
  }
}

TEST_CASE("bench: the least over repeats, then over frames") {
  TimeSamples samples;
  CHECK(samples.summary(0).median == 0.0);
  for (const double noise : {5.0, 0.0, 9.0}) {
    for (std::size_t frame = 0; frame < 5; ++frame) samples.add(frame, 100.0 * static_cast<double>(5 - frame) + noise);
  }
  const TimeSamples::Summary all = samples.summary(0), rest = samples.summary(1);
  CHECK(all.min == 100.0);
  CHECK(all.median == 300.0);
  CHECK(all.max == 500.0);
  CHECK(all.median_all == 305.0);
  CHECK(rest.median == 250.0);
  CHECK(rest.max == 400.0);
  CHECK(samples.steady().median == rest.median);
  CHECK(samples.least(0) == 500.0);
  CHECK(samples.summary(9).median == 0.0);
}

TEST_CASE("--resolution is R or WxH") {
  CHECK(parse_resolution("256").edge == 256);
  CHECK(parse_resolution("42x24").width == 42);
  CHECK(parse_resolution("42x24").height == 24);
  CHECK(resolution_text(parse_resolution("8192x1")) == "8192x1");
  CHECK(resolution_text({}) == "auto");
  for (const char* bad :
       {"", "0", "7", "-1", "8193", "x", "3x", "x3", "3x0", "3x4x5", "3.5", " 3", "1e3", "99999999999"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(parse_resolution(bad), Error);
  }
  MethodOptions options;
  CHECK_THROWS_AS(apply_resolution({.edge = 64}, find_method("depth-rays"), options), Error);
  apply_resolution({.width = 64, .height = 32}, find_method("depth-rays"), options);
  CHECK(options.rays_width == 64);
  CHECK(options.rays_height == 32);
}

TEST_CASE("bench: every method that takes the scene, one default on each curve") {
  const BenchScene flat = open_bench_scene("discs:20"), solid = open_bench_scene("spheres:20");
  for (const BenchScene* scene : {&flat, &solid}) {
    const auto contenders = choose_contenders(*scene, {});
    for (const MethodEntry& method : method_catalog()) {
      int defaults = 0;
      for (const Contender& c : contenders) defaults += c.method->info.name == method.info.name && c.is_default ? 1 : 0;
      CAPTURE(method.info.name);
      CHECK(defaults == ((scene->scene.dimension == 2 ? method.info.takes_2d : method.info.takes_3d) ? 1 : 0));
    }
  }
  BenchChoice choice;
  choice.methods = {"magic"};
  CHECK_THROWS_AS(choose_contenders(flat, choice), Error);
}

TEST_CASE("bench: rows, CSV and charts of a small run") {
  const std::vector<BenchSceneResult> results{small_result("discs:40"), small_result("discs:80")};
  for (const BenchSceneResult& result : results) {
    REQUIRE(result.rows.size() == 2);
    const BenchRow &loose = result.rows[0], &rays = result.rows[1];
    for (const BenchRow* row : {&loose, &rays}) {
      CHECK(row->refused.empty());
      CHECK(row->frames == 12);
      CHECK(row->repeats == 2);
      CHECK(row->total.frames() == 12);
      CHECK(row->verdict.queries == 2);
    }
    CHECK(loose.verdict.misses == 0);
    CHECK(loose.over_estimation() > 1.0);
    CHECK(rays.verdict.misses > 0);
    CHECK(rays.verdict.misses + rays.verdict.reported >= rays.verdict.exact);
    CHECK(loose.hash == result.rows[0].hash);
  }
  std::istringstream csv(bench_csv(results));
  std::string head, line;
  std::getline(csv, head);
  CHECK(head.starts_with("scene,dimension,objects,"));
  int lines = 0;
  for (; std::getline(csv, line); ++lines) CHECK(commas(line) == commas(head));
  CHECK(lines == 4);
  CHECK(bench_head({}).starts_with("# gridcull bench, "));
  const std::vector<Chart> charts = bench_charts(results);
  REQUIRE(charts.size() == 3);
  CHECK(charts[0].name == "accuracy-discs-40");
  CHECK(charts[2].name == "hidden-discs");
  CHECK(bench_table(results[0]).find("pairwise-rays") != std::string::npos);
}

TEST_CASE("bench: a field of CSV") {
  CHECK(csv_field("2 m") == "2 m");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("say \"no\"") == "\"say \"\"no\"\"\"");
}
