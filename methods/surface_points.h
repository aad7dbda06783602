// Random points on the surfaces of shapes, uniform by area (3D) or length (2D).
#pragma once

#include <vector>

#include "gridcull/core/random.h"
#include "gridcull/methods/local_shape.h"

namespace gridcull {

/// The boundary of one shape. A prism's caps are drawn by rejection from the outline's box (even-odd rule); thin shapes
/// are their own surface.
class SurfacePoints {
 public:
  explicit SurfacePoints(const LocalShape& shape);

  /// In local axes; `shape` is the one it was made for.
  Vec3 at(const LocalShape& shape, Random& random) const;

 private:
  void add(double measure) { sums_.push_back((sums_.empty() ? 0.0 : sums_.back()) + measure); }
  std::size_t choose(Random& random) const;

  std::vector<double> sums_{};  ///< of the pieces' measures: edges, faces or triangles
};

}  // namespace gridcull
