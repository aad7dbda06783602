// Which plane divides a cell best (Gotsman, Sudarsky, Fayman 1999, section 4).
#pragma once

#include <optional>

#include "gridcull/methods/five_d_rays.h"

namespace gridcull {

struct FiveDSplit {
  int axis = 0;
  std::uint32_t step = 0;
  double effectiveness = 0.0;
};

/// Brings `work` up to the estimate's number of rays and weighs the candidates. Nothing where the best is less
/// effective than asked for. `cast` grows by the rays cast.
std::optional<FiveDSplit> choose_split(const FiveDScene& scene, const FiveDOptions& options, CellWork& work,
                                       FiveDScene::Scratch& scratch, std::uint64_t& cast);

/// The two parts of a cell, each with the rays that begin in it; `work` keeps none.
std::array<CellWork, 2> divide(const FiveDScene& scene, CellWork& work, const FiveDSplit& split);

}  // namespace gridcull
