#include "gridcull/methods/exact_overlap.h"

#include <cmath>
#include <limits>

namespace gridcull {
namespace {

/// A piece of an edge, as parameters.
struct Piece {
  double begin = 0.0, end = 1.0;

  /// Keeps where at + t * speed >= 0.
  void clip(double at, double speed) {
    if (speed > 0.0) {
      begin = std::fmax(begin, -at / speed);
    } else if (speed < 0.0) {
      end = std::fmin(end, -at / speed);
    } else if (at < 0.0) {
      end = -std::numeric_limits<double>::infinity();
    }
  }
  bool empty() const { return !(begin <= end); }
};

/// All planes: `outside` where one parts them, `inside` where the nearest corner passes all.
Overlap against_planes(std::span<const ShadowPlane> planes, const TurnedBox& box, Operations& done) {
  bool inside = true;
  for (const ShadowPlane& plane : planes) {
    Vec3 n = plane.normal;
    if (!box.along_axes) {
      n = {glm::dot(n, box.axes[0]), glm::dot(n, box.axes[1]), glm::dot(n, box.axes[2])};
      done.dots += 3;
    }
    // Nearest and farthest corner: signs of n choose them, n.corner = n.centre -+ |n|.half.
    const double at = glm::dot(plane.normal, box.centre) - plane.offset;
    ++done.dots;
    const double around = std::fabs(n.x) * box.half.x + std::fabs(n.y) * box.half.y + std::fabs(n.z) * box.half.z;
    ++done.dots;
    if (at + around < 0.0) return Overlap::outside;
    inside = inside && at - around >= 0.0;
  }
  return inside ? Overlap::inside : Overlap::partial;
}

bool edge_meets_box(const VolumeEdge& edge, const TurnedBox& box, Operations& done) {
  Piece piece;
  if (edge.endless) piece.end = std::numeric_limits<double>::infinity();
  const Vec3 from = edge.from - box.centre;
  ++done.sums;
  Vec3 at = from, along = edge.along;
  if (!box.along_axes) {
    at = {glm::dot(box.axes[0], from), glm::dot(box.axes[1], from), glm::dot(box.axes[2], from)};
    along = {glm::dot(box.axes[0], edge.along), glm::dot(box.axes[1], edge.along), glm::dot(box.axes[2], edge.along)};
    done.dots += 6;
  }
  done.sums += 2;      // half - at, half + at
  done.scalings += 2;  // both by `along`
  for (int k = 0; k < 3; ++k) {
    piece.clip(box.half[k] - at[k], -along[k]);
    piece.clip(box.half[k] + at[k], along[k]);
  }
  return !piece.empty();
}

/// One edge of the box from a corner along an axis against all planes.
bool edge_meets_volume(std::span<const ShadowPlane> planes, const Vec3& from, const Vec3& along, Operations& done) {
  Piece piece;
  for (const ShadowPlane& plane : planes) {
    const double at = glm::dot(plane.normal, from) - plane.offset, speed = glm::dot(plane.normal, along);
    done.dots += 2;
    piece.clip(at, speed);
    if (piece.empty()) break;
  }
  // Quotients come three to a vector.
  done.scalings += (planes.size() + 2) / 3;
  return !piece.empty();
}

bool box_edges_meet(std::span<const ShadowPlane> planes, const TurnedBox& box, Operations& done) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    const auto half = [&](std::size_t i) { return box.half[static_cast<int>(i)] * box.axes[i]; };
    for (int corner = 0; corner < 4; ++corner) {
      const Vec3 across = (corner & 1 ? half(u) : -half(u)) + (corner & 2 ? half(v) : -half(v));
      const Vec3 from = box.centre + across - half(k);
      done.sums += 3;
      if (edge_meets_volume(planes, from, 2.0 * half(k), done)) return true;
    }
  }
  return false;
}

}  // namespace

Overlap exact_overlap(std::span<const ShadowPlane> planes, std::span<const VolumeEdge> edges, const TurnedBox& box,
                      Operations& done) {
  const Overlap rough = against_planes(planes, box, done);
  if (rough != Overlap::partial) return rough;
  for (const VolumeEdge& edge : edges) {
    if (edge_meets_box(edge, box, done)) return Overlap::partial;
  }
  return box_edges_meet(planes, box, done) ? Overlap::partial : Overlap::outside;
}

/// The volume is the cone from the viewpoint, without near plane.
bool lies_beside(const ShadowFrustum& frustum, const SightBox& box, std::vector<VolumeEdge>& scratch,
                 Operations& done) {
  if (frustum.is_cone() || frustum.silhouette().size() < 3) return false;
  scratch.clear();
  for (const Vec3& ray : frustum.silhouette()) scratch.push_back({Vec3(0.0), ray, true});
  TurnedBox turned;
  turned.centre = box.centre;
  turned.half = box.half;
  return exact_overlap(frustum.sides(), scratch, turned, done) == Overlap::outside;
}

}  // namespace gridcull
