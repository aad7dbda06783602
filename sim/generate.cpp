#include "gridcull/sim/generate.h"

#include <array>
#include <cstdio>
#include <optional>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/sim/generate_parts.h"

namespace gridcull {
namespace {

constexpr std::array<std::string_view, 5> names{"spheres", "city", "discs", "town", "maze"};

void refuse(const std::string& why) { throw Error(ErrorCode::usage, why); }

void check_metres(const std::string& name, const std::optional<double>& value) {
  if (!value || (*value > 0.0 && *value <= 1e9)) return;
  char found[32];
  std::snprintf(found, sizeof found, "%.6g", *value);
  refuse(name + ": expected metres above 0 and at most 1e9, found " + found);
}

void check(std::string_view name, const GenerateOptions& options) {
  constexpr std::uint32_t greatest_count = 10'000'000;
  constexpr std::uint32_t greatest_side = 2000;
  if (options.count && *options.count > greatest_count) {
    refuse("count: expected at most 10000000, found " + std::to_string(*options.count));
  }
  if (name == "maze" && options.count && (*options.count < 1 || *options.count > greatest_side)) {
    refuse("count: expected 1 .. 2000 corridors along each side of a maze, found " + std::to_string(*options.count));
  }
  if (options.blocks && (*options.blocks < 1 || *options.blocks > greatest_side)) {
    refuse("blocks: expected 1 .. 2000, found " + std::to_string(*options.blocks));
  }
  check_metres("range", options.range);
  check_metres("cell", options.cell);
  if (options.frames && *options.frames < 1) refuse("frames: expected at least 1, found 0");
}

}  // namespace

std::span<const std::string_view> generated_scenes() { return names; }

std::unique_ptr<Generator> make_generator(std::string_view name, const GenerateOptions& options) {
  check(name, options);
  if (name == "spheres") return make_spheres(options);
  if (name == "city") return make_city(options);
  if (name == "discs") return make_discs(options);
  if (name == "town") return make_town(options);
  if (name == "maze") return make_maze(options);
  refuse("no generated scene is called \"" + std::string(name) + "\": expected spheres, city, discs, town or maze");
  return nullptr;
}

}  // namespace gridcull
