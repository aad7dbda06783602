// The occluders of a FlatWorld in Embree, and pictures of their depth. The one file of the methods that knows Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gridcull/methods/flat_world.h"

namespace gridcull {

/// A picture: one ray through the middle of each pixel, rows from the top, columns from the left.
struct DepthWindow {
  Vec3 eye{0.0};
  Rotation axes{};                          ///< looks along x, y is left, z is up
  double tangent_x = 1.0, tangent_y = 1.0;  ///< half the picture's width and height at depth 1
  int width = 1, height = 1;                ///< pixels
  double far = 0.0;                         ///< planar depth (metres) up to which anything matters; may be infinite
};

class DepthScene {
 public:
  /// Whether the library was built with Embree; the constructor throws Error(usage) if not.
  static bool available();

  /// `middle`: of the world. Embree computes in floats, relative to it.
  explicit DepthScene(const Vec3& middle);
  ~DepthScene();
  DepthScene(const DepthScene&) = delete;
  DepthScene& operator=(const DepthScene&) = delete;

  /// Takes what changed since the last call and rebuilds the trees over it.
  void update(const FlatWorld& world);

  /// Planar depth of the nearest occluder at each pixel, infinity where there is none. `skipped`: places in
  /// world.objects() that no ray meets. `depths` has width * height values.
  void shoot(const DepthWindow& window, std::span<const std::uint32_t> skipped, std::span<float> depths) const;

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull
