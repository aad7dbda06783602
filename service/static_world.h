// A scene's static volume: is it for this scene, and what lattice does it ask for?
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "gridcull/grid/static_cells.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// A scene's `static_volume`, of which the head was read and found to be for this scene.
struct StaticVolume {
  std::string path;
  StaticCells head;  ///< without objects and bricks
};

/// The objects of the scene.
std::vector<Object> objects_of(const Scene& scene);

/// Nothing where the scene (of the file `scene_path`, "-": standard input) names none. Throws what
/// read_static_volume_head() throws, and Error(bad_scene) for a file that was baked for other static objects, another
/// cell than `cell` (none: not asked for) or other bounds than the scene's.
std::optional<StaticVolume> open_static_volume(const Scene& scene, const std::string& scene_path,
                                               const std::optional<double>& cell);

}  // namespace gridcull
