// Visibility from regions of space, worked out cell by cell: F. Durand, G. Drettakis, J. Thollot, C. Puech,
// "Conservative Visibility Preprocessing using Extended Projections", SIGGRAPH 2000.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gridcull/core/bounds.h"
#include "gridcull/core/culler.h"

namespace gridcull {

struct ExtendedOptions {
  Bounds bounds{};      ///< of the world; the lattice of viewing cells starts at its lower corner
  double cell = 1.0;    ///< edge of a viewing cell, metres, > 0
  int resolution = 0;   ///< pixels along a depth map's side, 8 .. 8192; 0: 256
  int threads = 1;      ///< 1 .. 256
  std::string baked{};  ///< file of `gridcull bake`, read at the first frame; "": cells are looked out of on demand
  std::uint64_t max_memory = std::uint64_t{4}
                             << 30;  ///< bytes of depth maps, a quarter of them kept for cells that were visited
};

/// 3D. Static occluders hide; moving objects are occludees only. Throws Error(usage) for options out of range,
/// Error(limit) for maps that take more than max_memory.
std::unique_ptr<Culler> make_extended_projections(const ExtendedOptions& options);

const MethodInfo& extended_projections_info();

}  // namespace gridcull
