// Integer division that rounds towards minus and plus infinity.
#pragma once

#include <cstdint>

namespace gridcull {

/// floor(a / b), b > 0.
inline std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// ceil(a / b), b > 0.
inline std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return a / b + (a % b > 0 ? 1 : 0); }

}  // namespace gridcull
