// Replay and statistics, against a culler that only writes down what it is told.
#include <map>
#include <utility>

#include <doctest/doctest.h>

#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"
#include "gridcull/sim/stats.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// Everything is visible to everybody. Keeps a world by what it is told, and a log.
class Recorder final : public Culler {
 public:
  const MethodInfo& info() const override { return info_; }
  void add(const Object& object) override {
    log += "add " + std::to_string(object.id) + "; ";
    objects.emplace(object.id, object);
  }
  void remove(ObjectId id) override {
    log += "remove " + std::to_string(id) + "; ";
    objects.erase(id);
  }
  void move(ObjectId id, const Pose& pose) override {
    log += "move " + std::to_string(id) + "; ";
    objects.at(id).pose = pose;
  }
  void set_source(PositionSource* source) override { source_ = source; }
  void announce_jump(ObjectId id) override { log += "jump " + std::to_string(id) + "; "; }
  void query(double time, std::span<const View> views, Answers& out) override {
    log += "query " + std::to_string(views.size()) + "; ";
    last_time = time;
    out.stats = {};
    out.stats.positions_read = 10;
    out.stats.total_us = static_cast<double>(++queries);
    if (source_) {
      for (auto& [id, object] : objects) {
        if (!object.is_static) object.pose = source_->pose(id);
      }
    }
    out.views.clear();
    for (const View& view : views) {
      Answer& answer = out.views.emplace_back();
      answer.viewer = view.viewer;
      for (const auto& [id, object] : objects) {
        if (id != view.rides) answer.visible.push_back(id);
      }
    }
  }
  bool pulls() const { return source_ != nullptr; }
  std::string take_log() { return std::exchange(log, ""); }

  std::map<ObjectId, Object> objects{};
  std::string log{};
  double last_time = -1.0;
  int queries = 0;

 private:
  MethodInfo info_{"recorder", "writes down", Guarantee::conservative, true, true, true};
  PositionSource* source_ = nullptr;
};

/// Frames from lines.
class Lines final : public FrameSource {
 public:
  explicit Lines(std::vector<std::string> lines) : lines_(std::move(lines)) {}
  bool next(Frame& out) override {
    if (at_ == lines_.size()) return false;
    out = parse_frame(lines_[at_++], 2, "f");
    return true;
  }

 private:
  std::vector<std::string> lines_;
  std::size_t at_ = 0;
};

const char* const town = R"({"format": "gridcull.scene/1", "dimension": 2, "objects": [
  {"id": 0, "static": true, "shape": {"type": "disc", "radius": 1}, "position": [1, 1]},
  {"id": 5, "shape": {"type": "disc", "radius": 1}, "position": [5, 5], "max_speed": 2},
  {"id": 6, "shape": {"type": "disc", "radius": 1}, "position": [9, 5]}],
  "viewers": [{"id": 1, "follows": 5}, {"id": 0, "position": [0, 0]}]})";

}  // namespace

TEST_CASE("without frames there is one, at time 0") {
  Recorder culler;
  Replay replay(culler, parse_scene(town, "s"), nullptr);
  CHECK(replay.next_frame() == 0);
  REQUIRE(replay.step());
  CHECK(culler.log == "add 0; add 5; add 6; query 2; ");
  CHECK(culler.last_time == 0.0);
  CHECK(replay.frame() == 0);
  REQUIRE(replay.answers().views.size() == 2);
  CHECK(replay.answers().views[0].viewer == 0);
  CHECK(replay.answers().views[0].visible == std::vector<ObjectId>{0, 5, 6});
  CHECK(replay.answers().views[1].visible == std::vector<ObjectId>{0, 6});
  CHECK(replay.views()[1].rides == 5);
  CHECK_FALSE(replay.step());
  CHECK(culler.queries == 1);
}

TEST_CASE("push: every move is told, in the order of the contract") {
  Recorder culler;
  Lines lines(
      {R"({"time": 1, "set": [{"id": 0, "position": [2, 2]}, {"id": 7, "position": [8, 8]}, {"id": 6, "heading": 1}],
                   "add": [{"id": 7, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}], "remove": [5]})",
       R"({"time": 2, "set": [{"id": 7, "position": [900, 8]}]})"});
  Replay replay(culler, parse_scene(town, "s"), &lines);
  culler.take_log();
  REQUIRE(replay.step());
  CHECK(culler.take_log() == "remove 5; add 7; move 0; move 6; query 1; ");
  CHECK(culler.objects.at(7).pose.position == Vec3(8, 8, 0));
  REQUIRE(replay.step());
  CHECK(culler.take_log() == "move 7; query 1; ");
  CHECK(replay.time() == 2.0);
  CHECK(replay.frame() == 1);
  CHECK_FALSE(replay.step());
}

TEST_CASE("pull: static objects are moved, jumps announced, the rest is asked for") {
  Recorder culler;
  Lines lines(
      {R"({"time": 1, "set": [{"id": 5, "position": [500, 5]}]})",
       R"({"time": 1.5, "set": [{"id": 5, "position": [501, 5]}, {"id": 0, "position": [3, 3]}, {"id": 6, "position": [90, 5]}]})",
       R"({"time": 2, "set": [{"id": 5, "position": [501, 6.000001]}]})",
       R"({"time": 4, "remove": [5], "set": [{"id": 5, "position": [0, 0]}],
                   "add": [{"id": 5, "shape": {"type": "disc", "radius": 1}, "position": [9, 9], "max_speed": 2}]})",
       R"({"time": 5})", R"({"time": 6, "set": [{"id": 5, "position": [3.9, 0]}]})"});
  {
    Replay replay(culler, parse_scene(town, "s"), &lines, Feed::pull);
    CHECK(culler.pulls());
    culler.take_log();
    const auto step = [&] {
      REQUIRE(replay.step());
      for (const Object& object : replay.world().objects()) {
        CHECK(culler.objects.at(object.id).pose.position == object.pose.position);
      }
      return culler.take_log();
    };
    CHECK(step() == "query 2; ");                   // before the first query nothing is known
    CHECK(step() == "move 0; query 2; ");           // 1 m in 0.5 s at 2 m/s is no jump; 6 has no max_speed
    CHECK(step() == "jump 5; query 2; ");           // a little more is
    CHECK(step() == "remove 5; add 5; query 2; ");  // new where it stands at the end of the frame
    CHECK(culler.objects.at(5).pose.position == Vec3(0, 0, 0));
    CHECK(step() == "query 2; ");
    // The time since the last frame counts, not since the last move.
    CHECK(step() == "jump 5; query 2; ");
    CHECK_FALSE(replay.step());
  }
  CHECK_FALSE(culler.pulls());
}

TEST_CASE("a refused frame reaches neither world nor culler") {
  Recorder culler;
  Lines lines({R"({"time": 1})", R"({"time": 2, "remove": [0], "set": [{"id": 77, "heading": 0}]})"});
  Replay replay(culler, parse_scene(town, "s"), &lines);
  REQUIRE(replay.step());
  culler.take_log();
  CHECK(
      holds(refusal(ErrorCode::unknown_object, [&] { replay.step(); }), "f: /set/0/id: expected the id of an object"));
  CHECK(culler.take_log() == "");
  CHECK(replay.world().has(0));
  CHECK(replay.time() == 1.0);
}

TEST_CASE("both feeds lead to the same world, and no generated mover jumps") {
  for (const std::string_view name : generated_scenes()) {
    GenerateOptions options;
    options.count = name == "maze" ? 5 : 40;
    options.blocks = 2;
    options.frames = 60;
    CAPTURE(std::string(name));
    Recorder pushed, pulled;
    const auto a = make_generator(name, options), b = make_generator(name, options);
    Replay push(pushed, a->scene(), a.get());
    Replay pull(pulled, b->scene(), b.get(), Feed::pull);
    while (push.step()) {
      REQUIRE(pull.step());
      for (const auto& [id, object] : pushed.objects) {
        REQUIRE(pulled.objects.at(id).pose.position == object.pose.position);
      }
    }
    CHECK_FALSE(pull.step());
    CHECK_FALSE(holds(pulled.log, "jump"));
    CHECK_FALSE(holds(pulled.log, "move"));
    CHECK(holds(pushed.log, "move"));
  }
}

TEST_CASE("statistics") {
  CHECK(spread_of({}).max == 0.0);
  CHECK(spread_of({7.0}).p99 == 7.0);
  CHECK(spread_of({4.0, 1.0, 2.0}).median == 2.0);
  CHECK(spread_of({4.0, 1.0, 2.0, 3.0}).median == 2.5);
  std::vector<double> hundred, two_hundred;
  for (int i = 1; i <= 200; ++i) (i <= 100 ? hundred : two_hundred).push_back(i);
  two_hundred.insert(two_hundred.end(), hundred.begin(), hundred.end());
  CHECK(spread_of(hundred).p99 == 99.0);
  CHECK(spread_of(two_hundred).p99 == 198.0);
  CHECK(spread_of(two_hundred).mean == 100.5);
  CHECK(spread_of(two_hundred).max == 200.0);
}

TEST_CASE("the statistics of a run, and their file") {
  Recorder culler;
  Lines lines({R"({"time": 1})", R"({"time": 2, "drop_viewers": [0]})", R"({"time": 3, "drop_viewers": [1]})"});
  Replay replay(culler, parse_scene(town, "s"), &lines);
  StatsCollector collector;
  StableHash hash;
  while (replay.step()) {
    collector.add(replay.answers(), 4 * replay.answers().views.size());
    for (const Answer& answer : replay.answers().views) hash.add(answer);
  }
  Stats stats = collector.stats();
  CHECK(stats.frames == 3);
  CHECK(stats.queries == 3);
  CHECK(stats.pvs_mean == doctest::Approx(7.0 / 3.0));
  CHECK(stats.in_view_mean == 4.0);
  CHECK(stats.positions_read_mean == 10.0);
  CHECK(stats.total_us.median == 2.0);
  CHECK(stats.pvs_hash == hash.value());
  CHECK(peak_memory_bytes() > 1'000'000);
  stats.method = "voxel";
  stats.cell = 2.0;
  stats.cells = {10, 20};
  stats.pvs_hash = 0xAB;
  const std::string text = stats_text(stats);
  CHECK(text.starts_with(
      R"({"format": "gridcull.stats/1", "method": "voxel", "threads": 1, "frames": 3, "queries": 3, "cell": 2, "cells": [10, 20],)"));
  CHECK(holds(text, R"("total": {"median": 2, "mean": 2, "p99": 3, "max": 3})"));
  CHECK(holds(text, R"("tbv": {"active_mean": 0, "revealed": 0, "expired": 0, "jumps": 0})"));
  CHECK(holds(text, R"("pvs_hash": "00000000000000ab")"));
  const TemporaryFolder folder;
  write_stats(folder.file("s.json"), stats);
  CHECK(content_of(folder.file("s.json")) == text);
  // A run without a single query divides by nothing.
  CHECK(StatsCollector().stats().pvs_mean == 0.0);
}
