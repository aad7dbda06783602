// Exact interference of a convex volume with a box, with its three outcomes: Hudson et al. 1997, section 5.3.
//
// First each plane of the volume against the box's nearest and farthest corner; that alone says `inside` exactly, and
// `outside` mostly (shadow_frustum.h uses no more). Then, where no plane parts them, each edge of the volume against
// the box as three slabs, and each edge of the box against all planes of the volume at once: they overlap when an edge
// of one meets the other, or one holds the other. Without a far plane the box cannot hold the volume.
//
// Plain doubles, no margins: `inside` is not proven here. Use it for `outside` only where an error only costs time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/methods/shadow_frustum.h"

namespace gridcull {

/// What the paper's table 1 counts. Vectors have three parts.
struct Operations {
  std::uint64_t dots = 0;      ///< products of two vectors, and of a box's half sizes with a plane's normal
  std::uint64_t scalings = 0;  ///< vector times or by scalar, and quotients of scalars, as vectors of three
  std::uint64_t sums = 0;      ///< of vectors
  std::uint64_t crosses = 0;
};

/// A box turned any way, or along the axes.
struct TurnedBox {
  Vec3 centre{0.0}, half{0.0};
  std::array<Vec3, 3> axes{Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  bool along_axes = true;
};

/// From `from` to from + along, or on for ever.
struct VolumeEdge {
  Vec3 from{0.0}, along{0.0};
  bool endless = false;
};

/// `planes`: normals inwards, without margins; `edges`: all of the volume's.
Overlap exact_overlap(std::span<const ShadowPlane> planes, std::span<const VolumeEdge> edges, const TurnedBox& box,
                      Operations& done);

/// Whether no ray from the viewpoint through the box runs within the frustum's sides, exactly; not asked of cones.
bool lies_beside(const ShadowFrustum& frustum, const SightBox& box, std::vector<VolumeEdge>& scratch, Operations& done);

}  // namespace gridcull
