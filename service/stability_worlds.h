// What the worlds of the stability suite are built of.
#pragma once

#include <cstdint>
#include <span>

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
  /// Nearly one height: `five-d-tree` has cells only where something moves, however small, and none elsewhere.
  static constexpr double mover_height = 1.59, eye_height = 1.6;

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
constexpr double building_side = 11.0;  // metres, mean of the quarter's

constexpr double room_side = 20.0;  // metres
/// 4 x 4 rooms with a door of 2 m in each wall, four things in each; walls of these thicknesses by turns.
void add_rooms(LimitBuilder& build, const Vec2& origin, std::span<const double> thicknesses);
/// These, and a viewer in each of four rooms.
LimitWorld rooms_world(const Vec2& origin, std::span<const double> thicknesses, int dimension);

/// So many things in the cell of 2 m at the origin, a building beside them and one behind.
void add_crowd(LimitBuilder& build, int count);
/// Where the crowd's k-th thing stands, and the radius of each.
Vec2 crowd_place(int k, int count);
double crowd_radius(int count);

/// Frame by frame somebody so many metres before a corner, a face and a smaller wall of a building and before a thin
/// wall; below 0: inside.
LimitWorld approach_world(const Vec2& origin, std::span<const double> gaps, int dimension);

/// Two long walls of houses with a gap of so many metres between them, and a row of things to be seen through it.
LimitWorld gap_world(const Vec2& origin, double gap, int dimension);

/// Turns a view and makes it so many degrees wide: about the line of sight in 2D, over the height in 3D, where 180 and
/// more are all round.
void look_towards(View& view, double heading, double degrees, int dimension);

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

// One for each two limits at once.
LimitWorld far_thin_limit(double value, int dimension);
LimitWorld far_corner_limit(double value, int dimension);
LimitWorld far_narrow_limit(double value, int dimension);
LimitWorld far_fast_limit(double value, int dimension);
LimitWorld far_gap_limit(double value, int dimension);
LimitWorld small_fast_limit(double value, int dimension);
LimitWorld narrow_face_limit(double value, int dimension);
LimitWorld thin_on_wall_limit(double value, int dimension);
LimitWorld crowd_within_limit(double value, int dimension);

}  // namespace gridcull
