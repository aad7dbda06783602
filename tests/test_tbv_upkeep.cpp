// The figure tbv-upkeep on small worlds: the tape, the three indexes on it, the files. The command: tests/cli/bench.sh.
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/service/bench_figure.h"
#include "gridcull/service/tbv_bench.h"
#include "gridcull/service/tbv_replay.h"
#include "gridcull/service/tbv_tape.h"

using namespace gridcull;

namespace {

TbvTape small_tape(const std::string& scene, std::uint64_t frames) {
  return record_tbv_tape(open_bench_scene(scene), frames, [] {});
}

/// Volumes come, are renewed and go in an order that makes sense; their number is what is said.
void expect_consistent(const TbvTape& tape) {
  std::vector<std::uint8_t> there(tape.slots, 0);
  for (const TbvTape::Frame& frame : tape.frames) {
    for (const Slot slot : frame.removed) REQUIRE(there[slot]-- == 1);
    for (const TbvTape::Volume& volume : frame.born) REQUIRE(there[volume.slot]++ == 0);
    for (const TbvTape::Volume& volume : frame.renewed) REQUIRE(there[volume.slot] == 1);
    for (const Slot slot : frame.revealed) REQUIRE(there[slot] == 1);
    CHECK(static_cast<std::size_t>(std::count(there.begin(), there.end(), 1)) == frame.hidden);
    CHECK_FALSE(frame.looks.empty());
    for (const TbvTape::Look& look : frame.looks) REQUIRE((look.bits & ~tape.lattice.brick_cells(look.brick)) == 0);
  }
}

}  // namespace

TEST_CASE("tbv-upkeep: every index reveals what the engine revealed") {
  for (const char* scene : {"city:6:150", "spheres:800:cell=1"}) {
    CAPTURE(scene);
    const TbvTape tape = small_tape(scene, 40);
    REQUIRE(tape.frames.size() == 40);
    expect_consistent(tape);
    std::size_t renewed = 0, revealed = 0, ticks = 0;
    for (const TbvTape::Frame& frame : tape.frames) renewed += frame.renewed.size(), revealed += frame.revealed.size();
    CHECK(renewed > 100);
    CHECK(revealed > 10);
    const TbvCosts costs = replay_tbv_tape(tape, 10, 2, [&ticks] { ++ticks; });
    CHECK(ticks == 2 * 3 * 40);
    for (const TbvCost& cost : costs.of) {
      CHECK(cost.upkeep.frames() == 40);
      CHECK(cost.written > 0);
      CHECK(cost.visited > 0);
      CHECK(cost.looked_at > 0);
      CHECK(cost.bytes > 0);
    }
    const TbvCosts again = replay_tbv_tape(tape, 10, 1, [] {});
    for (std::size_t i = 0; i < costs.of.size(); ++i) {
      CHECK(costs.of[i].written == again.of[i].written);
      CHECK(costs.of[i].visited == again.of[i].visited);
      CHECK(costs.of[i].looked_at == again.of[i].looked_at);
    }
    CHECK(costs.tree_cost < 2.0 * costs.fresh_tree_cost);
  }
}

TEST_CASE("tbv-upkeep: an index that reveals something else is an error") {
  TbvTape tape = small_tape("city:6:150", 20);
  const auto some =
      std::find_if(tape.frames.begin(), tape.frames.end(), [](const auto& f) { return !f.revealed.empty(); });
  REQUIRE(some != tape.frames.end());
  some->revealed.pop_back();
  CHECK_THROWS_AS(replay_tbv_tape(tape, 0, 1, [] {}), std::logic_error);
}

TEST_CASE("tbv-upkeep: tapes are of 3D scenes with one viewer") {
  CHECK_THROWS_AS(small_tape("discs:20", 2), Error);
  CHECK_THROWS_AS(small_tape("city:4:20:viewers=2", 2), Error);
}

TEST_CASE("tbv-upkeep: a CSV line an index, a chart a family") {
  TbvSettings settings;
  settings.scenes = {"city:4:40", "city:4:80", "spheres:200:cell=1"};
  settings.frames = 12;
  settings.first = 4;
  settings.repeats = 1;
  std::vector<TbvResult> results;
  std::uint64_t ticks = 0;
  for (const std::string& scene : settings.scenes) results.push_back(run_tbv_scene(scene, settings, [&] { ++ticks; }));
  CHECK(ticks == tbv_ticks(settings));
  CHECK(results[0].frames == 8);
  CHECK(results[0].family == results[1].family);
  std::istringstream csv(tbv_csv(results));
  std::vector<std::string> lines;
  for (std::string line; std::getline(csv, line);) lines.push_back(line);
  REQUIRE(lines.size() == 1 + 3 * 3);
  for (const std::string& line : lines) {
    CAPTURE(line);
    CHECK(std::count(line.begin(), line.end(), ',') == std::count(lines[0].begin(), lines[0].end(), ','));
  }
  const std::vector<Chart> charts = tbv_charts(results);
  REQUIRE(charts.size() == 2);
  CHECK(charts[0].name == "tbv-upkeep");
  CHECK(charts[1].name == "tbv-upkeep-spheres");
  for (const char* curve : {"grid, upkeep", "octree, look-up", "volume tree, upkeep"}) {
    CHECK(charts[0].script.find(curve) != std::string::npos);
  }
  for (const char* fact : {"# commit: ", "# compiler: ", "# flags: ", "# processor: "}) {
    CHECK(tbv_head(settings).find(fact) != std::string::npos);
  }
}
