#include "gridcull/sim/generate.h"

#include <array>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/sim/generate_parts.h"

namespace gridcull {
namespace {

constexpr std::array<std::string_view, 5> names{"spheres", "city", "discs", "town", "maze"};

void refuse(const std::string& why) { throw Error(ErrorCode::usage, why); }

void check(std::string_view name, const GenerateOptions& options) {
  constexpr std::uint32_t greatest_count = 10'000'000;
  constexpr std::uint32_t greatest_side = 2000;
  if (options.count && *options.count > greatest_count) refuse("count: expected at most 10000000");
  if (name == "maze" && options.count && (*options.count < 1 || *options.count > greatest_side)) {
    refuse("count: a maze has 1 .. 2000 corridors along each side, found " + std::to_string(*options.count));
  }
  if (options.blocks && (*options.blocks < 1 || *options.blocks > greatest_side)) {
    refuse("blocks: expected 1 .. 2000, found " + std::to_string(*options.blocks));
  }
  if (options.range && !(*options.range > 0.0 && *options.range <= 1e9)) refuse("range: expected metres above 0");
  if (options.cell && !(*options.cell > 0.0 && *options.cell <= 1e9)) refuse("cell: expected metres above 0");
  if (options.frames && *options.frames < 1) refuse("frames: expected at least 1");
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
