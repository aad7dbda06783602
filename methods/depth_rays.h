// Depth by rays and a hierarchical depth test: what sensor simulators and game engines do in 3D.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"

namespace gridcull {

struct DepthRaysOptions {
  Bounds bounds{};               ///< of the world
  int width = 128, height = 72;  ///< rays of a picture, 1 .. 8192
  /// What objects are tested with, in their local axes. None, the default: their boxes; balls, a box turned to the
  /// view.
  std::optional<BoundKind> bound{};
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< bytes for the pictures
};

/// Throws Error(usage) for sizes out of range, Error(limit) for pictures that take more than max_memory, and where the
/// library was built without Embree.
std::unique_ptr<Culler> make_depth_rays(const DepthRaysOptions& options);

const MethodInfo& depth_rays_info();

}  // namespace gridcull
