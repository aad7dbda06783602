#include "gridcull/service/text.h"

#include <array>
#include <cstdio>

namespace gridcull {

std::string number_text(double value, int digits) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"bytes", "kB", "MB", "GB", "TB"};
  std::size_t unit = 0;
  while (bytes >= 1000.0 && unit + 1 < units.size()) {
    bytes /= 1000.0;
    ++unit;
  }
  return number_text(bytes, 3) + " " + units[unit];
}

std::string bounds_text(const Bounds& bounds, int dimension) {
  const auto point = [dimension](const Vec3& p) {
    std::string text = "(" + number_text(p.x) + ", " + number_text(p.y);
    if (dimension == 3) text += ", " + number_text(p.z);
    return text + ")";
  };
  return bounds.empty() ? "nothing" : point(bounds.min) + " .. " + point(bounds.max);
}

std::string counted(unsigned long long count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many.empty() ? one + "s" : many);
}

Error option_error(const std::string& option, const std::string& expected, const std::string& found) {
  return Error(ErrorCode::usage, option + ": expected " + expected + ", found " + found);
}

}  // namespace gridcull
