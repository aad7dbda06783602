// The mesh and volume files that a scene names, each read once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "gridcull/core/scalar_field.h"
#include "gridcull/sim/mesh_file.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

class MeshShelf {
 public:
  /// Paths are relative to the folder of `scene_path` ("-": to the working folder).
  /// `max_memory`: bytes of all files together.
  explicit MeshShelf(const std::string& scene_path, std::uint64_t max_memory = default_mesh_memory,
                     FieldReader read_field = {});

  /// A group of a file, or with "" all of it. Throws what read_mesh() throws, and Error(bad_scene) for a group that the
  /// file does not have.
  MeshGroup take(const std::string& file, const std::string& group);

  /// What is below or above `iso` in a grid of a file. Throws what the reader of fields and make_volume() throw;
  /// without a reader Error(bad_scene).
  Volume take(const VolumeSource& source, double iso, bool inside_below);

 private:
  std::string folder_;
  void spend(std::uint64_t bytes) { left_ -= std::min(left_, bytes); }

  std::uint64_t left_;  ///< bytes that all files together may still take
  FieldReader read_field_;
  std::map<std::string, std::vector<MeshGroup>> files_{};
  std::map<std::tuple<std::string, std::string, double>, std::shared_ptr<const ScalarField>> fields_{};
  std::map<std::tuple<const ScalarField*, double, bool>, Volume> volumes_{};
};

}  // namespace gridcull
