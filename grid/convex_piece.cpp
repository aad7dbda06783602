// Building pieces. What is stored after scaling need not be convex to the last bit: no claim downstream uses more than
// where its points lie (piece_silhouette.cpp) or it is checked (outer_outline.cpp).
#include "gridcull/grid/convex_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "gridcull/core/error.h"
#include "gridcull/core/hull.h"
#include "gridcull/grid/exact_side.h"

namespace gridcull {
namespace {

using Loop = std::vector<std::uint8_t>;

/// Newell's normal: twice the area, along the outward normal.
Vec3 area_normal(const std::vector<Vec3>& points, const Loop& loop) {
  Vec3 sum(0.0);
  const Vec3 origin = points[loop[0]];
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += glm::cross(points[loop[i]] - origin, points[loop[i + 1]] - origin);
  }
  return sum;
}

void add_face(ConvexPiece& piece, const Loop& loop) {
  ConvexPiece::Face face;
  face.first = static_cast<std::uint16_t>(piece.loops.size());
  face.count = static_cast<std::uint16_t>(loop.size());
  piece.loops.insert(piece.loops.end(), loop.begin(), loop.end());
  const Vec3 normal = area_normal(piece.vertices, loop);
  const double length = glm::length(normal);
  if (length > 0.0) face.plane.normal = normal / length;
  piece.faces.push_back(face);
}

/// Supporting planes: no vertex lies beyond one by more than rounding.
void fit_planes(ConvexPiece& piece) {
  for (ConvexPiece::Face& face : piece.faces) {
    auto& [normal, offset] = face.plane;
    offset = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < face.count; ++i) {
      offset = std::max(offset, glm::dot(normal, piece.vertices[piece.loops[face.first + i]]));
    }
  }
}

void add_edges(ConvexPiece& piece) {
  std::map<std::array<std::uint8_t, 2>, std::uint8_t> face_of;
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    const auto& face = piece.faces[f];
    for (std::size_t i = 0; i < face.count; ++i) {
      const std::uint8_t a = piece.loops[face.first + i], b = piece.loops[face.first + (i + 1) % face.count];
      face_of[{a, b}] = static_cast<std::uint8_t>(f);
    }
  }
  for (const auto& [edge, face] : face_of) {
    if (edge[0] > edge[1]) continue;
    const auto other = face_of.find({edge[1], edge[0]});
    if (other != face_of.end()) piece.edges.push_back({edge[0], edge[1], face, other->second});
  }
}

/// Least distance of a face plane from the centre (flat: of an edge's line).
double least_distance(const ConvexPiece& piece) {
  double least = std::numeric_limits<double>::infinity();
  if (piece.kind != ConvexPiece::Kind::flat) {
    for (const auto& [plane, first, count] : piece.faces) {
      least = std::min(least, plane.offset - glm::dot(plane.normal, piece.centre));
    }
    return least;
  }
  for (const auto& edge : piece.edges) {
    const Vec3 a = piece.vertices[edge.from], b = piece.vertices[edge.to];
    const double length = glm::length(b - a);
    if (!(length > 0.0)) return 0.0;
    least = std::min(least, glm::length(glm::cross(b - a, piece.centre - a)) / length);
  }
  return least;
}

/// Half of the gap that scaling by `shrink` makes is kept as slack, the other half pays for the rounding of `centre`,
/// of the planes and of the scaling itself; that it can is checked. `size`: greatest distance of a vertex from the
/// origin.
bool set_slack(ConvexPiece& piece, double shrink, double size) {
  piece.slack = 0.5 * shrink * piece.inradius;
  // Planes and distances of coordinates up to `size`: some ten roundings of 2^-53 each.
  if (piece.slack > 0x1p-47 * size) return true;
  piece = ConvexPiece{};
  return false;
}

void set_reach(ConvexPiece& piece) {
  for (std::size_t i = 0; i < piece.vertex_count(); ++i) {
    const Vec3 v = piece.vertex(i);
    piece.reach = std::max(piece.reach, glm::length(v) * (1.0 + 0x1p-40));
    piece.radius = std::max(piece.radius, glm::length(v - piece.centre) * (1.0 + 0x1p-40));
  }
}

/// Scales about the centre.
void scale(ConvexPiece& piece, Rounding rounding) {
  const double shrink = piece.kind == ConvexPiece::Kind::flat ? flat_shrink : solid_shrink;
  piece.inradius = least_distance(piece);
  double size = 0.0;
  for (const Vec3& v : piece.vertices) size = std::max(size, glm::length(v));
  if (!set_slack(piece, shrink, size)) return;
  const double sign = rounding == Rounding::inward ? -shrink : shrink;
  for (Vec3& v : piece.vertices) v += sign * (v - piece.centre);
  for (auto& [plane, first, count] : piece.faces) {
    plane.offset += sign * (plane.offset - glm::dot(plane.normal, piece.centre));
  }
  set_reach(piece);
}

void finish(ConvexPiece& piece, Rounding rounding) {
  fit_planes(piece);
  add_edges(piece);
  Vec3 sum(0.0);
  for (const Vec3& v : piece.vertices) sum += v;
  piece.centre = sum / static_cast<double>(piece.vertices.size());
  scale(piece, rounding);
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

bool in_one_plane(const std::vector<Vec3>& points, const std::array<std::uint32_t, 3>& a,
                  const std::array<std::uint32_t, 3>& b) {
  return std::all_of(b.begin(), b.end(), [&](std::uint32_t i) {
    return side_of_plane(points[a[0]], points[a[1]], points[a[2]], points[i]) == 0;
  });
}

/// The hull's coplanar triangles joined to polygons: spreads over neighbours, then walks the border.
class FaceJoiner {
 public:
  FaceJoiner(const std::vector<Vec3>& points, const Triangles& hull)
      : points_(points), hull_(hull), taken_(hull.size(), false) {
    for (std::size_t t = 0; t < hull.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) triangle_of_[{hull[t][k], hull[t][(k + 1) % 3]}] = t;
    }
  }

  std::vector<Loop> loops() {
    std::vector<Loop> out;
    for (std::size_t t = 0; t < hull_.size(); ++t) {
      if (!taken_[t]) out.push_back(walk(border_about(t)));
    }
    return out;
  }

 private:
  /// The next vertex along the border of the face that holds the triangle.
  using Border = std::map<std::uint32_t, std::uint32_t>;

  Border border_about(std::size_t first) {
    Border next;
    std::vector<std::size_t> todo{first};
    taken_[first] = true;
    while (!todo.empty()) {
      const auto t = hull_[todo.back()];
      todo.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        const std::size_t other = triangle_of_.at({b, a});
        if (!in_one_plane(points_, hull_[first], hull_[other])) {
          next[a] = b;
        } else if (!taken_[other]) {
          taken_[other] = true;
          todo.push_back(other);
        }
      }
    }
    return next;
  }

  static Loop walk(const Border& next) {
    Loop loop;
    const std::uint32_t start = next.begin()->first;
    std::uint32_t at = start;
    do {
      loop.push_back(static_cast<std::uint8_t>(at));
      at = next.at(at);
    } while (at != start && loop.size() <= next.size());
    return loop;
  }

  const std::vector<Vec3>& points_;
  const Triangles& hull_;
  std::vector<bool> taken_;
  std::map<std::array<std::uint32_t, 2>, std::size_t> triangle_of_;
};

/// The points that are corners of the hull, or, when they are too many, every second, third, ... of them.
std::vector<Vec3> corners(std::span<const Vec3> points, std::size_t step) {
  const std::vector<Vec3> all(points.begin(), points.end());
  const Hull hull = convex_hull(all);
  std::vector<bool> used(all.size(), false);
  for (const auto& t : hull.triangles) {
    for (const std::uint32_t i : t) used[i] = true;
  }
  std::vector<Vec3> out;
  std::size_t number = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (used[i] && number++ % step == 0) out.push_back(all[i]);
  }
  return out;
}

}  // namespace

std::uint64_t ConvexPiece::bytes() const {
  return sizeof(ConvexPiece) + vertices.capacity() * sizeof(Vec3) + faces.capacity() * sizeof(Face) + loops.capacity() +
         edges.capacity() * sizeof(Edge);
}

ConvexPiece box_piece(const Vec3& centre, const Vec3& half, Rounding rounding) {
  ConvexPiece piece;
  piece.kind = ConvexPiece::Kind::box;
  piece.centre = centre;
  piece.inradius = std::min({half.x, half.y, half.z});
  if (!set_slack(piece, solid_shrink, glm::length(glm::abs(centre) + half))) return piece;
  piece.half = half + (rounding == Rounding::inward ? -solid_shrink : solid_shrink) * half;
  set_reach(piece);
  return piece;
}

ConvexPiece prism_piece(std::span<const Vec2> outline, double low, double high, Rounding rounding) {
  ConvexPiece piece;
  const std::size_t n = outline.size();
  if (n < 3 || 2 * n > ConvexPiece::max_vertices) return piece;
  for (const double z : {low, high}) {
    for (const Vec2& p : outline) piece.vertices.emplace_back(p.x, p.y, z);
  }
  Loop bottom, top;
  for (std::size_t i = 0; i < n; ++i) {
    bottom.push_back(static_cast<std::uint8_t>(n - 1 - i));
    top.push_back(static_cast<std::uint8_t>(n + i));
  }
  add_face(piece, bottom);
  add_face(piece, top);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const auto a = static_cast<std::uint8_t>(i), b = static_cast<std::uint8_t>(j);
    add_face(piece, {a, b, static_cast<std::uint8_t>(n + j), static_cast<std::uint8_t>(n + i)});
  }
  finish(piece, rounding);
  return piece;
}

ConvexPiece hull_piece(std::span<const Vec3> points, Rounding rounding) {
  ConvexPiece piece;
  try {
    std::vector<Vec3> kept = corners(points, 1);
    const std::size_t limit = ConvexPiece::max_vertices / 2;  // triangles: 2 n - 4 faces
    if (kept.size() > limit) {
      if (rounding == Rounding::outward) return piece;
      kept = corners(kept, (kept.size() + limit - 1) / limit);
    }
    const Hull hull = convex_hull(kept);
    piece.vertices = kept;
    for (const Loop& loop : FaceJoiner(kept, hull.triangles).loops()) add_face(piece, loop);
  } catch (const Error&) {
    return ConvexPiece{};
  }
  finish(piece, rounding);
  return piece;
}

// Faces keep the directions that they were given: a face may be as small as a rounding error, and its corners then do
// not tell where it looks.
ConvexPiece boundary_piece(const ConvexBoundary& boundary) {
  ConvexPiece piece;
  if (boundary.vertices.size() > ConvexPiece::max_vertices || boundary.faces.size() > ConvexPiece::max_faces ||
      boundary.faces.empty()) {
    return piece;
  }
  piece.vertices = boundary.vertices;
  for (const ConvexBoundary::Face& face : boundary.faces) {
    Loop loop;
    for (std::uint32_t i = 0; i < face.count; ++i) {
      loop.push_back(static_cast<std::uint8_t>(boundary.loops[face.first + i]));
    }
    add_face(piece, loop);
    piece.faces.back().plane.normal = face.normal;
  }
  finish(piece, Rounding::outward);
  return piece;
}

ConvexPiece flat_piece(std::span<const Vec3> polygon) {
  ConvexPiece piece;
  piece.kind = ConvexPiece::Kind::flat;
  const std::size_t n = polygon.size();
  if (n < 3 || 2 * n > ConvexPiece::max_vertices) return ConvexPiece{};
  piece.vertices.assign(polygon.begin(), polygon.end());
  Loop front, back;
  for (std::size_t i = 0; i < n; ++i) {
    front.push_back(static_cast<std::uint8_t>(i));
    back.push_back(static_cast<std::uint8_t>(n - 1 - i));
  }
  add_face(piece, front);
  add_face(piece, back);
  finish(piece, Rounding::inward);
  return piece;
}

}  // namespace gridcull
