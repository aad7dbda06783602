// An occludee's outline on an image plane, tested against shadow frusta: the general test of Hudson et al. 1997,
// section 5.2, and unions of two convex occluders (section 3.2).
//
// The paper projects occluder and occludee onto the image plane, finds out by a Cyrus-Beck clipping whether the two
// convex polygons overlap, and looks whether edges cross. Here only the occludee is projected; the occluder stays the
// set of planes through the viewpoint, which are its polygon's edges on any image plane, so that occluders behind the
// image plane need no care.
//
// Claim. Let the polygon's corners be rays r, known up to error() (below), their hull holding the projection of every
// true point of the occludee. Sides are as in shadow_frustum.h. Containment in one frustum: all corners pass with
// error() added; convexity does the rest. Union: the polygon is cut along the sides of one occluder A, one by one; what
// falls outside a side must have all its corners in the other occluder B, what remains goes on to the next side and is
// in A at the end. Each cut is at the place where the side's test value is `cut_margin` |r|, far above what the test
// needs, and new corners lie on the old edges up to 8 ulp, and as near to the cut. After at most 64 cuts each true
// ray of the polygon is within 2^-44 |r| of a ray of some piece, and 2^-40 pays for that on both sides.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/methods/shadow_frustum.h"

namespace gridcull {

/// Buffers of the union test, kept from call to call.
struct UnionScratch {
  std::vector<Vec3> rest{}, piece{}, next{};
};

class ImagePolygon {
 public:
  static constexpr std::size_t most_points = 64;
  /// See the claim.
  static constexpr double cut_margin = 0x1p-38, pass_margin = 0x1p-40;

  /// The hull of the points (sight coordinates, known up to `blur`) on a plane across `towards`. False when there are
  /// too many, or when one is nearly beside or behind the viewer: then nothing can be said. In 2D two rays.
  bool build(std::span<const Vec3> points, const Vec3& towards, double blur, bool flat);
  /// An octagon about the ball (2D: two rays).
  bool build(const SightBall& ball, bool flat);

  std::span<const Vec3> rays() const { return {rays_.data(), rays_.size()}; }
  /// Length of the longest ray; by how much a ray may be off.
  double length() const { return length_; }
  double error() const { return error_; }

 private:
  void set_axes(const Vec3& towards, bool flat);
  void finish(double relative_error);

  Vec3 axis_{0.0}, across_{0.0}, up_{0.0};
  std::vector<Vec2> flat_{}, hull_{};
  std::vector<Vec3> rays_{};
  double length_ = 0.0, error_ = 0.0;
};

/// Seen from the viewpoint, nearer and farther apart. `inside` is proven, `outside` is not.
Overlap overlap(const ImagePolygon& polygon, const ShadowFrustum& frustum, std::uint64_t& plane_tests);

/// Bits of the rays within the frustum, for a quick no: two frusta hide together only what has each ray in one.
std::uint64_t rays_within(const ImagePolygon& polygon, const ShadowFrustum& frustum, std::uint64_t& plane_tests);

/// Whether each ray of the polygon is within `a` or `b`.
bool inside_union(const ImagePolygon& polygon, const ShadowFrustum& a, const ShadowFrustum& b, UnionScratch& scratch,
                  std::uint64_t& plane_tests);

}  // namespace gridcull
