// Stable hashes of objects: what was worked out in advance says with them what it is good for.
#pragma once

#include <cstdint>
#include <span>

#include "gridcull/core/object.h"

namespace gridcull {

/// Of id, shape, pose, and whether it occludes.
std::uint64_t object_hash(const Object& object);

/// Of the static objects, occluders and occludees: ids, shapes, poses, occluder or not. Neither their order nor moving
/// objects count.
std::uint64_t static_world_hash(std::span<const Object> objects);

}  // namespace gridcull
