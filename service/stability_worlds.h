// What the worlds of the stability suite are built of.
#pragma once

#include <cstdint>

#include "gridcull/service/stability_limit.h"

namespace gridcull {

/// Builds a LimitWorld: positions on the ground plan, in 3D with the heights that streets have.
class LimitBuilder {
 public:
  explicit LimitBuilder(int dimension) { world.dimension = dimension; }

  /// A building that does not move, `height` metres high in 3D.
  ObjectId building(const Vec2& centre, const Vec2& size, double height = 12.0);
  /// A wall from a to b: of `thickness` metres, or without any (polyline, faces) where that is 0.
  ObjectId wall(const Vec2& a, const Vec2& b, double thickness, double height = 12.0);
  /// A mover: a disc, or in 3D a ball a little above the ground.
  ObjectId mover(const Vec2& centre, double radius, double max_speed);
  /// A frame with nobody asking yet.
  LimitFrame& frame(double time);
  /// Somebody with eyes 1.6 m above the ground.
  View viewer(const Vec2& position, ViewerId id = 0) const;
  /// The pose of something on the ground plan whose origin is `z` high.
  Pose pose(const Vec2& position, double z = 0.0) const;

  /// The bounds of all objects, and 10 m around them, moved by a 1024th of a cell: faces at round coordinates would
  /// else lie on cell boundaries (grid/choose_lattice.h).
  LimitWorld finish(double cell);

  LimitWorld world{};
  static constexpr double mover_height = 1.0, eye_height = 1.6;

 private:
  ObjectId add(Shape shape, const Pose& pose);
};

/// A quarter of town: 8 x 8 buildings of about 8 m on a 20 m pitch, 40 movers of 0.5 m in the streets that go to and
/// fro along them, four viewers standing at crossroads.
struct Quarter {
  double cell = 2.0;       ///< metres
  Vec2 origin{0.0, 0.0};   ///< of the whole world
  double step = 0.1;       ///< seconds a frame
  double speed = 2.0;      ///< m/s of the movers
  double max_speed = 5.0;  ///< m/s that they say of themselves
  int frames = 8;
};
LimitWorld quarter_world(const Quarter& quarter, int dimension);

// One for each limit.
LimitWorld cell_limit(double value, int dimension);
LimitWorld thickness_limit(double value, int dimension);
LimitWorld approach_limit(double value, int dimension);
LimitWorld gap_limit(double value, int dimension);
LimitWorld angle_limit(double value, int dimension);
LimitWorld origin_limit(double value, int dimension);
LimitWorld speed_limit(double value, int dimension);
LimitWorld step_limit(double value, int dimension);
LimitWorld crowd_limit(double value, int dimension);
LimitWorld flicker_limit(double value, int dimension);

}  // namespace gridcull
