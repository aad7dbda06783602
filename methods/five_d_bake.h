// Building the five-dimensional tree, in parallel, with breaks.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gridcull/methods/baking.h"
#include "gridcull/methods/five_d_code.h"
#include "gridcull/methods/five_d_options.h"

namespace gridcull {

struct FiveDBaked {
  FiveDSpace space{};
  FiveDTree tree{};
  std::uint64_t cells = 0;  ///< in position: leaves before the last split
  std::uint64_t rays = 0;   ///< cast
};

/// From the static objects among `objects`; `bounds`: of the world. `resume` and `listener` as in Baking (catalog.h);
/// without a listener nothing stops it. Throws Error(bad_scene) for a state that is of other objects.
std::optional<FiveDBaked> bake_five_d(std::span<const Object> objects, int dimension, const Bounds& bounds,
                                      const FiveDOptions& options, std::span<const std::byte> resume,
                                      BakeListener* listener);

/// The bytes of a payload and back. Throws Error(bad_scene), with `name` in front.
std::vector<std::byte> five_d_payload(const FiveDBaked& baked);
FiveDBaked read_five_d_payload(std::span<const std::byte> payload, std::string_view name);
/// What a payload holds, as lines of "name  value".
std::string describe_five_d(std::span<const std::byte> payload);

}  // namespace gridcull
