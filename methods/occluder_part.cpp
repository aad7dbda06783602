#include "gridcull/methods/occluder_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "gridcull/core/error.h"
#include "gridcull/core/hull.h"
#include "gridcull/core/volume.h"
#include "gridcull/methods/convex_partition.h"

namespace gridcull {
namespace {

using Kind = OccluderPart::Kind;
using Loop = std::vector<std::uint16_t>;  ///< a face's vertices, counter-clockwise seen from outside

/// A hull of n points has at most 2 n - 4 triangles.
constexpr std::size_t most_corners = OccluderPart::most_faces / 2 + 2;

constexpr std::array<std::array<std::uint16_t, 4>, 6> box_faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

void finish(OccluderPart& part) {
  Vec3 sum(0.0);
  for (const Vec3& v : part.vertices) sum += v;
  part.centre = sum / static_cast<double>(part.vertices.size());
  for (const Vec3& v : part.vertices) {
    part.radius = std::max(part.radius, glm::length(v - part.centre));
    part.reach = std::max(part.reach, glm::length(v) * (1.0 + 0x1p-40));
  }
}

/// Least extent of the points across one of the planes through a point that has this normal.
void add_width(const std::vector<Vec3>& points, const Vec3& normal, double& width) {
  const double length = glm::length(normal);
  if (!(length > 0.0)) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : points) {
    const double along = glm::dot(normal, p - points[0]) / length;
    low = std::min(low, along), high = std::max(high, along);
  }
  width = std::min(width, high - low);
}

/// Those three corners of the face that span the greatest triangle with its first.
OccluderPart::Face spanning(const std::vector<Vec3>& points, const Loop& loop) {
  OccluderPart::Face best{loop[0], loop[1], loop[2]};
  double most = -1.0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    for (std::size_t j = i + 1; j < loop.size(); ++j) {
      const double area = glm::length(glm::cross(points[loop[i]] - points[loop[0]], points[loop[j]] - points[loop[0]]));
      if (area > most) most = area, best = {loop[0], loop[i], loop[j]};
    }
  }
  return best;
}

Vec3 area_of(const std::vector<Vec3>& points, const Loop& loop) {
  Vec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += glm::cross(points[loop[i]] - points[loop[0]], points[loop[i + 1]] - points[loop[0]]);
  }
  return 0.5 * sum;
}

OccluderPart solid(std::vector<Vec3> vertices, const std::vector<Loop>& loops) {
  OccluderPart part;
  part.kind = Kind::solid;
  part.vertices = std::move(vertices);
  std::map<std::array<std::uint16_t, 2>, std::uint16_t> face_of;
  for (std::uint16_t f = 0; f < loops.size(); ++f) {
    const Loop& loop = loops[f];
    part.faces.push_back(spanning(part.vertices, loop));
    for (std::size_t i = 0; i < loop.size(); ++i) face_of[{loop[i], loop[(i + 1) % loop.size()]}] = f;
    const Vec3 area = area_of(part.vertices, loop);
    for (int k = 0; k < 3; ++k) part.area[k] += 0.5 * std::fabs(area[k]);
  }
  for (const auto& [edge, face] : face_of) {
    const auto other = face_of.find({edge[1], edge[0]});
    if (edge[0] < edge[1] && other != face_of.end()) part.edges.push_back({edge[0], edge[1], face, other->second});
  }
  part.width = std::numeric_limits<double>::infinity();
  for (const Loop& loop : loops) add_width(part.vertices, area_of(part.vertices, loop), part.width);
  finish(part);
  return part;
}

/// Corners by bits: 1 = +x, 2 = +y, 4 = +z.
OccluderPart box_part(const std::array<Vec3, 8>& corners) {
  std::vector<Loop> loops;
  for (const auto& face : box_faces) loops.emplace_back(face.begin(), face.end());
  return solid({corners.begin(), corners.end()}, loops);
}

OccluderPart box(const Cuboid& shape) {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = 0.5 * shape.size * Vec3((i & 1) ? 1.0 : -1.0, (i & 2) ? 1.0 : -1.0, (i & 4) ? 1.0 : -1.0);
  }
  return box_part(corners);
}

/// Every second, third, ... point where there are too many: a polygon in the polygon.
std::vector<Vec2> thinned(const std::vector<Vec2>& outline, std::size_t most) {
  const std::size_t step = (outline.size() + most - 1) / most;
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < outline.size(); i += step) out.push_back(outline[i]);
  return out;
}

OccluderPart prism(const std::vector<Vec2>& outline, double height) {
  const auto n = static_cast<std::uint16_t>(outline.size());
  std::vector<Vec3> vertices;
  for (const double z : {0.0, height}) {
    for (const Vec2& p : outline) vertices.emplace_back(p, z);
  }
  std::vector<Loop> loops(2);
  for (std::uint16_t i = 0; i < n; ++i) {
    const auto j = static_cast<std::uint16_t>((i + 1) % n);
    loops[0].push_back(static_cast<std::uint16_t>(n - 1 - i));
    loops[1].push_back(static_cast<std::uint16_t>(n + i));
    loops.push_back({i, j, static_cast<std::uint16_t>(n + j), static_cast<std::uint16_t>(n + i)});
  }
  return solid(std::move(vertices), loops);
}

/// The points that are corners of their hull.
std::vector<Vec3> corners_of(const std::vector<Vec3>& points) {
  std::vector<bool> used(points.size(), false);
  for (const auto& t : convex_hull(points).triangles) {
    for (const std::uint32_t i : t) used[i] = true;
  }
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (used[i]) out.push_back(points[i]);
  }
  return out;
}

void add_hull(const std::vector<Vec3>& points, std::vector<OccluderPart>& out) {
  try {
    std::vector<Vec3> corners = corners_of(points);
    if (corners.size() > most_corners) {
      const std::size_t step = (corners.size() + most_corners - 1) / most_corners;
      std::vector<Vec3> some;
      for (std::size_t i = 0; i < corners.size(); i += step) some.push_back(corners[i]);
      corners = corners_of(some);
    }
    std::vector<Loop> loops;
    for (const auto& t : convex_hull(corners).triangles) {
      loops.push_back(
          {static_cast<std::uint16_t>(t[0]), static_cast<std::uint16_t>(t[1]), static_cast<std::uint16_t>(t[2])});
    }
    out.push_back(solid(std::move(corners), loops));
  } catch (const Error&) {
    // Flat after thinning: hides nothing.
  }
}

void add_triangles(const Faces& shape, std::vector<OccluderPart>& out) {
  for (const auto& t : shape.triangles) {
    OccluderPart part;
    part.kind = Kind::face;
    part.vertices = {shape.vertices[t[0]], shape.vertices[t[1]], shape.vertices[t[2]]};
    part.area = area_of(part.vertices, {0, 1, 2});
    if (!(glm::length(part.area) > 0.0)) continue;
    finish(part);
    out.push_back(std::move(part));
  }
}

OccluderPart outline_part(const std::vector<Vec2>& outline) {
  OccluderPart part;
  part.kind = Kind::outline;
  part.flat = true;
  Vec2 low = outline[0], high = outline[0];
  for (const Vec2& p : outline) {
    part.vertices.emplace_back(p, 0.0);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  part.area = {high.y - low.y, high.x - low.x, 0.0};
  part.width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const Vec3 along = part.vertices[(i + 1) % part.vertices.size()] - part.vertices[i];
    add_width(part.vertices, {along.y, -along.x, 0.0}, part.width);
  }
  finish(part);
  return part;
}

void add_walls(const Polyline& shape, std::vector<OccluderPart>& out) {
  for (std::size_t i = 0; i + 1 < shape.vertices.size(); ++i) {
    const Vec2 a = shape.vertices[i], b = shape.vertices[i + 1];
    if (a == b) continue;
    OccluderPart part;
    part.kind = Kind::wall;
    part.flat = true;
    part.vertices = {Vec3(a, 0.0), Vec3(b, 0.0)};
    part.area = {b.y - a.y, a.x - b.x, 0.0};
    finish(part);
    out.push_back(std::move(part));
  }
}

OccluderPart ball(double radius, double area) {
  OccluderPart part;
  part.radius = part.reach = radius;
  part.area = {area, 0.0, 0.0};
  return part;
}

}  // namespace

std::vector<OccluderPart> make_occluder_parts(const Shape& shape) {
  std::vector<OccluderPart> out;
  if (const auto* disc = std::get_if<Disc>(&shape)) {
    out.push_back(ball(disc->radius, 2.0 * disc->radius));
    out.back().flat = true;
  }
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    out.push_back(ball(sphere->radius, std::numbers::pi * sphere->radius * sphere->radius));
  }
  if (const auto* cuboid = std::get_if<Cuboid>(&shape)) out.push_back(box(*cuboid));
  if (const auto* rectangle = std::get_if<Rectangle>(&shape)) {
    const Vec2 h = 0.5 * rectangle->size;
    out.push_back(outline_part({{-h.x, -h.y}, {h.x, -h.y}, {h.x, h.y}, {-h.x, h.y}}));
  }
  if (const auto* polygon = std::get_if<Polygon>(&shape)) {
    for (const auto& part : convex_partition(merged_outline(polygon->vertices))) out.push_back(outline_part(part));
  }
  if (const auto* swept = std::get_if<Prism>(&shape)) {
    for (const auto& part : convex_partition(merged_outline(swept->vertices))) {
      const std::vector<Vec2> few = thinned(part, OccluderPart::most_faces - 2);
      if (few.size() >= 3) out.push_back(prism(few, swept->height));
    }
  }
  if (const auto* convex = std::get_if<Convex>(&shape)) add_hull(convex->vertices, out);
  if (const auto* faces = std::get_if<Faces>(&shape)) add_triangles(*faces, out);
  if (const auto* volume = std::get_if<Volume>(&shape)) {
    for (const LatticeBox& box : volume->body->inner) out.push_back(box_part(inner_corners(*volume, box)));
  }
  if (const auto* line = std::get_if<Polyline>(&shape)) add_walls(*line, out);
  return out;
}

double area_angle(const OccluderPart& part, const Vec3& sight) {
  const double square = glm::dot(sight, sight);
  if (!(square > 0.0)) return 0.0;
  const double length = std::sqrt(square), spread = part.flat ? length : square;
  if (part.kind == Kind::ball) return part.area.x / spread;
  double seen = glm::dot(part.area, sight) / length;
  if (part.kind != Kind::face && part.kind != Kind::wall) {
    seen = (part.area.x * std::fabs(sight.x) + part.area.y * std::fabs(sight.y) + part.area.z * std::fabs(sight.z)) /
           length;
  }
  return std::fabs(seen) / spread;
}

}  // namespace gridcull
