// Reads a frames file ahead: how long it is and where its objects go. Wanted where a scene names no bounds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

struct Survey {
  std::uint64_t frames = 0;
  double first_time = 0.0, last_time = 0.0;  ///< seconds
  std::uint64_t moves = 0, removals = 0;     ///< over all frames
  std::vector<Object> objects{};  ///< all there ever were, as they first stood: the scene's, then those added
  Bounds extent{};                ///< everything they ever touched
};

/// `frames` may be "" (none), or standard input or a pipe (reads_once()): then only the scene counts.
/// Throws what readers and World throw, Stopped on Ctrl-C.
Survey survey_world(const Scene& scene, const std::string& frames);

/// Lines of a frames file but its first; for progress bars. "" and what reads_once() have none.
std::uint64_t count_frames(const std::string& path);

}  // namespace gridcull
