// The world in Embree: which solid does a ray meet first? In floats, so good to about 1e-6 of the world's size.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gridcull/core/exact_3d_solids.h"

namespace gridcull::exact {

class RayScene {
 public:
  /// Keeps a reference to the solids.
  explicit RayScene(const std::vector<Solid>& solids);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  static constexpr std::uint32_t none = 0xFFFF'FFFFu;
  struct Hit {
    std::uint32_t solid = none;
    double distance = 0.0;
  };
  /// First solid met within (blur(), limit], leaving out those with skip[solid] != 0.
  Hit first(const Vec3& eye, const Vec3& ray, double limit, const std::vector<char>& skip) const;

  /// Metres by which floats may shift things; nothing is met nearer than this.
  double blur() const;

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull::exact
