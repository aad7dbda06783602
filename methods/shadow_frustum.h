// The space that one convex occluder hides from a viewpoint, and the tests against it.
//
// T. Hudson, D. Manocha, J. Cohen, M. Lin, K. Hoff, H. Zhang, "Accelerated occlusion culling using shadow frusta",
// SoCG 1997, section 5: apex at the viewpoint, sides through the silhouette's edges, a near plane through the
// silhouette's farthest point, no far plane. Changed: besides the near plane there are the planes of the faces that
// look at the viewer, so that what stands close behind a long wall is hidden too; balls have a cone of their own.
//
// All coordinates here are relative to the viewpoint ("sight" coordinates), so that roundings are relative to
// distances; what is left of absolute roundings, of coordinates far from the origin, is `blur`.
//
// Claim (who passes is hidden). Let P be the true occluder part: convex, its true vertices a* within `blur` of the
// computed a. Let p be a point, computed within its own blur of the true p*.
//  1. Sides. A side made of a, b holds p when n.p >= slope |p|, n = b x a / |b x a|, with `slope` so large that then
//     det(b*, a*, p*) > 0: the determinant's terms change by at most blur (|a| + |b|) |p| through the vertices, and
//     rounding adds less than 16 ulp of |a| |b| |p|. If all sides of a closed loop of vertices hold p, then, seen
//     along p*, each edge turns by more than 0 and less than half a turn the same way round: the loop winds about p*,
//     so some q = s p* lies in the hull of the loop's vertices, a part of P. Nothing was assumed about the loop being
//     the silhouette: a wrong one hides less, never too much. In 2D the loop is two points and q is on their segment.
//  2. Near plane. h.a* <= d for all of the loop, all h.a* > 0, and h.p* > d: so s > 0, and s < 1. q lies in P and
//     strictly between the viewpoint and p*.
//  3. Or the faces. p* lies beyond the plane of every face of P that the viewpoint is not surely behind. At least one
//     of these surely faces the viewpoint; P is beyond its plane too, so s > 0. Were p* on the ray before P, the ray
//     would yet have to enter P through some face; the viewpoint is in front of that one and p*, coming earlier, too.
//  What holds for p* holds for all points near it, so the ray enters P's interior (crosses the face) before p*.
// All true shadows are convex: when all points of a box or a hull pass, all that it holds is hidden. A part of an
// object never hides the whole object, as a part does not lie beyond itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/methods/occluder_part.h"

namespace gridcull {

/// Paper, figure 1: C, B, A.
enum class Overlap : std::uint8_t { outside, partial, inside };

/// 2^-53: half a unit in the last place of 1.
inline constexpr double half_ulp = 0x1p-53;

/// How far a computed world point of an object may be from the true one, and a difference to the viewpoint from the
/// true difference. 2^-48 of the sizes that take part would hold 16 roundings; it is 2^-39, so that places within 1e-12
/// of the coordinates' size count as one, as core/exact.h has it: what touches an occluder's front is not hidden by it.
inline double blur_of(const Vec3& position, double reach, const Vec3& eye) {
  const auto size = [](const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); };
  return 0x1p-39 * (size(position) + reach + size(eye));
}

/// A box in sight coordinates; holds what it stands for with all roundings.
struct SightBox {
  Vec3 centre{0.0}, half{0.0};
  double reach = 0.0;  ///< at least the distance of its farthest point

  SightBox(const Bounds& box, const Vec3& eye);
};

/// A ball in sight coordinates.
struct SightBall {
  Vec3 centre{0.0};
  double radius = 0.0;  ///< blur included
  double reach = 0.0;   ///< as above

  SightBall(const Vec3& centre_in_world, double true_radius, const Vec3& eye);
};

/// Holds p when normal.p - offset >= slope |p| + base.
struct ShadowPlane {
  Vec3 normal{0.0};  ///< unit up to rounding, away from the light: into the shadow
  double offset = 0.0, slope = 0.0, base = 0.0;
};

/// A part's silhouette as it was last seen: while the same faces look at the viewer, the loop is the same
/// (section 4.2, "tracks the silhouette").
struct SilhouetteTrack {
  std::uint64_t facing = 0;  ///< by face
  std::vector<std::uint16_t> loop{};
  bool known = false;
  std::uint64_t walks = 0;  ///< how often it had to be walked anew
};

class ShadowFrustum {
 public:
  /// False when the part hides nothing from there that could be proven: the viewpoint in it or too close, a face seen
  /// edge-on. `rotation` is the pose's.
  bool build(const OccluderPart& part, const Pose& pose, const Rotation& rotation, const Vec3& eye,
             SilhouetteTrack& track);

  /// The specialised test (section 5.3): each plane against the box's nearest and farthest corner only. `inside` is
  /// proven; `partial` may be said of a box that is outside (see methods/exact_overlap.h).
  Overlap overlap(const SightBox& box, std::uint64_t& plane_tests) const;
  Overlap overlap(const SightBall& ball, std::uint64_t& plane_tests) const;

  /// Whether all points, known up to `blur`, lie beyond the occluder if they are within its sides.
  bool beyond(std::span<const Vec3> points, double blur, std::uint64_t& plane_tests) const;
  bool beyond(const SightBall& ball, std::uint64_t& plane_tests) const;

  /// Planes through the viewpoint; a ball's enclose an inscribed pyramid.
  std::span<const ShadowPlane> sides() const { return sides_; }
  /// Whether the ray, known up to `error`, runs within the cone (a ball's own cone, not the pyramid).
  bool holds_ray(const Vec3& ray, double length, double error, std::uint64_t& plane_tests) const;

  bool is_cone() const { return cone_; }
  /// The silhouette's points, in order; in 2D and for balls none.
  std::span<const Vec3> silhouette() const { return silhouette_; }

 private:
  bool build_ball(const OccluderPart& part, const Pose& pose, const Vec3& eye, double blur);
  bool build_solid(const OccluderPart& part, double blur, SilhouetteTrack& track);
  bool build_face(double blur);
  bool build_outline(double blur);
  bool build_wall(double blur);
  bool add_sides(std::span<const std::uint16_t> loop, double blur);
  bool add_two_sides(const Vec3& right, const Vec3& left, double blur);
  void set_near_plane(std::span<const std::uint16_t> loop, double blur);
  double beside_cone(const Vec3& p) const;
  template <class Extent>
  bool beyond_extent(const Vec3& centre, double reach, const Extent& extent, std::uint64_t& plane_tests,
                     bool& before) const;

  std::vector<Vec3> points_{};        ///< of the part, in sight coordinates
  std::vector<ShadowPlane> sides_{};  ///< offset and base 0
  std::vector<ShadowPlane> faces_{};  ///< empty: too many, only the near plane counts
  std::vector<Vec3> silhouette_{};
  ShadowPlane near_{};
  bool has_near_ = false;
  // A ball's cone: p.axis sin - |p x axis| cos >= slope |p|.
  bool cone_ = false;
  Vec3 axis_{0.0};
  double sin_ = 0.0, cos_ = 0.0, cone_slope_ = 0.0;
};

}  // namespace gridcull
