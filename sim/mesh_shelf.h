// The mesh files that a scene names, each read once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gridcull/sim/mesh_file.h"

namespace gridcull {

class MeshShelf {
 public:
  /// Paths are relative to the folder of `scene_path` ("-": to the working folder).
  explicit MeshShelf(const std::string& scene_path, std::uint64_t max_memory = default_mesh_memory);

  /// A group of a file, or with "" all of it. Throws what read_mesh() throws, and Error(bad_scene) for a group that the
  /// file does not have.
  MeshGroup take(const std::string& file, const std::string& group);

 private:
  std::string folder_;
  std::uint64_t max_memory_;
  std::map<std::string, std::vector<MeshGroup>> files_{};
};

}  // namespace gridcull
