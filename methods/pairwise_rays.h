// What traffic and crowd simulators do today: one ray from centre to centre for each pair.
#pragma once

#include <memory>

#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"

namespace gridcull {

struct PairwiseOptions {
  int dimension = 2;
  Bounds bounds{};  ///< of the world: objects that leave it are looked at by every ray
  int threads = 1;  ///< 1 .. 256; viewers run in parallel
};

/// Throws Error(usage) for threads out of range.
std::unique_ptr<Culler> make_pairwise_rays(const PairwiseOptions& options);

const MethodInfo& pairwise_rays_info();

}  // namespace gridcull
