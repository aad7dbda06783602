#include "gridcull/methods/baking.h"

#include <cmath>
#include <cstdio>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

double bake_setting(const BakeSettings& values, const BakeSetting& setting) {
  const auto found = values.find(setting.name);
  const double value = found == values.end() ? setting.standard : found->second;
  const bool fits = value >= setting.least && value <= setting.most && (!setting.whole || value == std::floor(value));
  if (fits) return value;
  throw Error(ErrorCode::usage, "--" + std::string(setting.name) + ": expected " +
                                    (setting.whole ? "a whole number in " : "") + short_text(setting.least) + " .. " +
                                    short_text(setting.most) + ", found " + short_text(value));
}

}  // namespace gridcull
