// Import of pedestrian trajectories as PeTrack writes them.
//
// `#` lines name the frame rate ("framerate: 25 fps") and the unit ("x/m" or "x/cm"), then come rows
// `id frame x y [z]`, in any order. z is the height of the head and is not used.
#pragma once

#include <optional>
#include <string>

#include "gridcull/sim/imported.h"

namespace gridcull {

struct PetrackOptions {
  std::string trajectories{};  ///< may be .gz
  double radius = 0.25;        ///< metres
  double max_speed = 5.0;      ///< m/s
  ViewerChoice viewers{};
  double range = 25.0;         ///< metres
  double fov_degrees = 170.0;  ///< 0 < fov <= 360
};

/// A person looks along its motion over 0.2 s before and after (as far as its track goes), and keeps its
/// heading while that motion is below 5 cm; headings are rounded to 1e-6 radians. A person that is missing
/// in a frame is removed and added again. Throws Error(io), Error(bad_message), Error(usage).
Imported import_petrack(const PetrackOptions& options, const FrameSink& sink);

}  // namespace gridcull
