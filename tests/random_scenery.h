// What random worlds are made of: lattices, shapes, places and views.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {

class Scenery {
 public:
  /// Chooses a lattice and a style; draws from `random`, which outlives it.
  Scenery(int dimension, Random& random);

  const Bounds& bounds() const { return bounds_; }
  double cell() const { return cell_; }

  /// A new object without an id. `others`: what is there, to abut and coincide with. `step`: seconds a frame.
  Object object(const std::vector<Object>& others, double step);
  /// Walls (boxes without ids) around a good part of the world, often closed, abutting or overlapping at the corners.
  std::vector<Object> room();
  View view(ViewerId viewer, const std::vector<Object>& objects);

  Vec3 place();
  Quat orientation();
  /// Unit length, along an axis, a diagonal or any way.
  Vec3 direction();

 private:
  bool chance(double p) { return random_.unit() < p; }
  double snapped(double metres, int axis) const;
  Vec3 snapped(const Vec3& p) const;
  Vec3 wall();
  /// Metres: from a fraction of a cell to a good part of the world.
  double size();
  Shape shape_2d();
  Shape shape_3d();
  std::vector<Vec2> outline();
  Shape convex();
  Shape faces();
  Shape volume();
  Object beside(const Object& other);
  Vec3 viewpoint(const std::vector<Object>& objects);
  Vec3 on_object(const Object& object);
  Frustum frustum();

  int dimension_;
  Random& random_;
  Bounds bounds_{};
  double cell_ = 1.0;
  double unit_ = 1.0;     ///< metres that aligned coordinates are multiples of
  double aligned_ = 0.5;  ///< share of aligned coordinates
  double big_ = 0.5;      ///< share of big objects
  bool crowd_ = false;    ///< thick walls and many small things behind them, else anything
  double extent_ = 1.0;   ///< greatest side of the bounds
};

}  // namespace gridcull::test
