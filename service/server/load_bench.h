// Many sessions at once: does a server keep up, and does its memory stay as it is?
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace gridcull {

struct LoadSettings {
  int sessions = 100;
  std::uint32_t buildings = 400;  ///< of each session's town; a quarter as many cars drive between them
  int viewers = 5;                ///< of each session, 100 m
  double rate = 10.0;             ///< frames a second, of each session
  double seconds = 60.0;
  int threads = 2;  ///< of the server
};

struct LoadResult {
  std::uint64_t asked = 0, answered = 0;               ///< frames
  double median_ms = 0.0, p99_ms = 0.0, max_ms = 0.0;  ///< from a frame's due time to its answer
  double memory_early = 0.0, memory_late = 0.0;  ///< bytes of this process, after a sixth of the time and at the end
};

/// The server and its clients live in this process. `tick` about every second; it may throw to end the work.
LoadResult bench_load(const LoadSettings& settings, const std::function<void()>& tick);

std::string load_text(const LoadSettings& settings, const LoadResult& result);

}  // namespace gridcull
