// Import of a volume file as a scene of one static object.
#pragma once

#include <cstdint>
#include <string>

#include "gridcull/core/pose.h"
#include "gridcull/sim/imported.h"

namespace gridcull {

struct VolumeImportOptions {
  std::string file{};
  std::string grid{};  ///< "": the first one of floats
  double iso = 0.0;
  bool inside_below = true;
  double scale = 1.0;    ///< metres a unit of the file, > 0
  Pose pose{};           ///< of the file's axes, in metres
  std::string out{"."};  ///< folder of the scene, which names the file relative to it
  std::uint64_t max_memory = std::uint64_t{4} << 30;
};

/// A 3D scene of one static volume with id 0; no frames. Throws what the reader and make_volume() throw.
Imported import_volume(const VolumeImportOptions& options, const FieldReader& read_field);

}  // namespace gridcull
