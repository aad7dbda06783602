// Method `silhouette` in 2D, one view: objects are entered about front to back, those that are wholly behind what was
// entered before are dropped, the others hide what comes after (DESIGN section 5.2).
//
// Claim: whoever is visible is listed. Dropped is only what lies behind lines of real edges (slope_buffer.h), beyond
// the range or outside the field of view, which is final. At the end everyone else is listed if it owns a piece
// of the buffer, or if a test against the finished buffer finds part of it open: a wall that coincides with the
// owner's, an object that never hides, one that was entered before its occluder. What owns a piece is not tested
// again unless it sticks out of the range: a piece is what the viewer meets first in those directions, but for ties.
// An object that holds the viewpoint is listed and does not hide. One that has it on its border within rounding is
// listed if it reaches into the field of view.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/outline_2d.h"
#include "gridcull/grid/sight_2d.h"

namespace gridcull {

/// An object where it stands. Outline and points must stay until finish().
struct Placed2D {
  const Outline2D* outline = nullptr;  ///< nullptr: a disc
  Vec2 centre{0.0};                    ///< of a disc that holds it (disc: the shape itself)
  double radius = 0.0;                 ///< metres
  const Vec2* points = nullptr;        ///< world points; not for discs
};

/// An outline with its bounding disc; `points` as it places them at this pose.
Placed2D placed(const Outline2D& outline, const Pose& pose, const Vec2* points);

class Silhouettes2D {
 public:
  /// `volume` must stay until finish().
  void begin(const ViewVolume& volume);

  /// Enters an object (once a slot). False: it is hidden for good. The rider's object is not to be entered.
  bool enter(Slot slot, const Placed2D& object, bool occluder);

  /// The same for an object whose box (in the world) is known: where that is clear of the viewer, the disc around the
  /// object has nothing more to say.
  bool enter_boxed(Slot slot, const Placed2D& object, bool occluder, const Box2D& box);

  /// Whether something in a closed disc or box of the world may still be visible.
  bool shows_disc(const Vec2& centre, double radius) const;
  bool shows_box(const Vec2& low, const Vec2& high) const {
    return sight_.shows_box(low - sight_.eye(), high - sight_.eye());
  }
  /// A cheap test: whether a square of the world with sides along the axes is hidden for sure.
  bool hides_square(const Vec2& centre, double half) const { return sight_.hides_square(centre - sight_.eye(), half); }
  bool hides_box(const Box2D& box) const { return sight_.hides_box(box.low - sight_.eye(), box.high - sight_.eye()); }

  /// Appends the slots of what is visible, in no order that means anything.
  void finish(std::vector<Slot>& visible);

  const Sight2D& sight() const { return sight_; }
  std::size_t candidates() const { return candidates_.size(); }
  std::uint64_t bytes() const;

 private:
  struct Candidate {
    Placed2D object;
    Slot slot;
    bool seen = false;       ///< listed without further tests
    bool straddles = false;  ///< may stick out of the range
  };

  /// Whether all of an object `square` from the viewer is within the range.
  bool within_range(double square, double radius) const {
    const double inner = sight_.range() * (1.0 - 0x1p-48) - radius;
    return inner > 0.0 && square < inner * inner;
  }
  bool enter_outline(Candidate& c, bool occluder);
  bool hide_behind_outline(Facing back, std::uint32_t owner);
  bool hide_behind_parts(const Outline2D& outline, std::uint32_t owner);
  bool hide_behind_part(const Outline2D::Part& part, std::uint32_t owner);
  bool test(const Candidate& c);
  bool outline_open(Facing back, bool straddles) const;
  /// Fills points_ and facing_. False if the viewer stands on an edge.
  bool face_all(const Placed2D& object);
  bool face_easily();     // false: with care, then
  bool face_with_care();  // false if the viewer stands on an edge
  bool holds_viewer(const Placed2D& object) const;
  bool touches_cone() const;
  /// Which edges need no look when the viewer is outside and not on the outline.
  static Facing back_of(const Outline2D& outline) {
    if (!outline.clean() || !outline.closed()) return Facing::radial;
    return outline.counter_clockwise() ? Facing::left : Facing::right;
  }
  static bool skipped(Facing facing, Facing back) { return facing > Facing::right || facing == back; }
  /// Whether the outline turns back where an edge begins or ends: there it is free.
  bool begin_free(std::size_t edge) const {
    return closed_ && facing_[edge] != facing_[edge == 0 ? edges_ - 1 : edge - 1];
  }
  bool end_free(std::size_t edge) const { return closed_ && facing_[edge] != facing_[edge + 1]; }
  EdgeLine line_of(std::size_t edge) const {
    const Vec2 &a = points_[edge], &b = points_[edge + 1];
    return easy_[edge] != 0.0 ? line_of_easy_edge(a, b, easy_[edge], sight_.blur())
                              : turn_of_edge(a, b, sight_.blur()).line();
  }
  double magnitude(const Placed2D& object) const;

  const ViewVolume* volume_ = nullptr;
  Sight2D sight_;
  std::vector<Candidate> candidates_;
  // Of the object in hand, relative to the viewer:
  std::size_t edges_ = 0;
  std::vector<Vec2> points_;    // of a closed outline with the first once more at the end
  std::vector<double> easy_;    // of the edges: a x b where that is easily known, else 0
  std::vector<Facing> facing_;  // of the edges; of a closed outline with the first once more at the end
  bool closed_ = false;
};

}  // namespace gridcull
