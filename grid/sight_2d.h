// One viewer's sight in 2D: what of discs, edges and boxes is behind the slope buffer, and how discs hide.
//
// Claim (discs). A disc hides with chords from one tangent point to the other, ends in the disc, of a disc smaller by
// 1e-10 of the distance d (and a tie of the coordinates, slope_edge.h): every ray through a chord passes the disc
// before or there. It is tested with its near side, larger by as much, between the tangents. The roundings are below
// that: with |centre|^2 - radius^2 at least 2e-10 d^2, the tangent points and the chord are off by less than 4 u d^2 /
// (1.4e-5 d) < 4e-11 d. Claim (range). What lies beyond the range is neither seen nor can it hide what is within: tests
// are clipped to the range's circle, occluders need not be. Claim (field of view). Slopes outside are closed from the
// start. Claim (boxes). The slopes of a box with sides along the axes lie between those of its corners, its w is
// nowhere more than where it is nearest along the axis; what the buffer is nearer than that all over these slopes hides
// it. It is grown by 1e-10 of the distance and two ties, as discs are; roundings of some u are far below that.
#pragma once

#include <array>

#include "gridcull/core/view_volume.h"
#include "gridcull/grid/box_lanes_2d.h"
#include "gridcull/grid/slope_buffer.h"

namespace gridcull {

class Sight2D {
 public:
  /// Everything within the volume is open.
  void begin(const ViewVolume& volume);

  const Vec2& eye() const { return eye_; }
  double range() const { return range_; }
  SlopeBuffer& buffer() { return buffer_; }
  const SlopeBuffer& buffer() const { return buffer_; }

  // All coordinates are relative to the viewer from here on.

  /// Where a disc is: nothing of it is visible (beyond the range, or behind the buffer), the viewer is in it or within
  /// 1e-10 of its border, or else.
  enum class Disc : std::uint8_t { hidden, around, open };
  /// `square`: of the centre's distance.
  Disc look_at_disc(const Vec2& centre, double square, double radius) const;
  /// Enters the near side of a disc that does not hold the viewer.
  void hide_behind_disc(const Vec2& centre, double radius, std::uint32_t owner);

  /// Whether a disc around an object, `square` from its centre to the viewer, seems so small that it stands for it.
  static bool seems_tiny(double square, double radius) { return 4.0 * radius * radius < tiny * tiny * square; }
  /// What is open in slopes of no more than this altogether counts as hidden; 0 in a view too narrow for that.
  double least() const { return least_; }

  /// A cheap test: whether all of a square with sides along the axes is behind the buffer for sure.
  bool hides_square(const Vec2& centre, double half) const;
  /// The same for a box.
  bool hides_box(const Vec2& low, const Vec2& high) const;
  /// What hides_box() asks the buffer about a box that lies within one quadrant (others: quadrant -1).
  struct BoxSpan {
    double from = 0.0, to = 0.0;  ///< slopes
    double near = 0.0;            ///< its greatest w
    int quadrant = -1;
  };
  bool hides_span(const BoxSpan& span) const { return buffer_.nearer(span.quadrant, span.from, span.to, span.near); }
  /// Of eight boxes of the world at once.
  void spans_of(const BoxLanes& world, std::array<BoxSpan, BoxLanes::count>& out) const;

  /// Whether something in the box may be visible. Closed box; false only if all of it is hidden.
  bool shows_box(const Vec2& low, const Vec2& high) const;

  /// Width in which an edge between two directions is not behind the buffer. Stops adding beyond `enough`.
  double open_width(const Bearing& from, const Bearing& to, const EdgeLine& line, double enough) const;
  /// The same for an edge from a to b, `left` or right, or its part within the range.
  double open_width(const Vec2& a, const Vec2& b, bool left, const EdgeLine& line, double enough) const;
  double open_width_in_range(const Vec2& a, const Vec2& b, bool left, const EdgeLine& line, double enough) const;
  /// Enters an edge. Whether it is the nearest anywhere.
  bool hide_behind_edge(const Bearing& from, const Bearing& to, const EdgeLine& line, std::uint32_t owner) {
    const int q = from.quadrant;
    if (q == to.quadrant && from.slope < to.slope) return buffer_.insert(q, from.slope, to.slope, line.low(q), owner);
    return hide_behind_wide_edge(from, to, line, owner);
  }

  /// The end p of an edge, where its object ends for the viewer, drawn back towards the edge, which lies
  /// counter-clockwise (`way` 1) or clockwise (-1) of it. World points are off by some ulp, so objects that touch in a
  /// corner may overlap by that: what shows between them is hidden by the width of a rounding only. Abutting
  /// objects do not part: where one ends, the other goes on behind it.
  Vec2 drawn_back(const Vec2& p, double way) const {
    // Turned by at least a tie of the coordinates: |x| + |y| <= sqrt(2) |p|.
    const double turn = way * 1.5 * blur_ / (std::fabs(p.x) + std::fabs(p.y));
    return {p.x - turn * p.y, p.y + turn * p.x};
  }

  /// Metres: places of the world this close count as one, their distance aside.
  double blur() const { return blur_; }

 private:
  /// The part of a box in one quadrant: slopes as if the quadrant had no borders.
  struct Part {
    bool hidden = false;
    double from = 0.0, to = 0.0;
  };
  Part part_in(int quadrant, const Box2D& box) const;
  bool hides_grown(const Box2D& box) const;
  bool hide_behind_wide_edge(const Bearing& from, const Bearing& to, const EdgeLine& line, std::uint32_t owner);
  void hide_behind_chord(const Vec2& centre, double distance, double radius, std::uint32_t owner);

  Vec2 eye_{0.0};
  double range_ = 0.0;
  double blur_ = 0.0;
  double least_ = least_width;
  SlopeBuffer buffer_;
};

}  // namespace gridcull
