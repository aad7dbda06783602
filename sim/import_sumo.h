// Import of SUMO's floating-car data and building polygons: vehicles become boxes (sim/sumo_shapes.h), persons discs
// about their position. In 3D buildings become prisms, vehicles and persons boxes that stand on z = 0.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "gridcull/core/vec.h"
#include "gridcull/sim/imported.h"

namespace gridcull {

struct SumoOptions {
  std::string fcd{};        ///< XML, may be .gz
  std::string buildings{};  ///< poly.xml, may be .gz; "" for none
  /// x0, y0, x1, y1 (metres). Left out are: buildings whose bounding box does not meet it, vehicles and
  /// persons in the steps in which their centre lies outside it. It becomes the scene's bounds.
  std::optional<std::array<double, 4>> box{};
  ViewerChoice viewers{};
  std::optional<double> range{};  ///< metres
  Vec2 vehicle_size{5.0, 1.8};    ///< length, width; metres
  double person_radius = 0.25;    ///< metres
  double max_speed = 60.0;        ///< of vehicles, m/s
  double person_max_speed = 10.0;
  std::uint64_t every = 1;  ///< keep steps 0, N, 2N ...
  /// Scene file whose static objects come first, with their ids; "" for none. When it is 3D, the world is.
  std::string statics{};
  FieldReader read_field{};  ///< for volumes among them
  /// Metres. Given: the world is 3D; buildings whose polygon has no <param key="height"> are as high as this.
  std::optional<double> height{};
  double vehicle_height = 1.5, person_height = 1.75, eye_height = 1.2;  ///< metres, in 3D
  /// Told after each kept step; may throw to stop.
  std::function<void(std::uint64_t frames)> progress{};
};

/// 2 or 3. Throws what read_scene() throws, and Error(usage) for a 2D scene where a height is given.
int sumo_dimension(const SumoOptions& options);

/// Reads step by step, holding one step in memory. Without a box the scene's bounds are those of all
/// buildings and ways, rounded outward to metres. Throws Error(io), Error(bad_message) for files that are
/// not what they should be or end in the middle, Error(usage) for options out of range and for chosen
/// viewers that never appear.
Imported import_sumo(const SumoOptions& options, const FrameSink& sink);

}  // namespace gridcull
