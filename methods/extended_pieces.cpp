// Trapezoids: the classical decomposition by heights (e.g. M. de Berg et al., "Computational Geometry", chapter 6),
// without a sweep, since outlines are short.
//
// Why parts lie inside. Between two neighbouring vertex heights an edge is a straight line from bottom to top. Where
// the edges' orders at bottom and top agree, no two cross in between, and the even-odd rule fills between edges 1 and
// 2, 3 and 4 and so on. Corners are interpolated, once each: within 2^-51 of the coordinates, which `blur` holds.
#include "gridcull/methods/extended_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "gridcull/core/hull.h"
#include "gridcull/core/volume.h"
#include "gridcull/core/world_points.h"

namespace gridcull::extended {
namespace {

using Outline = std::vector<Vec2>;

/// Counter-clockwise, once round, no turn to the right; nothing otherwise. A turn that rounding gets wrong is one of
/// at most 1e-15 of the coordinates, which `blur` holds.
std::optional<Outline> as_convex(Outline outline) {
  const std::size_t n = outline.size();
  double area = 0.0;
  for (std::size_t i = 0; i < n; ++i) area += cross2(outline[i] - outline[0], outline[(i + 1) % n] - outline[0]);
  if (area < 0.0) std::reverse(outline.begin(), outline.end());
  int rises = 0;  // changes from going down to going up: one in a turn
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % n], &c = outline[(i + 2) % n];
    const double turn = cross2(b - a, c - b);
    if (turn < 0.0 || (turn == 0.0 && glm::dot(b - a, c - b) <= 0.0)) return std::nullopt;
    const bool up = b.y > a.y || (b.y == a.y && b.x < a.x), up_next = c.y > b.y || (c.y == b.y && c.x < b.x);
    rises += !up && up_next;
  }
  if (rises != 1) return std::nullopt;
  return outline;
}

/// An edge within a band of heights.
struct Chord {
  double low, high;  ///< x at the band's bottom and top
};

double at_height(const Vec2& a, const Vec2& b, double y) {
  if (y == a.y) return a.x;
  if (y == b.y) return b.x;
  return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}

/// The chords of a band from left to right.
std::vector<Chord> chords_of(const Outline& outline, double low, double high) {
  std::vector<Chord> chords;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    if (a.y > b.y) std::swap(a, b);
    if (a.y <= low && b.y >= high) chords.push_back({at_height(a, b, low), at_height(a, b, high)});
  }
  std::sort(chords.begin(), chords.end(),
            [](const Chord& a, const Chord& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  return chords;
}

bool any_cross(const std::vector<Chord>& chords) {
  for (std::size_t i = 1; i < chords.size(); ++i) {
    if (chords[i].high < chords[i - 1].high) return true;
  }
  return false;
}

Outline rectangle_of(const Outline& outline, double low, double high) {
  double left = outline[0].x, right = left;
  for (const Vec2& p : outline) left = std::min(left, p.x), right = std::max(right, p.x);
  return {{left, low}, {right, low}, {right, high}, {left, high}};
}

/// `above` on top of `below`, as one, if they share an edge and that is convex.
std::optional<Outline> joined(const Outline& below, const Outline& above) {
  // Corners are bottom left, bottom right, then up the right side, top right, top left, down the left side.
  const double top = below[below.size() / 2].y;
  std::size_t right = 0;
  while (right + 1 < below.size() && below[right].y < top) ++right;
  if (below[right].y != top || below[(right + 1) % below.size()].y != top) return std::nullopt;
  if (below[right] != above[1] || below[(right + 1) % below.size()] != above[0]) return std::nullopt;
  Outline out(below.begin(), below.begin() + static_cast<std::ptrdiff_t>(right) + 1);
  out.insert(out.end(), above.begin() + 2, above.end());
  out.insert(out.end(), below.begin() + static_cast<std::ptrdiff_t>(right) + 1, below.end());
  return as_convex(out);
}

}  // namespace

OutlineParts convex_parts_of(const Outline& raw) {
  const Outline outline = merged_outline(raw);
  OutlineParts out;
  if (outline.size() < 3) return out;
  if (auto whole = as_convex(outline)) {
    out.parts.push_back(std::move(*whole));
    return out;
  }
  std::vector<double> heights;
  for (const Vec2& p : outline) heights.push_back(p.y);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  std::vector<Outline>& parts = out.parts;
  for (std::size_t k = 0; k + 1 < heights.size(); ++k) {
    const double low = heights[k], high = heights[k + 1];
    const std::vector<Chord> chords = chords_of(outline, low, high);
    if (any_cross(chords)) {
      out.left_out.push_back(rectangle_of(outline, low, high));
      continue;
    }
    for (std::size_t i = 0; i + 1 < chords.size(); i += 2) {
      const Chord &l = chords[i], &r = chords[i + 1];
      if (!(l.low < r.low || l.high < r.high)) continue;
      Outline part{{l.low, low}, {r.low, low}, {r.high, high}, {l.high, high}};
      const auto below = std::find_if(parts.begin(), parts.end(), [&](Outline& other) {
        auto both = joined(other, part);
        if (both) other = std::move(*both);
        return both.has_value();
      });
      if (below == parts.end()) parts.push_back(std::move(part));
    }
  }
  return out;
}

namespace {

void add_box_edges(Polytope& out) {
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (const std::uint32_t bit : {1u, 2u, 4u}) {
      if ((i & bit) == 0) out.edges.push_back({i, i | bit});
    }
  }
}

void add_hull_edges(const Hull& hull, Piece& piece) {
  for (const auto& t : hull.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] < t[(k + 1) % 3]) piece.polytope.edges.push_back({t[k], t[(k + 1) % 3]});
    }
  }
  for (const HalfSpace& side : hull.sides) piece.normals.push_back(-side.normal);
}

Piece prism_piece(const Outline& part, double height, const Pose& pose, const Rotation& r) {
  Piece piece;
  const auto n = static_cast<std::uint32_t>(part.size());
  for (const double z : {0.0, height}) {
    for (const Vec2& p : part) piece.polytope.points.push_back(to_world(pose, r, {p, z}));
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    piece.polytope.edges.insert(piece.polytope.edges.end(), {{i, next}, {n + i, n + next}, {i, n + i}});
    const Vec2 along = part[next] - part[i];
    piece.normals.push_back(r * Vec3(along.y, -along.x, 0.0));
  }
  piece.normals.push_back(r.z);
  piece.normals.push_back(-r.z);
  return piece;
}

/// 26 points on the sphere, in the directions of a cube's corners, edges and sides. They are drawn in by 1e-12 of the
/// radius, so that roundings leave none outside.
Piece sphere_piece(const Vec3& centre, double radius) {
  Piece piece;
  std::vector<Vec3> around;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) around.push_back(glm::normalize(Vec3(x, y, z)));
      }
    }
  }
  for (const Vec3& p : around) piece.polytope.points.push_back(centre + radius * (1.0 - 1e-12) * p);
  add_hull_edges(convex_hull(around), piece);
  return piece;
}

Piece flat_piece(const std::vector<Vec3>& corners) {
  Piece piece;
  piece.polytope.points = corners;
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    piece.polytope.edges.push_back({i, (i + 1) % static_cast<std::uint32_t>(corners.size())});
  }
  return piece;
}

/// Whether a, b, c, d is a convex quadrilateral, flat to within `blur`: what then gets through between its hull and its
/// two triangles lies in their planes. Turns are judged in the coordinate plane that it is largest in.
bool flat_convex(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double blur) {
  const Vec3 normal = glm::cross(c - a, d - b);
  if (!(std::fabs(glm::dot(normal, b - a)) <= blur * glm::length(normal))) return false;
  const Vec3 n = glm::abs(normal);
  const int drop = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  const auto flat = [drop](const Vec3& p) { return Vec2(p[(drop + 1) % 3], p[(drop + 2) % 3]); };
  const auto turn = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    return cross2(flat(q) - flat(p), flat(r) - flat(q));
  };
  const double first = turn(a, b, c);
  return first != 0.0 && first * turn(b, c, d) > 0.0 && first * turn(c, d, a) > 0.0 && first * turn(d, a, b) > 0.0;
}

void add_faces(const Faces& faces, const std::vector<Vec3>& world, double blur, std::vector<Piece>& out) {
  using Key = std::array<std::uint32_t, 2>;
  std::map<Key, std::size_t> open;  // edge, ascending -> a triangle that has it and no partner
  std::vector<char> used(faces.triangles.size(), 0);
  for (std::size_t i = 0; i < faces.triangles.size(); ++i) {
    const auto& t = faces.triangles[i];
    for (std::size_t k = 0; k < 3 && !used[i]; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3], tip = t[(k + 2) % 3];
      const auto partner = open.find({std::min(a, b), std::max(a, b)});
      if (partner == open.end() || used[partner->second]) continue;
      for (const std::uint32_t other : faces.triangles[partner->second]) {
        if (other == a || other == b || !flat_convex(world[tip], world[a], world[other], world[b], blur)) continue;
        out.push_back(flat_piece({world[tip], world[a], world[other], world[b]}));
        used[i] = used[partner->second] = 1;
      }
    }
    for (std::size_t k = 0; k < 3 && !used[i]; ++k) {
      open[{std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])}] = i;
    }
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    const auto& t = faces.triangles[i];
    if (!used[i]) out.push_back(flat_piece({world[t[0]], world[t[1]], world[t[2]]}));
  }
}

/// A box in local axes that holds all points.
Piece box_about(const std::vector<Vec3>& points, const Pose& pose, const Rotation& r) {
  Bounds box;
  for (const Vec3& p : points) box.add(p);
  Pose base = pose;
  base.position = to_world(pose, r, {0.0, 0.0, box.min.z});
  const Vec2 low(box.min), high(box.max);
  const double height = std::max(box.size().z, std::numeric_limits<double>::min());
  return prism_piece({low, {high.x, low.y}, high, {low.x, high.y}}, height, base, r);
}

void set_width(Piece& piece) {
  for (const Vec3& normal : piece.normals) {
    const double length = glm::length(normal);
    if (!(length > 0.0)) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& p : piece.polytope.points) {
      const double along = glm::dot(normal, p - piece.polytope.points[0]) / length;
      low = std::min(low, along), high = std::max(high, along);
    }
    piece.width = std::min(piece.width, high - low);
  }
}

double size_of(const Vec3& p) { return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z); }

}  // namespace

Occluder make_occluder(const Object& object) {
  Occluder out;
  out.id = object.id;
  out.thin = is_thin(object.shape);
  // Each coordinate is a sum of four products of magnitudes below size + reach, with some ten roundings of 2^-53.
  out.blur = 4e-15 * (size_of(object.pose.position) + reach_of(object.shape));
  const Rotation r = rotation_of(object.pose.orientation);
  const std::vector<Vec3> world = world_vertices(object.shape, object.pose);
  if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
    out.pieces.push_back(sphere_piece(object.pose.position, sphere->radius));
    out.ball = sphere->radius;
  } else if (std::holds_alternative<Cuboid>(object.shape)) {
    Piece& piece = out.pieces.emplace_back();
    piece.polytope.points = world;
    add_box_edges(piece.polytope);
    piece.normals = {r.x, -r.x, r.y, -r.y, r.z, -r.z};
  } else if (const auto* prism = std::get_if<Prism>(&object.shape)) {
    const OutlineParts parts = convex_parts_of(prism->vertices);
    for (const Outline& part : parts.parts) out.pieces.push_back(prism_piece(part, prism->height, object.pose, r));
    if (parts.parts.size() + parts.left_out.size() > 1) {
      out.concave = {merged_outline(prism->vertices), prism->height, object.pose.position, r};
    }
    for (const Outline& part : parts.left_out) out.covers.push_back(prism_piece(part, prism->height, object.pose, r));
  } else if (const auto* convex = std::get_if<Convex>(&object.shape)) {
    out.pieces.emplace_back().polytope.points = world;
    // Of the local points: in the world, far from the origin, rounding may flatten a small hull.
    add_hull_edges(convex_hull(convex->vertices), out.pieces.back());
    for (Vec3& normal : out.pieces.back().normals) normal = r * normal;
  } else if (const auto* faces = std::get_if<Faces>(&object.shape)) {
    add_faces(*faces, world, 0.25 * out.blur, out.pieces);
    if (faces->closed) out.covers.push_back(box_about(faces->vertices, object.pose, r));
  } else if (const auto* volume = std::get_if<Volume>(&object.shape)) {
    for (const LatticeBox& box : volume->body->inner) {
      Piece& piece = out.pieces.emplace_back();
      for (const Vec3& p : inner_corners(*volume, box)) piece.polytope.points.push_back(to_world(object.pose, r, p));
      add_box_edges(piece.polytope);
      const Rotation turn = rotation_of(volume->field->frame().pose.orientation);
      for (const Vec3& axis : {turn.x, turn.y, turn.z})
        piece.normals.insert(piece.normals.end(), {r * axis, -(r * axis)});
    }
    out.covers.push_back(box_about(volume->body->outer, object.pose, r));
  }
  for (Piece& piece : out.pieces) {
    set_width(piece);
    for (const Vec3& p : piece.polytope.points) out.box.add(p);
  }
  // Exactly vertical: then upper and lower points have the same x and y, bit for bit.
  const bool straight = r.z.x == 0.0 && r.z.y == 0.0 && r.x.z == 0.0 && r.y.z == 0.0;
  out.upright =
      straight && (std::holds_alternative<Cuboid>(object.shape) || std::holds_alternative<Prism>(object.shape));
  return out;
}

Occludee make_occludee(const Object& object) {
  Occludee out;
  out.id = object.id;
  if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
    out.ball = true;
    out.centre = object.pose.position;
    out.radius = sphere->radius;
    out.box.add_ball(out.centre, out.radius);
    return out;
  }
  out.points = world_vertices(object.shape, object.pose);
  for (const Vec3& p : out.points) out.box.add(p);
  return out;
}

}  // namespace gridcull::extended
