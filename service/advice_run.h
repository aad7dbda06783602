// `gridcull info --advise`: cell sizes of `voxel` and mask resolutions of `silhouette`, measured on a scene with its
// own viewers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gridcull/service/advice.h"
#include "gridcull/service/bench_run.h"
#include "gridcull/service/cell_less.h"
#include "gridcull/service/world_options.h"

namespace gridcull {

/// What the command line asks for.
struct AdviceRequest {
  std::uint64_t every = 0;  ///< frames 0, every, 2 every ... are measured; 0: as many apart as make 40 at most
  int threads = 1;
};

/// A setting that does not run, and why.
struct RefusedSetting {
  Contender contender{};
  std::string why{};
};

struct AdvicePlan {
  BenchScene scene{};
  BenchSettings settings{};
  bool baked = false;                     ///< the scene names a static volume, which is for one cell
  std::uint64_t file_frames = 0;          ///< 0: there is no frames file, and the scene is asked as it stands
  std::uint64_t frames = 0, viewers = 0;  ///< measured; asked at once, at most
  std::vector<Contender> contenders{};    ///< `silhouette`, then `voxel` from the coarsest cell on
  std::vector<RefusedSetting> refused{};
  std::vector<Lattice> lattices{};  ///< of the cells among the contenders, in their order
};

/// Reads through the frames once. Throws Error(usage) where nobody looks or the frames can be read but once, and what
/// readers throw.
AdvicePlan plan_advice(const WorldOptions& options, const PreparedWorld& world, const AdviceRequest& request);

/// Cell sizes about the one that choose_lattice() takes by itself, and `own`, the one in use; descending.
std::vector<double> cells_about(double derived, double own);

struct Advice {
  BenchSceneResult measured{};
  std::vector<SpeedAccuracy> settings{};  ///< of measured.rows; times in microseconds
  CellLess cell_less{};                   ///< by the plan's lattices; objects as they first stood
};

/// `tick` after every frame of a setting. Throws Stopped on Ctrl-C.
Advice run_advice(const AdvicePlan& plan, const PreparedWorld& world, const std::function<void()>& tick);

/// The earlier row that is the same setting under another name, if any: `silhouette` by default chooses a resolution
/// that may be listed too. Known by the same answers out of the same memory.
std::optional<std::size_t> twin_of(const std::vector<BenchRow>& rows, std::size_t place);

/// What rows report is compared with the row that ran most frames, each in the frames that it ran itself, so that one
/// who was stopped early takes no frames from the others. Of twins the earlier stands for both, with the lesser time.
std::vector<SpeedAccuracy> compare_rows(const std::vector<BenchRow>& rows);

}  // namespace gridcull
