// Generated scenes: the same bits on every machine for the same options.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

struct GenerateOptions {
  /// spheres, discs: their number (5000; 300). city: cars (5000). town: buildings (400), with a car to
  /// every four. maze: corridors along each side (20), with a mover to every four.
  std::optional<std::uint32_t> count{};
  std::optional<std::uint32_t> blocks{};   ///< city: blocks along each side (50)
  std::optional<std::uint32_t> viewers{};  ///< on the first so many movers, all round; default per scene
  std::optional<double> range{};           ///< metres; none: unlimited
  std::optional<double> cell{};            ///< metres; default per scene
  std::uint64_t seed = 1;
  std::optional<std::uint32_t> frames{};  ///< default per scene
};

/// A generated world: its scene, and its frames one after the other, 30 a second from time 0. Frame 0 is
/// the scene as it stands.
class Generator : public FrameSource {
 public:
  virtual const Scene& scene() const = 0;
  virtual std::uint64_t frame_count() const = 0;
};

/// Their names: spheres, city, discs, town, maze.
std::span<const std::string_view> generated_scenes();

/// Throws Error(usage) for an unknown name or options out of range.
std::unique_ptr<Generator> make_generator(std::string_view name, const GenerateOptions& options);

}  // namespace gridcull
