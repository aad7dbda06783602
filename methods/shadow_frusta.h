// Shadow frusta: a few good occluders a frame, and a hierarchy of boxes culled against what they hide.
#pragma once

#include <memory>
#include <optional>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/culler.h"
#include "gridcull/methods/occluder_choice.h"

namespace gridcull {

struct ShadowFrustaOptions {
  int dimension = 3;
  int occluders = 8;   ///< used at most, each frame and viewer: 1 .. 64
  bool unions = true;  ///< whether two occluders may hide an object together
  /// Whether boxes beside a frustum are recognised exactly (section 5.3) instead of plane by plane.
  bool exact = false;
  std::optional<BoundKind> bound{};  ///< what objects are tested with; none: their own outlines
  OccluderWeights weights{};
};

/// Throws Error(usage) for a number of occluders out of range.
std::unique_ptr<Culler> make_shadow_frusta(const ShadowFrustaOptions& options);

const MethodInfo& shadow_frusta_info();

}  // namespace gridcull
