// The world as method `silhouette` keeps it: every object as one ball in the loose index, or in 2D, what stands still,
// as a box in a row (static_rows_2d.h); beside what hides with it and what it is tested with. Frozen while views are
// answered, but for the notes of what was seen.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "gridcull/core/bound_kind.h"
#include "gridcull/core/object.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/loose_index.h"
#include "gridcull/grid/occluder_pieces.h"
#include "gridcull/grid/outline_store.h"
#include "gridcull/grid/static_rows_2d.h"

namespace gridcull {

class SilhouetteWorld {
 public:
  /// `cell`: metres, the side of the finest cells wished for. `bound`: what 3D objects are tested with.
  SilhouetteWorld(int dimension, const Bounds& box, double cell, std::optional<BoundKind> bound = {})
      : index(dimension, box, cell), bound_(bound) {}

  void reserve(std::size_t slots);
  /// Takes the slot out of the index or its row.
  void leave(Slot slot) {
    unmark(slot);
    index.erase(slot);
    rows.remove(slot);
  }
  /// Keeps what the shape needs computed once.
  void add(Slot slot, const Shape& shape, bool occluder);
  void remove(Slot slot);

  /// The ball (2D: disc) that holds the object's points at this pose.
  /// Orientations may be off unit length by 1e-9, which scales the object by at most 4e-9: inside the radius. What
  /// rounding adds is left to whoever measures from a viewpoint, since it grows with the coordinates.
  LooseBall ball_at(Slot slot, const Pose& pose) const {
    const Body& body = bodies_[slot];
    if (body.centred) return {pose.position, body.ball.radius};
    return {to_world(pose, rotation_of(pose.orientation), body.ball.centre), body.ball.radius};
  }

  /// Hangs the ball into the index. False when it does not fit there: then the index only remembers it, and the
  /// object belongs in GridWorld::outside.
  /// `room`: metres that it shall be able to go in its node (LooseIndex::place()).
  bool enter(Slot slot, LooseBall ball, double room = 0.0);

  /// enter() for an object that moved a little: false, and nothing done, when more is to do than to move its ball.
  bool follow(Slot slot, const Pose& pose) { return index.follow(slot, ball_at(slot, pose)); }

  /// 3D: lets an object whose own ball hangs in the index move without telling the index, as long as its way is not
  /// longer than is returned (metres, rounded down). Below 0, and nothing done, where that cannot be: only a ball about
  /// the object's position does not turn with it.
  float loosen(Slot slot) {
    const std::uint8_t marks = index.marks(slot);
    if (index.dimension() == 2 || (marks & (is_centred | is_hidden)) != is_centred || !index.holds(slot)) return -1.0F;
    const float length = leash(slot);
    if (length > 0.0F) index.set_marks(slot, marks | is_loose);
    return length > 0.0F ? length : -1.0F;
  }
  /// The same for one that is loose, after its ball has followed.
  float leash(Slot slot) const { return static_cast<float>(index.slack(slot) * (1.0 - 0x1p-20)); }
  /// The index says again where the object is.
  void tighten(Slot slot) { index.set_marks(slot, static_cast<std::uint8_t>(index.marks(slot) & ~is_loose)); }
  /// Notes how the object stands before enter() or follow() gets its own ball.
  void note_stance(Slot slot, const Pose& pose) {
    const std::uint8_t marks = index.marks(slot);
    const bool upright = stands_upright(marks, pose);
    if (upright == ((marks & is_upright) != 0)) return;
    index.set_marks(slot, static_cast<std::uint8_t>(marks ^ is_upright));
  }

  /// What the walk asks of every object that it meets, as LooseIndex::marks().
  enum Mark : std::uint8_t {
    is_centred = 1,  ///< its ball's centre is its position
    is_ball = 2,     ///< 3D: tested as the ball of ball_at(), without a Solid
    is_hidden = 4,   ///< the index has its temporal bounding volume instead of its ball
    is_occluder = 8,
    has_filling = 16,   ///< 3D: upright it fills part of its ball only
    is_upright = 32,    ///< and it stands upright now: turned about +z only
    is_loose = 64,      ///< its ball in the index lags behind: it is about the object's position, wherever that is
    is_unsettled = 128  ///< 2D: static, and waits for a row
  };
  /// Within what a ball's item says of its object, relative to the ball's centre: metres along x and y, and along z.
  struct Filling {
    double wide, tall;
  };
  /// Of an object with these marks at the pose, whoever has a ball in the index. `grown`: the ball's radius with all
  /// that rounding may do. A turn about +z is one whose x and y are 0: then z stays z, to the last bit.
  static bool stands_upright(std::uint8_t marks, const Pose& pose) {
    return (marks & has_filling) != 0 && pose.orientation.x == 0.0 && pose.orientation.y == 0.0;
  }
  /// Whether the object itself, and not its volume, has a ball in the index and stands upright.
  static bool upright_now(std::uint8_t marks) { return (marks & (is_upright | is_hidden)) == is_upright; }
  static Filling filling(const BallRows::Item& item, bool upright, double radius, double grown) {
    if (!upright) return {grown, grown};
    const double part = radius * (1.0 / 255.0), blur = grown - radius;
    return {part * item.wide + blur, part * item.tall + blur};
  }
  void set_hidden(Slot slot, bool on) {
    const std::uint8_t marks = index.marks(slot);
    index.set_marks(slot, static_cast<std::uint8_t>(on ? marks | is_hidden : marks & ~is_hidden));
  }

  /// What a 3D object hides with and is tested with; nullptr for balls that are tested as balls.
  struct Solid {
    OccluderPieces pieces;  ///< none of balls
    ConvexPiece outer;
    Vec3 box_centre{0.0}, box_half{0.0};  ///< box around `outer`, local axes; grown by 1e-8 for its roundings
    Vec3 size{0.0};                       ///< of a box: all boxes of that size share this
    LooseBall ball{};                     ///< radius above 0: tested as this ball, local axes, instead of all that
  };
  const Solid* solid(Slot slot) const { return bodies_[slot].solid.get(); }
  /// Hints that solid(slot) is needed soon: first where it stands, then what it says.
  void prefetch_body(Slot slot) const { __builtin_prefetch(&bodies_[slot]); }
  void prefetch_solid(Slot slot) const {
    const auto* solid = reinterpret_cast<const char*>(bodies_[slot].solid.get());
    __builtin_prefetch(solid);
    __builtin_prefetch(solid + offsetof(Solid, outer));
    __builtin_prefetch(solid + offsetof(Solid, outer) + 64);
  }

  /// What shapes take; the index says its own.
  std::uint64_t shape_bytes() const;

  /// 2D: the object stands at `pose` from now on; its outline's points are placed there.
  void place(Slot slot, const Pose& pose) {
    if (index.dimension() == 2) outlines.place(slot, pose);
  }

  /// 2D: a static object shall have a row from the next settle() on, if it hangs in `index`.
  void note_static(Slot slot);
  /// Gives static objects their rows, when enough are waiting for it or have left.
  void settle();

  LooseIndex index;
  OutlineStore outlines;  ///< 2D
  StaticRows2D rows;      ///< 2D: of static objects, who are not in the index then

 private:
  bool worth_settling() const {
    // Who is moved has left its row and waits for another: it counts once.
    const std::size_t changed = std::max(marked_, rows.holes());
    return changed >= few_statics && 8 * changed >= rows.size() && age_ >= frames_between_builds;
  }
  void unmark(Slot slot) {
    const std::uint8_t marks = index.marks(slot);
    if ((marks & is_unsettled) == 0) return;
    index.set_marks(slot, static_cast<std::uint8_t>(marks & ~is_unsettled));
    --marked_;
  }
  void forget_unmarked();
  void build_rows();
  Box2D box_of(Slot slot) const;
  std::unique_ptr<Solid> make_solid(const Shape& shape) const;
  std::shared_ptr<const Solid> solid_of(const Shape& shape);
  void set_filling(Slot slot, const Shape& shape);

  /// Smallest ball we know of about the shape, local axes. About the origin it holds at any orientation.
  struct Body {
    LooseBall ball{};
    bool centred = true;
    std::shared_ptr<const Solid> solid{};  ///< of boxes one for all of a size: a crowd of cars stays in the cache
  };
  /// Fewer are not worth rows; nor are rows worth building anew in every frame for statics that are moved in every one.
  static constexpr std::size_t few_statics = 8;
  static constexpr std::uint64_t frames_between_builds = 64;
  std::vector<Slot> unsettled_;  // 2D: whoever is marked as is_unsettled, perhaps twice, and some who were
  std::size_t marked_ = 0;       // objects
  std::uint64_t age_ = frames_between_builds;  // settle()s since the last build; the first one waits for nothing
  std::vector<Body> bodies_;
  std::map<std::array<double, 3>, std::weak_ptr<const Solid>> boxes_;  // by size
  std::optional<BoundKind> bound_;
};

}  // namespace gridcull
