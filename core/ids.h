// Identifiers of objects and viewers: two separate spaces, unique in each.
#pragma once

#include <cstdint>

namespace gridcull {

using ObjectId = std::uint32_t;
using ViewerId = std::uint32_t;

/// Not an id: ids run from 0 to 2^32 - 2.
inline constexpr std::uint32_t no_id = 0xFFFF'FFFFu;

}  // namespace gridcull
