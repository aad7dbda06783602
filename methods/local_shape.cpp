#include "gridcull/methods/local_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gridcull/core/bounds.h"
#include "gridcull/core/hull.h"
#include "gridcull/core/volume.h"
#include "gridcull/methods/even_odd.h"

namespace gridcull {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A piece of a line, as parameters.
struct Piece {
  double begin, end;
  bool empty() const { return !(begin < end); }
};

/// Keeps where at + t * speed > 0.
void clip(Piece& piece, double at, double speed) {
  if (speed == 0.0) {
    if (!(at > 0.0)) piece.end = -infinity;
    return;
  }
  const double t = -at / speed;
  if (speed > 0.0) {
    piece.begin = std::max(piece.begin, t);
  } else {
    piece.end = std::min(piece.end, t);
  }
}

bool ball_blocks(double radius, const Vec3& from, const Vec3& along) {
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? std::clamp(-glm::dot(from, along) / square, 0.0, 1.0) : 0.0;
  const Vec3 nearest = from + t * along;
  return glm::dot(nearest, nearest) < radius * radius;
}

bool box_blocks(const LocalShape& shape, const Vec3& from, const Vec3& along) {
  Piece piece{0.0, 1.0};
  for (int k = 0; k < (shape.flat ? 2 : 3); ++k) {
    clip(piece, shape.half[k] - from[k], -along[k]);
    clip(piece, shape.half[k] + from[k], along[k]);
    if (piece.empty()) return false;
  }
  return true;
}

bool hull_blocks(const LocalShape& shape, const Vec3& from, const Vec3& along) {
  Piece piece{0.0, 1.0};
  for (const HalfSpace& side : shape.sides) {
    clip(piece, glm::dot(side.normal, from) - side.offset, glm::dot(side.normal, along));
    if (piece.empty()) return false;
  }
  return true;
}

/// Parameters at which the line crosses the outline, ascending: in pairs they are its pieces inside (even-odd rule).
void cut_outline(const std::vector<Vec2>& outline, const Vec2& from, const Vec2& along, std::vector<double>& cuts) {
  cuts.clear();
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 a = outline[j] - from, b = outline[i] - from;
    const double side_a = cross2(along, a), side_b = cross2(along, b);
    if ((side_a > 0.0) == (side_b > 0.0)) continue;
    const Vec2 edge = b - a;
    cuts.push_back(cross2(a, edge) / cross2(along, edge));
  }
  std::sort(cuts.begin(), cuts.end());
}

/// First piece of the line inside a polygon or prism that has something beyond `limits.begin`, cut to `limits`.
Piece outline_piece(const LocalShape& shape, const Vec3& from, const Vec3& along, Piece limits,
                    std::vector<double>& cuts) {
  const Piece none{infinity, infinity};
  if (!shape.flat) {
    clip(limits, from.z, along.z);
    clip(limits, 2.0 * shape.half.z - from.z, -along.z);
    if (limits.empty()) return none;
  }
  if (along.x == 0.0 && along.y == 0.0) return even_odd(shape.points, Vec2(from)) ? limits : none;
  cut_outline(shape.points, Vec2(from), Vec2(along), cuts);
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
    const Piece piece{std::max(limits.begin, cuts[i]), std::min(limits.end, cuts[i + 1])};
    if (!piece.empty()) return piece;
  }
  return none;
}

bool chain_blocks(const std::vector<Vec2>& points, const Vec2& from, const Vec2& along) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec2 a = points[i - 1] - from, b = points[i] - from;
    const double side_a = cross2(along, a), side_b = cross2(along, b);
    if ((side_a > 0.0) == (side_b > 0.0)) continue;
    const double t = cross2(a, b - a) / cross2(along, b - a);
    if (t > 0.0 && t < 1.0) return true;
  }
  return false;
}

/// T. Moeller and B. Trumbore, "Fast, minimum storage ray-triangle intersection", 1997; either side counts.
bool triangle_blocks(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& along) {
  const Vec3 u = b - a, v = c - a, p = glm::cross(along, v);
  const double det = glm::dot(u, p);
  if (det == 0.0) return false;
  const Vec3 w = from - a;
  const double s = glm::dot(w, p) / det;
  if (!(s >= 0.0 && s <= 1.0)) return false;
  const Vec3 q = glm::cross(w, u);
  const double r = glm::dot(along, q) / det;
  if (!(r >= 0.0 && s + r <= 1.0)) return false;
  const double t = glm::dot(v, q) / det;
  return t > 0.0 && t < 1.0;
}

bool faces_block(const LocalShape& shape, const Vec3& from, const Vec3& along) {
  return std::any_of(shape.triangles.begin(), shape.triangles.end(), [&](const auto& t) {
    return triangle_blocks(shape.vertices[t[0]], shape.vertices[t[1]], shape.vertices[t[2]], from, along);
  });
}

void set_box(LocalShape& shape, const Bounds& box) {
  shape.middle = box.centre();
  shape.half = 0.5 * box.size();
  shape.radius = glm::length(shape.half);
}

void set_points(LocalShape& shape, const std::vector<Vec2>& points, double height) {
  shape.points = points;
  Bounds box;
  for (const Vec2& p : points) box.add({p, 0.0}), box.add({p, height});
  set_box(shape, box);
}

void set_vertices(LocalShape& shape, const std::vector<Vec3>& vertices) {
  shape.vertices = vertices;
  Bounds box;
  for (const Vec3& p : vertices) box.add(p);
  set_box(shape, box);
}

/// The boxes within it; where it is too thin to have any, what is about it.
void set_volume(LocalShape& shape, const Volume& volume) {
  set_vertices(shape, volume.body->outer);
  if (volume.body->inner.empty()) {
    shape.triangles = convex_hull(shape.vertices).triangles;
    return;
  }
  shape.vertices.clear();
  for (const LatticeBox& box : volume.body->inner) {
    const auto base = static_cast<std::uint32_t>(shape.vertices.size());
    for (const auto& t : box_triangles) shape.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    for (const Vec3& p : inner_corners(volume, box)) shape.vertices.push_back(p);
  }
}

void set_ball(LocalShape& shape, double radius) {
  shape.radius = radius;
  shape.half = shape.flat ? Vec3(radius, radius, 0.0) : Vec3(radius);
}

}  // namespace

LocalShape make_local_shape(const Shape& shape) {
  using Kind = LocalShape::Kind;
  LocalShape out;
  out.flat = dimension_of(shape) == 2;
  if (const auto* disc = std::get_if<Disc>(&shape)) set_ball(out, disc->radius);
  if (const auto* sphere = std::get_if<Sphere>(&shape)) set_ball(out, sphere->radius);
  if (const auto* box = std::get_if<Rectangle>(&shape)) {
    out.kind = Kind::box;
    set_box(out, {Vec3(-0.5 * box->size, 0.0), Vec3(0.5 * box->size, 0.0)});
  } else if (const auto* cuboid = std::get_if<Cuboid>(&shape)) {
    out.kind = Kind::box;
    set_box(out, {-0.5 * cuboid->size, 0.5 * cuboid->size});
  } else if (const auto* polygon = std::get_if<Polygon>(&shape)) {
    out.kind = Kind::outline;
    set_points(out, merged_outline(polygon->vertices), 0.0);
  } else if (const auto* prism = std::get_if<Prism>(&shape)) {
    out.kind = Kind::outline;
    set_points(out, merged_outline(prism->vertices), prism->height);
  } else if (const auto* chain = std::get_if<Polyline>(&shape)) {
    out.kind = Kind::chain;
    set_points(out, chain->vertices, 0.0);
  } else if (const auto* convex = std::get_if<Convex>(&shape)) {
    out.kind = Kind::hull;
    const Hull hull = convex_hull(convex->vertices);
    out.sides = hull.sides;
    out.triangles = hull.triangles;
    set_vertices(out, convex->vertices);
  } else if (const auto* faces = std::get_if<Faces>(&shape)) {
    out.kind = Kind::faces;
    out.triangles = faces->triangles;
    set_vertices(out, faces->vertices);
  } else if (const auto* volume = std::get_if<Volume>(&shape)) {
    out.kind = Kind::faces;
    set_volume(out, *volume);
  }
  return out;
}

bool blocks_segment(const LocalShape& shape, const Vec3& from, const Vec3& along, std::vector<double>& scratch) {
  switch (shape.kind) {
    case LocalShape::Kind::ball: return ball_blocks(shape.radius, from, along);
    case LocalShape::Kind::box: return box_blocks(shape, from, along);
    case LocalShape::Kind::hull: return hull_blocks(shape, from, along);
    case LocalShape::Kind::outline: return !outline_piece(shape, from, along, {0.0, 1.0}, scratch).empty();
    case LocalShape::Kind::chain: return chain_blocks(shape.points, Vec2(from), Vec2(along));
    case LocalShape::Kind::faces: return faces_block(shape, from, along);
  }
  return false;
}

double outline_entry(const LocalShape& shape, const Vec3& from, const Vec3& along, double after,
                     std::vector<double>& scratch) {
  return outline_piece(shape, from, along, {after, infinity}, scratch).begin;
}

}  // namespace gridcull
