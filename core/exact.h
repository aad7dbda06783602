// The exact reference: who is visible, by definition (core/culler.h), sharing no code with any method.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull {

/// One viewer's exact set.
struct ExactAnswer {
  /// Ascending. 2D: every visible object (analytic). 3D: objects that a sampled ray sees, confirmed in
  /// doubles where asked for: a lower bound.
  std::vector<ObjectId> visible;
  /// For visible[i]: a direction (unit, world axes) in which the viewer sees it; zero for an object that
  /// holds the viewer.
  std::vector<Vec3> witness;
  bool lower_bound = false;  ///< true in 3D
};

/// 2D, analytic: angular sweep over disc and polygon boundaries. Directions narrower than 1e-9 radians are
/// left out. Cost about (boundaries in reach) * (boundaries on a ray).
/// Places within 1e-12 of the coordinates' size count as one, decided so that no right method is blamed:
/// what is touched at the same distance as an occluder is seen, and an object holds the viewer only when it does by
/// more than that. On which side of a wall's line the viewer stands is decided exactly, on the rounded world points.
/// Throws Error(bad_scene) for 3D shapes, Error(bad_frame) for a view out of range.
ExactAnswer exact_visible_2d(std::span<const Object> world, const View& view);

/// 3D: dense rays through Embree, one acceleration structure a frame, any number of views. The calling thread does
/// all the work.
class ExactRays {
 public:
  /// Whether the library was built with Embree; the constructor throws Error(usage) if not.
  static bool available();

  /// `rays`: along a frustum's height or a cube face's edge, >= 1 (default of `gridcull check`: 512).
  ExactRays(std::span<const Object> world, int rays);
  ~ExactRays();
  ExactRays(ExactRays&&) noexcept;
  ExactRays& operator=(ExactRays&&) noexcept;

  /// `each_row` is called before each row of rays; it may throw to end the work.
  ExactAnswer visible(const View& view, const std::function<void()>& each_row = {}) const;

  /// Judges one object along one direction in doubles, brute force over the world the constructor was
  /// given, and along directions a little beside it: whether the viewer really sees it there with positive
  /// solid angle. Used before a 3D miss is believed, since Embree computes in floats.
  bool confirm(const View& view, ObjectId object, const Vec3& direction) const;

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull
