// Extended projections onto one plane (paper sections 2, 3.1, 3.2 and 4).
//
// Claim. Let P be a point of the plane in a pixel that holds depth d, V any point of the cell, X a point with
// w(X) >= d on the ray from V through P. Then the open segment V-X meets an occluder (at some w <= d).
// An occludee is hidden from the whole cell when each of its points X is such a point for every V: when the union of
// its views from the cell lies in such pixels.
//
// Why it is enough to look from the cell's eight corners (3.2). Let A be convex and on one side of the plane (we cut
// occluders at it), and P in the view of A from every corner. If A is in front, the viewpoints that see P through A are
// {P + s (a - P) : a in A, s >= 1}; behind the plane, {P - s (a - P) : a in A, s > 0}. Both sets are convex, so they
// hold the cell if they hold its corners. A convex A that the plane cuts must be cut: two corners may see P through
// parts on different sides while a viewpoint between them sees past both.
//
// Depth (2.3). An occluder is cut at w <= c and enters with depth c: every point at which it is met has w <= c. Some
// nearer cuts of long occluders enter too, with less depth.
//
// Improved projection (4). For X in front of the plane it is enough that X lies in the hull of P and the cell, P and d
// as above: with V0 the cell's point on the line P-X and A the (convex or flat) occluder at P, A meets V-P and V0-P,
// the chord between these two points parts P and X from V in the triangle V, V0, P, so it crosses V-X. The paper takes
// the section of that hull for a Cartesian product (4.3). It is not where the cell is deep: seen from a P that lies
// aside, the cell's front and back give rectangles shifted along the diagonal. We take the cell's front side alone
// instead of the cell, whose cones with P are products; they lie in the hull, so the argument holds.
//
// Rounding. Coordinates of occluders are off by at most `blur` plus 1e-14 of their reach (a difference, a turn, up to
// six cuts: below 40 roundings of 2^-53). The views' corners are then off by at most `e` in each coordinate (see
// OccluderProjector::error()). Computed hulls lie within the true hulls grown by the square of half side e; where such
// a hull holds a pixel grown by that square, the true hull holds the pixel (K + E in Q + E implies K in Q for convex
// compact sets). Occludees are grown by their own error, and their projection by that of its formula.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/methods/extended_cell.h"
#include "gridcull/methods/extended_map.h"
#include "gridcull/methods/extended_polytope.h"

namespace gridcull::extended {

/// How far a map reaches beyond the pyramid under 45 degrees (6.1).
inline constexpr double plane_extension = 1.5;

/// A projection plane in its facing's axes: at w = distance, |u|, |v| <= extent.
struct Plane {
  Vec3 half{0.0};  ///< the cell's, along u, v, w
  double distance = 0.0;
  double near = 0.0;  ///< nothing nearer occludes: views of it would be out of all bounds
  Vec2 extent{0.0};
  int resolution = 0;

  Vec2 pixel() const { return extent * (2.0 / resolution); }
};

/// `distance` > half.z.
Plane make_plane(const Vec3& half, double distance, int resolution);

/// Adds occluders to a map; storage is reused.
class OccluderProjector {
 public:
  /// A convex occluder in the plane's axes, whose points are off by at most `error`. `cuts`: at how many depths it
  /// enters. True when it covered a pixel.
  bool add(const Plane& plane, const Polytope& occluder, double error, int cuts, DepthMap& map);

 private:
  bool enter(const Plane& plane, const Polytope& part, double error, double depth, DepthMap& map);
  bool view_all(const Plane& plane, const Polytope& part, double error);
  bool choose_rows(const Plane& plane);
  void cut_lines(const Plane& plane, std::span<const Vec2> view);
  bool fill(const Plane& plane, double depth, DepthMap& map);

  Clipper clip_{};
  Polytope whole_{}, part_{};
  std::vector<Vec2> views_{}, hull_{};  // views_: eight times the part's points
  std::vector<std::uint32_t> order_{}, corners_{};
  std::vector<double> low_{}, high_{};  // two lines a row
  double margin_ = 0.0;
  int first_row_ = 0, last_row_ = -1;
};

/// What the map says of an occludee inside `box` (the plane's axes, grown by its error): `all` when it is hidden from
/// the whole cell. The box is not empty.
Cover look_at(const Plane& plane, const DepthMap& map, const Bounds& box, std::uint64_t& looked_at);

}  // namespace gridcull::extended
