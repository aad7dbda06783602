// Who is visible from a cell that is not divided further (Gotsman, Sudarsky, Fayman 1999, sections 5 and 8).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/methods/five_d_rays.h"
#include "gridcull/methods/sequential_test.h"

namespace gridcull {

/// A leaf's members for each eighth of a turn that it has; one entry where the last split is not wanted.
struct LeafSets {
  std::vector<std::uint64_t> words{};  ///< space.words() each
  int first = 0, count = 1;            ///< eighths
};

/// Goes on with the rays that the cell inherited until the test has decided for every member.
LeafSets judge_leaf(const FiveDScene& scene, const FiveDOptions& options, const SequentialTest& test,
                    const CellWork& work, FiveDScene::Scratch& scratch, std::uint64_t& cast);

}  // namespace gridcull
