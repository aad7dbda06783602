// Runs contenders on one scene, interleaved: short runs of frames in turn, so that what else the machine does hits all
// alike; the whole scene several times over.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gridcull/service/bench_contender.h"
#include "gridcull/service/bench_referee.h"
#include "gridcull/service/bench_sample.h"
#include "gridcull/service/bench_scene.h"

namespace gridcull {

struct BenchSettings {
  std::uint64_t frames = 40;  ///< at most, of each scene
  int repeats = 3;
  std::uint64_t judged = 3;  ///< frames held against the exact sets
  int rays = 256;            ///< 3D: along a frustum's height or a cube face's edge
  double seconds = 20.0;     ///< a contender that has used more on a scene ends its repeats early
  std::uint64_t every = 1;   ///< only the scene's frames 0, every, 2 every ... (Course)
  bool pull = false;         ///< methods ask for positions instead of being told of every move
  std::size_t run = 10;      ///< frames in a row, after which it is the next one's turn
};

/// One contender's result on one scene. Work counts are means per query, of the first repeat.
struct BenchRow {
  Contender contender{};
  std::string refused{};  ///< why it did not run; "" when it did
  int repeats = 0;        ///< whole ones, or 1 when the time ran out in the first
  std::uint64_t frames = 0, queries = 0;
  /// Microseconds a frame over all viewers: all a simulator pays (moves and query), and the share of each. The first
  /// frame, in which everything is built, is apart.
  TimeSamples total{}, moves{}, query{};
  double load_us = 0.0;  ///< making the method and adding the scene's objects, least over repeats
  BenchVerdict verdict{};
  std::uint64_t memory_bytes = 0;  ///< growth while it was made and given its first frame
  std::uint64_t held_bytes = 0;    ///< what the grid engine says that it holds then; 0 of other methods
  double pvs_mean = 0.0, positions_read_mean = 0.0;
  double cells_visited = 0.0, object_tests = 0.0, occluders = 0.0, rasters = 0.0;
  std::vector<double> reported{};  ///< objects, over all viewers, frame by frame
  std::uint64_t hash = 0;          ///< core/hash.h over all answers of the first repeat

  double over_estimation() const;  ///< NaN where nothing was judged
};

struct BenchSceneResult {
  std::string label{}, family_of_objects{}, family_of_viewers{};
  int dimension = 2;
  std::uint64_t objects = 0, movers = 0, viewers = 0;  ///< in frame 0
  double exact_mean = 0.0;                             ///< visible objects a judged query; NaN where nothing was judged
  /// Frames that were judged with all their viewers, and how many objects they see together.
  std::vector<std::pair<std::uint64_t, double>> exact{};
  std::vector<BenchRow> rows{};
};

/// Calls `tick` after every frame of a contender. Throws Stopped on Ctrl-C, and what readers throw; what a method's
/// maker refuses is written in its row.
BenchSceneResult run_bench_scene(const BenchScene& scene, std::span<const Contender> contenders,
                                 const BenchSettings& settings, const std::function<void()>& tick);

}  // namespace gridcull
