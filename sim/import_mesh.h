// Import of a mesh file as a scene of static objects.
#pragma once

#include <string>

#include "gridcull/core/pose.h"
#include "gridcull/sim/imported.h"
#include "gridcull/sim/mesh_file.h"

namespace gridcull {

struct MeshImportOptions {
  enum class Split {
    whole,   ///< one object
    groups,  ///< one a group of the file
    parts    ///< one for what hangs together (triangles that share a vertex)
  };
  std::string file{};
  Split split = Split::parts;
  double scale = 1.0;  ///< metres a unit of the file, > 0
  Pose pose{};         ///< of the file's axes, in metres
  std::uint64_t max_memory = default_mesh_memory;
};

/// A 3D scene of static `faces`, ids from 0, closed where the mesh is, each about a position of its own; no frames.
/// `notes` counts those with holes and names the worst. Throws what read_mesh() throws.
Imported import_mesh(const MeshImportOptions& options);

}  // namespace gridcull
