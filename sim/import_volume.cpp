#include "gridcull/sim/import_volume.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/core/volume.h"
#include "gridcull/sim/import_parts.h"

namespace gridcull {
namespace {

Volume volume_of(const VolumeImportOptions& options, const FieldReader& read_field) {
  auto field = std::make_shared<const ScalarField>(
      read_field(options.file, options.grid, options.max_memory).scaled(options.scale));
  try {
    return make_volume(std::move(field), options.iso, options.inside_below);
  } catch (const Error& fault) {
    throw Error(fault.code(), options.file + ": " + fault.what());
  }
}

/// As a scene in the folder names it; absolute where there is no way from one to the other.
std::string name_in(const std::string& folder, const std::string& file) {
  namespace fs = std::filesystem;
  // A folder that is not there yet stays relative where it was.
  const fs::path whole = fs::weakly_canonical(fs::absolute(file));
  const fs::path relative = whole.lexically_relative(fs::weakly_canonical(fs::absolute(folder)));
  return (relative.empty() ? whole : relative).string();
}

Bounds bounds_of(const Object& object, const std::string& file) {
  Bounds box;
  for (const Vec3& p : world_vertices(object.shape, object.pose)) box.add(p);
  for (int k = 0; k < 3; ++k) {
    if (box.min[k] >= -1e9 && box.max[k] <= 1e9) continue;
    throw Error(ErrorCode::usage, file + ": scaled and moved: expected coordinates of magnitude at most 1e9");
  }
  return {glm::floor(box.min), glm::max(glm::ceil(box.max), glm::floor(box.min) + 1.0)};
}

}  // namespace

Imported import_volume(const VolumeImportOptions& options, const FieldReader& read_field) {
  Imported out;
  out.scene.dimension = 3;
  SceneObject object;
  object.name = std::filesystem::path(options.file).stem().string();
  object.volume = VolumeSource{name_in(options.out, options.file), options.grid, options.scale};
  object.object.id = 0;
  object.object.is_static = true;
  object.object.pose = options.pose;
  object.object.shape = volume_of(options, read_field);
  out.scene.bounds = bounds_of(object.object, options.file);
  if (std::get<Volume>(object.object.shape).body->inner.empty()) {
    out.notes.push_back(options.file +
                        ": no cell of its lattice lies wholly inside, so it hides nothing from conservative methods");
  }
  out.scene.objects.push_back(std::move(object));
  return out;
}

}  // namespace gridcull
