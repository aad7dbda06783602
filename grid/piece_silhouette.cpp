// Claim. Let W be the loop's rays, computed points that lie inside the true shape K (convex_piece.h), d a direction
// strictly to the inner side of the planes through the viewpoint and each two consecutive rays. Then the ray along d
// meets K's interior no later than at `farthest`.
// Proof. K's interior does not hold the viewpoint (the caller leaves such objects out), so a plane through the
// viewpoint has W strictly on one side and W's directions are points of an affine plane. About d's point there each
// edge of the loop turns the same way, so the loop winds about d at least once, so d lies inside the convex hull of W's
// points (outside the hull the loop winds zero times): some point q of hull(W), a subset of K, lies on the ray, and
// |q| <= the greatest |w|, balls being convex. d is interior to K's cone, so its ray does not just touch K: K's
// interior meets it up to q or right behind it. The key is rounded up.
// Nothing was assumed about which faces were taken for front faces: a wrong sign loses coverage only. For a
// decision that matters little, ties may fall either way.
//
// Flat pieces. The rounded triangles that make up the polygon lie within slack of it, across and along the plane.
// A ray through the shrunken polygon at height h over its plane and length r crosses the true surface within
// blur * r / h along the plane of where it crosses the polygon, so the piece is used only where blur * 2 r / h <=
// slack.
//
// Near a face the loop's rays open to almost a half-space, where consecutive rays are all but opposite and their
// cross products lose digits. There the whole loop recedes towards the centre of the piece: still points of K.
#include "gridcull/grid/piece_silhouette.h"

#include <algorithm>
#include <cmath>

#include "gridcull/grid/sight.h"
#include "gridcull/grid/silhouette_loop.h"

namespace gridcull {
namespace {

/// Below this ratio of height over the nearest face to the farthest ray the loop recedes by `recede`.
/// After that the piece is not used: every two rays stay this far from opposite, and cross products keep 40 bits.
constexpr double near_face = 0x1p-12, recede = 0x1p-5;

double sum_of_magnitudes(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

double greatest_length(const Outline& outline) {
  double square = 0.0;
  for (int i = 0; i < outline.count; ++i) {
    const Vec3& ray = outline.rays[static_cast<std::size_t>(i)];
    square = std::max(square, glm::dot(ray, ray));
  }
  return rounded_up(std::sqrt(square));
}

/// Moves the loop towards the centre. False where that is not enough.
bool step_back(const PlacedPiece& placed, const VertexLoop& loop, Outline& out) {
  const ConvexPiece& piece = placed.piece;
  if (piece.kind == ConvexPiece::Kind::flat) return false;
  const Vec3 centre = placed.frame.origin + placed.frame.rotation * piece.centre;
  for (int i = 0; i < out.count; ++i) {
    Vec3& ray = out.rays[static_cast<std::size_t>(i)];
    ray += recede * (centre - ray);
  }
  out.farthest = greatest_length(out);
  return loop.height + recede * piece.inradius > near_face * out.farthest;
}

}  // namespace

SightFrame sight_frame(const Pose& pose, const Rotation& rotation, const Vec3& viewpoint) {
  const Vec3 origin = pose.position - viewpoint;
  return {rotation, origin, rotation.inverse(-origin),
          0x1p-47 * (sum_of_magnitudes(pose.position) + sum_of_magnitudes(viewpoint))};
}

double sight_blur(const ConvexPiece& piece, const SightFrame& frame) { return frame.blur + 0x1p-47 * piece.reach; }

bool silhouette(const PlacedPiece& placed, Outline& out) {
  VertexLoop loop;
  return silhouette(placed, out, loop);
}

bool silhouette(const PlacedPiece& placed, Outline& out, VertexLoop& loop) {
  const ConvexPiece& piece = placed.piece;
  const double blur = sight_blur(piece, placed.frame);
  if (!(blur <= piece.slack)) return false;
  find_loop(piece, placed.frame.apex, loop);
  if (loop.count == 0) return false;
  out.count = loop.count;
  for (int i = 0; i < loop.count; ++i) {
    out.rays[static_cast<std::size_t>(i)] =
        placed.frame.origin + placed.frame.rotation * piece.vertex(loop.vertex[static_cast<std::size_t>(i)]);
  }
  out.nearest = loop.height;
  out.farthest = greatest_length(out);
  if (piece.kind == ConvexPiece::Kind::flat && !(2.0 * blur * out.farthest <= loop.height * piece.slack)) return false;
  return loop.height > near_face * out.farthest || step_back(placed, loop, out);
}

}  // namespace gridcull
