// `gridcull bake --method extended-projections`: adaptive viewing cells over the world (paper section 6.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"
#include "gridcull/methods/baking.h"

namespace gridcull {

inline constexpr std::uint32_t extended_baked_version = 2;

std::span<const BakeSetting> extended_bake_settings();

struct ExtendedBakeOptions {
  Bounds bounds{};    ///< where viewers may be
  double cell = 1.0;  ///< metres; settings count in it
  int threads = 1;
  BakeSettings settings{};
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< bytes, of the maps of all threads
};

/// The payload; nothing when the listener stopped it. See methods/catalog.h, Baking.
std::optional<std::vector<std::byte>> bake_extended_projections(std::span<const Object> objects,
                                                                const ExtendedBakeOptions& options,
                                                                std::span<const std::byte> resume,
                                                                BakeListener& listener);

/// Lines of "name  value" about a payload. Throws Error(bad_scene) for one that cannot be read.
std::string describe_extended_projections(std::span<const std::byte> payload);

}  // namespace gridcull
