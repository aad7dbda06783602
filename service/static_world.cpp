#include "gridcull/service/static_world.h"

#include <filesystem>

#include "gridcull/core/error.h"
#include "gridcull/core/object_hash.h"
#include "gridcull/grid/static_volume.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

[[noreturn]] void refuse(const StaticVolume& volume, const std::string& what) {
  throw Error(ErrorCode::bad_scene, volume.path + ": " + what + "; bake it again with gridcull bake static");
}

}  // namespace

std::vector<Object> objects_of(const Scene& scene) {
  std::vector<Object> objects;
  objects.reserve(scene.objects.size());
  for (const SceneObject& object : scene.objects) objects.push_back(object.object);
  return objects;
}

std::optional<StaticVolume> open_static_volume(const Scene& scene, const std::string& scene_path,
                                               const std::optional<double>& cell) {
  if (scene.static_volume.empty()) return std::nullopt;
  const std::filesystem::path folder = scene_path == "-" ? "" : std::filesystem::path(scene_path).parent_path();
  StaticVolume volume{(folder / scene.static_volume).string(), {}};
  try {
    volume.head = read_static_volume_head(volume.path);
  } catch (const Error& fault) {
    const std::string name = scene_path == "-" ? "standard input" : scene_path;
    throw Error(fault.code(), name + ": /static_volume/file: " + fault.what());
  }
  const StaticCells& head = volume.head;
  if (head.dimension != scene.dimension) {
    refuse(volume, "expected cells of a " + std::to_string(scene.dimension) + "D scene, found " +
                       std::to_string(head.dimension) + "D");
  }
  if (cell && *cell != head.cell) {
    refuse(volume, "expected cells of " + number_text(*cell) + " m, found cells of " + number_text(head.cell) + " m");
  }
  if (head.world != static_world_hash(objects_of(scene))) {
    refuse(volume, "expected the cells of this scene's static objects, found those of others");
  }
  if (scene.bounds && !head.fit(Lattice(head.dimension, *scene.bounds, head.cell, 0, Room::where_needed))) {
    refuse(volume, "expected cells in the scene's bounds, found them in others");
  }
  return volume;
}

}  // namespace gridcull
