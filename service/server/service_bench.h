// What the wire costs: the same frames in this process and over loopback, in turn.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gridcull {

struct ServiceBenchResult {
  std::string scene{};
  std::uint64_t objects = 0, moves = 0, views = 0;  ///< moves and views: mean of a frame
  double alone_ms = 0.0, alone_min_ms = 0.0;        ///< a frame in this process: median and minimum
  double wire_ms = 0.0, wire_min_ms = 0.0;          ///< from the call of the client to its answer
  bool same_answers = false;
};

/// `scene`: as in bench_scene.h. The engine has one thread; the client runs in another. Frame by frame both are
/// asked in turn, `repeats` times over the first `frames` frames, the first frame left out; each frame counts with its
/// least time. `tick` after each frame.
ServiceBenchResult bench_service(const std::string& scene, std::uint64_t frames, int repeats,
                                 const std::function<void()>& tick);

std::string service_bench_table(const std::vector<ServiceBenchResult>& results);

}  // namespace gridcull
