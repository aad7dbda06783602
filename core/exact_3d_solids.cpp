#include "gridcull/core/exact_3d_solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/exact_3d_volume.h"
#include "gridcull/core/hull.h"

namespace gridcull::exact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Relative to coordinates: what rounding may do to a place.
constexpr double blur = 1e-12;

void make_box(const Cuboid& box, Solid& solid) {
  solid.kind = SolidKind::convex;
  for (int k = 0; k < 3; ++k) {
    Vec3 normal(0.0);
    normal[k] = 1.0;
    solid.sides.push_back({normal, -0.5 * box.size[k]});
    solid.sides.push_back({-normal, -0.5 * box.size[k]});
  }
  // Vertices by bits +x +y +z; each side's four corners counter-clockwise from outside.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> quads{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& q : quads) {
    solid.triangles.push_back({q[0], q[1], q[2]});
    solid.triangles.push_back({q[0], q[2], q[3]});
  }
  solid.box.add(0.5 * box.size);
  solid.box.add(-0.5 * box.size);
}

void make_shape(const Shape& shape, Solid& solid) {
  if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    solid.kind = SolidKind::sphere;
    solid.radius = sphere->radius;
  } else if (const auto* box = std::get_if<Cuboid>(&shape)) {
    make_box(*box, solid);
  } else if (const auto* prism = std::get_if<Prism>(&shape)) {
    solid.kind = SolidKind::prism;
    solid.outline = merged_outline(prism->vertices);
    for (const Vec2& p : solid.outline) solid.box.add({p, 0.0});
    solid.box.max.z = prism->height;
  } else if (const auto* convex = std::get_if<Convex>(&shape)) {
    const Hull hull = convex_hull(convex->vertices);
    solid.kind = SolidKind::convex;
    solid.sides = hull.sides;
    solid.triangles = hull.triangles;
    for (const Vec3& p : convex->vertices) solid.box.add(p);
  } else if (const auto* faces = std::get_if<Faces>(&shape)) {
    solid.kind = SolidKind::faces;
    solid.closed = faces->closed;
    solid.triangles = faces->triangles;
    for (const Vec3& p : faces->vertices) solid.box.add(p);
  }
}

void make_volume(const Volume& volume, const Pose& pose, Solid& solid) {
  solid.kind = SolidKind::volume;
  auto field = std::make_shared<const RayVolume>(volume, pose);
  solid.vertices = field->inside_points();
  solid.world_box = field->world_box();
  solid.reach = 0.0;  // of the field's own, not of what the methods take it for
  for (int i = 0; i < 8; ++i) {
    const Vec3 &low = solid.world_box.min, &high = solid.world_box.max;
    const Vec3 corner((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z);
    solid.box.add(solid.rotation.inverse(corner - solid.position));
    solid.reach = std::max(solid.reach, glm::length(corner - solid.position) * (1.0 + 1e-9));
  }
  solid.field = std::move(field);
}

/// Cuts the stretch with dot(normal, p) >= offset. False when nothing is left.
bool clip(Stretch& s, double at_eye, double along) {
  if (along == 0.0) return at_eye > 0.0;
  const double t = -at_eye / along;
  if (along > 0.0) {
    s.begin = std::max(s.begin, t);
  } else {
    s.end = std::min(s.end, t);
  }
  return s.begin < s.end;
}

void add_sphere(const Solid& solid, const Vec3& eye, const Vec3& ray, std::vector<Stretch>& out) {
  const Vec3 c = solid.position - eye;
  const double along = glm::dot(c, ray);
  const double across = glm::length(glm::cross(c, ray));
  const double square = (solid.radius - across) * (solid.radius + across);
  if (square <= 0.0) return;
  const double half = std::sqrt(square), distance = glm::length(c);
  const double power = (distance - solid.radius) * (distance + solid.radius);
  // The end with the larger magnitude first; their product is the power of the eye.
  const double far = along >= 0.0 ? along + half : along - half;
  const double near = power / far;
  out.push_back({std::min(near, far), std::max(near, far)});
}

/// Even-odd stretches of a line in the plane, as parameters along (dx, dy).
void add_outline(const std::vector<Vec2>& outline, const Vec2& eye, const Vec2& ray, std::vector<double>& cuts) {
  const double square = glm::dot(ray, ray);
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 a = outline[j] - eye, b = outline[i] - eye;
    const double side_a = cross2(ray, a), side_b = cross2(ray, b);
    if ((side_a > 0.0) == (side_b > 0.0)) continue;
    const Vec2 e = b - a;
    cuts.push_back(glm::dot(a + e * (side_a / (side_a - side_b)), ray) / square);
  }
  std::sort(cuts.begin(), cuts.end());
}

bool even_odd(const std::vector<Vec2>& outline, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Vec2 a = outline[j] - p, b = outline[i] - p;
    if ((a.y > 0.0) != (b.y > 0.0) && (cross2(a, b) > 0.0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

void add_prism(const Solid& solid, const Vec3& eye, const Vec3& ray, std::vector<Stretch>& out) {
  Stretch slab{-infinity, infinity};
  if (!clip(slab, eye.z, ray.z) || !clip(slab, solid.box.max.z - eye.z, -ray.z)) return;
  if (ray.x == 0.0 && ray.y == 0.0) {
    if (even_odd(solid.outline, Vec2(eye))) out.push_back(slab);
    return;
  }
  std::vector<double> cuts;
  add_outline(solid.outline, Vec2(eye), Vec2(ray), cuts);
  for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
    const Stretch s{std::max(slab.begin, cuts[i]), std::min(slab.end, cuts[i + 1])};
    if (s.begin < s.end) out.push_back(s);
  }
}

/// T. Moeller and B. Trumbore, "Fast, minimum storage ray-triangle intersection", 1997; either side counts.
std::optional<double> cross_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& eye, const Vec3& ray) {
  const Vec3 u = b - a, v = c - a, p = glm::cross(ray, v);
  const double det = glm::dot(u, p);
  if (det == 0.0) return std::nullopt;
  const Vec3 w = eye - a;
  const double s = glm::dot(w, p) / det;
  const Vec3 q = glm::cross(w, u);
  const double t = glm::dot(ray, q) / det;
  if (!(s >= 0.0 && t >= 0.0 && s + t <= 1.0)) return std::nullopt;
  return glm::dot(v, q) / det;
}

void add_faces(const Solid& solid, const Vec3& eye, const Vec3& ray, std::vector<Stretch>& out) {
  const std::size_t before = out.size();
  for (const auto& t : solid.triangles) {
    const auto hit = cross_triangle(solid.vertices[t[0]], solid.vertices[t[1]], solid.vertices[t[2]], eye, ray);
    if (hit) out.push_back({*hit, *hit});
  }
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end(),
            [](const Stretch& a, const Stretch& b) { return a.begin < b.begin; });
}

double distance_to_box(const Bounds& box, const Vec3& p) {
  Vec3 off(0.0);
  for (int k = 0; k < 3; ++k) off[k] = std::max({0.0, box.min[k] - p[k], p[k] - box.max[k]});
  return glm::length(off);
}

}  // namespace

std::vector<Solid> make_solids(std::span<const Object> world) {
  std::vector<Solid> solids;
  solids.reserve(world.size());
  for (const Object& object : world) {
    if (dimension_of(object.shape) != 3) {
      throw Error(ErrorCode::bad_scene, "object " + std::to_string(object.id) + ": expected a 3D shape");
    }
    Solid& solid = solids.emplace_back();
    solid.id = object.id;
    solid.occluder = object.occluder;
    solid.position = object.pose.position;
    solid.rotation = rotation_of(object.pose.orientation);
    solid.reach = reach_of(object.shape);
    if (const auto* volume = std::get_if<Volume>(&object.shape)) {
      make_volume(*volume, object.pose, solid);
      continue;
    }
    solid.vertices = world_vertices(object.shape, object.pose);
    make_shape(object.shape, solid);
    for (const Vec3& p : solid.vertices) solid.world_box.add(p);
    if (solid.kind == SolidKind::sphere) solid.world_box.add_ball(solid.position, solid.radius);
  }
  return solids;
}

void add_stretches(const Solid& solid, const Vec3& eye, const Vec3& ray, std::vector<Stretch>& out) {
  if (solid.kind == SolidKind::sphere) return add_sphere(solid, eye, ray, out);
  if (solid.kind == SolidKind::faces) return add_faces(solid, eye, ray, out);
  if (solid.kind == SolidKind::volume) return solid.field->add_stretches(eye, ray, out);
  const Vec3 local_eye = solid.rotation.inverse(eye - solid.position);
  const Vec3 local_ray = solid.rotation.inverse(ray);
  if (solid.kind == SolidKind::prism) return add_prism(solid, local_eye, local_ray, out);
  Stretch s{-infinity, infinity};
  for (const HalfSpace& side : solid.sides) {
    if (!clip(s, glm::dot(side.normal, local_eye) - side.offset, glm::dot(side.normal, local_ray))) return;
  }
  out.push_back(s);
}

namespace {

/// The point lies between the crossings that it should: none near it, and an odd number ahead.
bool odd_ahead(const std::vector<Stretch>& crossings, double margin) {
  const auto near = [&](const Stretch& s) { return std::fabs(s.begin) <= margin; };
  const auto ahead = std::count_if(crossings.begin(), crossings.end(), [](const Stretch& s) { return s.begin > 0.0; });
  return ahead % 2 != 0 && std::none_of(crossings.begin(), crossings.end(), near);
}

bool within_one(const std::vector<Stretch>& stretches, double margin) {
  return std::any_of(stretches.begin(), stretches.end(),
                     [&](const Stretch& s) { return s.begin < -margin && s.end > margin; });
}

}  // namespace

bool surely_holds(const Solid& solid, const Vec3& point) {
  if (solid.kind == SolidKind::faces && !solid.closed) return false;
  if (glm::length(point - solid.position) > solid.reach * (1.0 + blur)) return false;
  if (solid.kind == SolidKind::volume && !solid.field->surely_inside(point)) return false;
  const double margin = blur * (std::fabs(point.x) + std::fabs(point.y) + std::fabs(point.z) + solid.reach);
  // Inside and not near the surface in any of seven directions that no outline is aligned with.
  constexpr std::array<std::array<double, 3>, 7> rays{{{0.6, 0.7, 0.39},
                                                       {-0.61, 0.53, 0.59},
                                                       {0.31, -0.87, 0.38},
                                                       {0.22, 0.13, -0.97},
                                                       {0.98, -0.17, 0.07},
                                                       {0.09, 0.99, -0.11},
                                                       {-0.13, 0.08, 0.99}}};
  std::vector<Stretch> stretches;
  for (const auto& r : rays) {
    stretches.clear();
    add_stretches(solid, point, glm::normalize(Vec3(r[0], r[1], r[2])), stretches);
    if (!(solid.closed ? odd_ahead(stretches, margin) : within_one(stretches, margin))) return false;
  }
  return true;
}

double rough_distance(const Solid& solid, const Vec3& point) {
  if (solid.kind == SolidKind::faces) return infinity;
  const Vec3 d = point - solid.position;
  if (solid.kind == SolidKind::sphere) return std::fabs(glm::length(d) - solid.radius);
  return distance_to_box(solid.box, solid.rotation.inverse(d));
}

}  // namespace gridcull::exact
