// Claim. A section at distance k is spanned by points of the piece's front faces at distances up to k (rounded: up to
// the key). They are points of the true shape K within a ball about the viewpoint, so that the claim of
// piece_silhouette.cpp holds with them for W. Which points are taken is a matter of coverage only: nothing else that is
// rounded here (distances, feet, the order on the hull) needs a proof, and the key is the greatest length of the points
// as computed, rounded up. That the points lie in K: they are vertices, points between two vertices, and points of a
// face's plane that lie to the left of all its edges by more than rounding. They take one more rotation than
// sight_blur() counts, so slack must be twice that.
#include "gridcull/grid/piece_sections.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "gridcull/grid/angular_hull.h"
#include "gridcull/grid/sight.h"
#include "gridcull/grid/silhouette_loop.h"

namespace gridcull {
namespace {

/// Ratios of farthest to nearest distance from which 2, 3 and 4 sections pay.
constexpr std::array<double, 3> paying{1.3, 2.0, 4.0};
/// As in piece_silhouette.cpp: keeps rays away from opposite.
constexpr double near_face = 0x1p-12;

/// Twelve directions about a circle: cosines and sines of multiples of 30 degrees. Rounded: any point will do.
constexpr double c30 = 0.8660254037844386;
constexpr std::array<std::array<double, 2>, 12> circle{{{1, 0},
                                                        {c30, 0.5},
                                                        {0.5, c30},
                                                        {0, 1},
                                                        {-0.5, c30},
                                                        {-c30, 0.5},
                                                        {-1, 0},
                                                        {-c30, -0.5},
                                                        {-0.5, -c30},
                                                        {0, -1},
                                                        {0.5, -c30},
                                                        {c30, -0.5}}};

struct Points {
  std::array<SeenPoint, 2 * Outline::max_rays> points;
  std::size_t count = 0;

  /// What finds no room is left out.
  void add(const Vec3& p) {
    if (count < points.size()) points[count++].point = p;
  }
};

/// A front face, relative to the viewpoint, in the object's axes.
struct FrontFace {
  Vec3 normal;
  double height;
  std::array<Vec3, ConvexPiece::max_vertices> corner;
  std::size_t count;
};

/// False where the viewpoint is not in front of it.
bool load(const ConvexPiece& piece, const Vec3& apex, std::size_t face, FrontFace& out) {
  const ConvexPiece::Plane plane = piece.plane(face);
  out.normal = plane.normal;
  out.height = glm::dot(plane.normal, apex) - plane.offset;
  if (!(out.height > 0.0)) return false;
  const std::span<const std::uint8_t> loop = piece.loop(face);
  out.count = loop.size();
  for (std::size_t i = 0; i < out.count; ++i) out.corner[i] = piece.vertex(loop[i]) - apex;
  return true;
}

/// Corners within k and points of edges at distance k.
void add_border(const FrontFace& face, double k, Points& out) {
  for (std::size_t i = 0; i < face.count; ++i) {
    const Vec3& a = face.corner[i];
    const Vec3 e = face.corner[i + 1 == face.count ? 0 : i + 1] - a;
    const double ee = glm::dot(e, e), ae = glm::dot(a, e), power = glm::dot(a, a) - k * k;
    if (power <= 0.0) out.add(a);
    const double square = ae * ae - ee * power;
    if (!(square > 0.0)) continue;
    const double root = std::sqrt(square);
    for (const double t : {(-ae - root) / ee, (-ae + root) / ee}) {
      if (t > 0.0 && t < 1.0) out.add(a + t * e);
    }
  }
}

/// Points inside the face on the circle at distance k.
void add_circle(const FrontFace& face, double k, double margin, Points& out) {
  const double square = (k - face.height) * (k + face.height);
  if (!(square > 0.0)) return;
  const double radius = std::sqrt(square);
  const Vec3 foot = -face.height * face.normal;
  const Vec3 side = face.corner[1] - face.corner[0];
  const Vec3 u = (radius / glm::length(side)) * side, v = glm::cross(face.normal, u);
  // How far inside each edge: at the foot, and what u and v add.
  std::array<Vec3, ConvexPiece::max_vertices> inside;
  for (std::size_t i = 0; i < face.count; ++i) {
    const Vec3& a = face.corner[i];
    const Vec3 inward = glm::cross(face.normal, face.corner[i + 1 == face.count ? 0 : i + 1] - a);
    inside[i] = {glm::dot(inward, foot - a) - margin * glm::length(inward), glm::dot(inward, u), glm::dot(inward, v)};
  }
  for (const auto& [c, s] : circle) {
    bool in = true;
    for (std::size_t i = 0; i < face.count; ++i) in = in && inside[i].x + c * inside[i].y + s * inside[i].z > 0.0;
    if (in) out.add(foot + c * u + s * v);
  }
}

/// Distance of the face's nearest point.
double distance_of(const FrontFace& face) {
  double square = face.height * face.height;
  bool foot_inside = true;
  double border = std::numeric_limits<double>::infinity();
  const Vec3 foot = -face.height * face.normal;
  for (std::size_t i = 0; i < face.count; ++i) {
    const Vec3& a = face.corner[i];
    const Vec3 e = face.corner[i + 1 == face.count ? 0 : i + 1] - a;
    foot_inside = foot_inside && glm::dot(glm::cross(e, foot - a), face.normal) >= 0.0;
    const Vec3 p = a + std::clamp(-glm::dot(a, e) / glm::dot(e, e), 0.0, 1.0) * e;
    border = std::min(border, glm::dot(p, p));
  }
  if (!foot_inside) square = border;
  return std::sqrt(square);
}

class Sections {
 public:
  Sections(const PlacedPiece& placed, const VertexLoop& loop) : placed_(placed), loop_(loop) {}

  double nearest() const {
    if (placed_.piece.kind == ConvexPiece::Kind::box) {
      const Vec3 off = glm::abs(placed_.frame.apex - placed_.piece.centre) - placed_.piece.half;
      return glm::length(glm::max(off, Vec3(0.0)));
    }
    double least = std::numeric_limits<double>::infinity();
    for_front_faces([&](const FrontFace& face) { least = std::min(least, distance_of(face)); });
    return least;
  }

  bool at(double k, Section& out) const {
    if (!(loop_.height > near_face * k)) return false;
    return placed_.piece.kind == ConvexPiece::Kind::box ? box_at(k, out) : solid_at(k, out);
  }

 private:
  // Of a box: the silhouette of a smaller box about its nearest point, a tenth of the work of cutting its faces by a
  // ball. Its corners are points of the box (as computed: within the rounding that the claim's slack pays for), which
  // is all that the claim asks of a section; its faces that see the viewpoint are parts of the box's, so the loop is
  // the same.
  bool box_at(double k, Section& out) const {
    const ConvexPiece& piece = placed_.piece;
    const Vec3 centre = piece.centre - placed_.frame.apex, low = centre - piece.half, high = centre + piece.half;
    const Vec3 reach = box_reach(k, low, high), a = glm::max(low, -reach), b = glm::min(high, reach);
    double square = 0.0;
    out.outline.count = loop_.count;
    for (int i = 0; i < loop_.count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int corner = loop_.vertex[at];
      Vec3& ray = out.outline.rays[at];
      ray = placed_.frame.rotation *
            Vec3((corner & 1) != 0 ? b.x : a.x, (corner & 2) != 0 ? b.y : a.y, (corner & 4) != 0 ? b.z : a.z);
      square = std::max(square, glm::dot(ray, ray));
    }
    out.key = rounded_up(std::sqrt(square));
    return loop_.count >= 3;
  }

  // How far to go along each axis, for corners within k: what is left of k^2 beyond the nearest point is shared evenly,
  // and what an axis cannot use the others get.
  static Vec3 box_reach(double k, const Vec3& low, const Vec3& high) {
    const Vec3 nearest = glm::max(glm::max(low, -high), Vec3(0.0)), farthest = glm::max(glm::abs(low), glm::abs(high));
    const Vec3 wanted = farthest * farthest - nearest * nearest;
    std::array<int, 3> order{0, 1, 2};
    const auto sort = [&](std::size_t i, std::size_t j) {
      if (wanted[order[j]] < wanted[order[i]]) std::swap(order[i], order[j]);
    };
    sort(0, 1), sort(1, 2), sort(0, 1);
    double left = std::max(0.0, k * k - glm::dot(nearest, nearest));
    Vec3 reach;
    for (int i = 0; i < 3; ++i) {
      const int axis = order[static_cast<std::size_t>(i)];
      const double taken = std::min(wanted[axis], left / (3 - i));
      left -= taken;
      reach[axis] = std::sqrt(nearest[axis] * nearest[axis] + taken);
    }
    return reach;
  }

  bool solid_at(double k, Section& out) const {
    Points points;
    for_front_faces([&](const FrontFace& face) {
      add_border(face, k, points);
      add_circle(face, k, 0x1p-44 * (k + placed_.piece.reach), points);
    });
    if (points.count < 3) return false;
    const Vec3 axis = -placed_.piece.plane(static_cast<std::size_t>(loop_.highest)).normal;
    if (!angular_hull({points.points.data(), points.count}, axis, out.outline) || out.outline.count < 3) return false;
    double square = 0.0;
    for (int i = 0; i < out.outline.count; ++i) {
      Vec3& ray = out.outline.rays[static_cast<std::size_t>(i)];
      ray = placed_.frame.rotation * ray;
      square = std::max(square, glm::dot(ray, ray));
    }
    out.key = rounded_up(std::sqrt(square));
    return true;
  }

  template <class F>
  void for_front_faces(const F& f) const {
    FrontFace front;
    for (std::size_t face = 0, faces = placed_.piece.face_count(); face < faces; ++face) {
      if (load(placed_.piece, placed_.frame.apex, face, front)) f(front);
    }
  }

  const PlacedPiece& placed_;
  const VertexLoop& loop_;
};

/// Keys wanted between the two: about geometric, by square roots, which round alike everywhere.
int wanted_keys(double nearest, double farthest, std::array<double, 3>& keys) {
  const double ratio = farthest / nearest, half = std::sqrt(ratio), quarter = std::sqrt(half);
  if (!(ratio > paying[0])) return 0;
  if (!(ratio > paying[1])) return keys[0] = nearest * half, 1;
  if (!(ratio > paying[2])) return keys = {nearest * quarter * std::sqrt(quarter), nearest * half * quarter, 0.0}, 2;
  return keys = {nearest * quarter, nearest * half, nearest * half * quarter}, 3;
}

/// Only the rays that there are: an outline has room for 64.
void assign(Section& to, const Section& from) {
  if (&to == &from) return;
  to.key = from.key;
  to.outline.count = from.outline.count;
  to.outline.nearest = from.outline.nearest, to.outline.farthest = from.outline.farthest;
  std::copy_n(from.outline.rays.begin(), from.outline.count, to.outline.rays.begin());
}

}  // namespace

int sections(const PlacedPiece& placed, std::span<Section> out) {
  if (out.empty()) return 0;
  Section& whole = out.back();
  VertexLoop loop;
  if (!silhouette(placed, whole.outline, loop)) return 0;
  const double farthest = whole.key = whole.outline.farthest, least = farthest - 2.0 * placed.piece.radius;
  int count = 0;
  if (out.size() > 1 && farthest > paying[0] * least &&
      2.0 * sight_blur(placed.piece, placed.frame) <= placed.piece.slack) {
    const Sections at(placed, loop);
    std::array<double, 3> keys;
    const int wanted = std::min(wanted_keys(at.nearest(), farthest, keys), static_cast<int>(out.size()) - 1);
    for (int i = 0; i < wanted; ++i) {
      Section& section = out[static_cast<std::size_t>(count)];
      if (at.at(keys[static_cast<std::size_t>(i)], section) && section.key < farthest) ++count;
    }
  }
  assign(out[static_cast<std::size_t>(count++)], whole);
  return count;
}

}  // namespace gridcull
