// Numbers for people.
#pragma once

#include <string>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"

namespace gridcull {

/// At most `digits` significant digits, no trailing zeros: 2, 0.5, 1.2e+09.
std::string number_text(double value, int digits = 6);

/// Bytes as "12.3 MB" (powers of 1000).
std::string bytes_text(double bytes);

/// "(0, 0) .. (100, 60)".
std::string bounds_text(const Bounds& bounds, int dimension);

/// "1 frame", "2 frames".
std::string counted(unsigned long long count, const std::string& one, const std::string& many = {});

/// Error(usage) for an option: "--cell: expected a size above 0, found 0".
Error option_error(const std::string& option, const std::string& expected, const std::string& found);

}  // namespace gridcull
