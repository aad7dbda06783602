#include "gridcull/core/shape.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/core/mesh.h"
#include "gridcull/core/world_points.h"

namespace gridcull {
namespace {

constexpr double greatest_magnitude = 1e9;

template <class... F>
struct Overload : F... {
  using F::operator()...;
};
template <class... F>
Overload(F...) -> Overload<F...>;

[[noreturn]] void refuse(std::string_view shape, const std::string& why) {
  throw Error(ErrorCode::bad_scene, std::string(shape) + ": " + why);
}

void check_size(double value, std::string_view shape, std::string_view what) {
  if (!(value > 0.0) || value > greatest_magnitude) {
    refuse(shape, "expected a " + std::string(what) + " above 0 and at most 1e9, found " + std::to_string(value));
  }
}

template <class V>
void check_points(const std::vector<V>& points, std::string_view shape) {
  for (const V& p : points) {
    for (int k = 0; k < V::length(); ++k) {
      if (!(std::fabs(p[k]) <= greatest_magnitude)) {
        refuse(shape, "expected finite coordinates of magnitude at most 1e9");
      }
    }
  }
}

void check_outline(const std::vector<Vec2>& vertices, std::string_view shape) {
  check_points(vertices, shape);
  std::vector<Vec2> distinct = vertices;
  const auto less = [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
  std::sort(distinct.begin(), distinct.end(), less);
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  if (distinct.size() < 3) {
    refuse(shape, "expected at least three distinct points, found " + std::to_string(distinct.size()));
  }
}

bool all_in_one_plane(const std::vector<Vec3>& points) {
  // The farthest point from the first, from their line, from their plane; flat when any step finds nothing.
  const Vec3 a = points.front();
  double scale = 0.0;
  Vec3 b = a;
  for (const Vec3& p : points) {
    if (glm::length(p - a) > scale) scale = glm::length(p - a), b = p;
  }
  if (!(scale > 0.0)) return true;
  const Vec3 u = (b - a) / scale;
  double off_line = 0.0;
  Vec3 normal(0.0);
  for (const Vec3& p : points) {
    const Vec3 n = glm::cross(u, p - a);
    if (glm::length(n) > off_line) off_line = glm::length(n), normal = n;
  }
  if (off_line <= 1e-9 * scale) return true;
  double off_plane = 0.0;
  for (const Vec3& p : points) off_plane = std::max(off_plane, std::fabs(glm::dot(normal / off_line, p - a)));
  return off_plane <= 1e-9 * scale;
}

template <class V>
double farthest(const std::vector<V>& points) {
  double best = 0.0;
  for (const V& p : points) best = std::max(best, glm::length(p));
  return best;
}

}  // namespace

int dimension_of(const Shape& shape) { return shape.index() < 4 ? 2 : 3; }

std::string_view name_of(const Shape& shape) {
  constexpr std::array<std::string_view, 10> names{"disc", "box",   "polygon", "polyline", "sphere",
                                                   "box",  "prism", "convex",  "faces",    "volume"};
  const auto* faces = std::get_if<Faces>(&shape);
  return faces != nullptr && faces->closed ? "mesh" : names[shape.index()];
}

bool is_thin(const Shape& shape) {
  const auto* faces = std::get_if<Faces>(&shape);
  return std::holds_alternative<Polyline>(shape) || (faces != nullptr && !faces->closed);
}

double reach_of(const Shape& shape) {
  const double exact = std::visit(
      Overload{
          [](const Disc& s) { return s.radius; }, [](const Rectangle& s) { return 0.5 * glm::length(s.size); },
          [](const Polygon& s) { return farthest(s.vertices); }, [](const Polyline& s) { return farthest(s.vertices); },
          [](const Sphere& s) { return s.radius; }, [](const Cuboid& s) { return 0.5 * glm::length(s.size); },
          [](const Prism& s) { return std::hypot(farthest(s.vertices), s.height); },
          [](const Convex& s) { return farthest(s.vertices); }, [](const Faces& s) { return farthest(s.vertices); },
          [](const Volume& s) { return farthest(s.body->outer); }},
      shape);
  // Covers a dozen roundings of 2^-53 each and orientations that are off unit length by 1e-9.
  return exact * (1.0 + 1e-8);
}

void validate(const Shape& shape) {
  const std::string_view name = name_of(shape);
  std::visit(Overload{[&](const Disc& s) { check_size(s.radius, name, "radius"); },
                      [&](const Rectangle& s) {
                        check_size(s.size.x, name, "length");
                        check_size(s.size.y, name, "width");
                      },
                      [&](const Polygon& s) { check_outline(s.vertices, name); },
                      [&](const Polyline& s) {
                        check_points(s.vertices, name);
                        if (s.vertices.size() < 2) refuse(name, "expected at least two points");
                      },
                      [&](const Sphere& s) { check_size(s.radius, name, "radius"); },
                      [&](const Cuboid& s) {
                        check_size(s.size.x, name, "size in x");
                        check_size(s.size.y, name, "size in y");
                        check_size(s.size.z, name, "size in z");
                      },
                      [&](const Prism& s) {
                        check_outline(s.vertices, name);
                        check_size(s.height, name, "height");
                      },
                      [&](const Convex& s) {
                        check_points(s.vertices, name);
                        if (s.vertices.size() < 4 || all_in_one_plane(s.vertices)) {
                          refuse(name, "expected at least four points, not all in one plane");
                        }
                      },
                      [&](const Faces& s) {
                        check_points(s.vertices, name);
                        if (s.triangles.empty()) refuse(name, "expected at least one triangle");
                        for (const auto& t : s.triangles) {
                          for (const std::uint32_t i : t) {
                            if (i >= s.vertices.size()) {
                              refuse(name, "triangle names vertex " + std::to_string(i) + ", but there are " +
                                               std::to_string(s.vertices.size()));
                            }
                          }
                        }
                        if (!s.closed) return;
                        const MeshHoles holes = find_holes(s);
                        if (holes.open_edges > 0) {
                          refuse(name, "expected no hole, found " + std::to_string(holes.open_edges) + " open edges");
                        }
                      },
                      [&](const Volume& s) {
                        if (!s.field || !s.body) refuse(name, "expected one that make_volume() made");
                      }},
             shape);
}

std::vector<Vec2> merged_outline(const std::vector<Vec2>& vertices) {
  std::vector<Vec2> out;
  for_each_merged(vertices, [&](const Vec2& p) { out.push_back(p); });
  return out;
}

std::vector<Vec2> world_outline(const Shape& shape, const Pose& pose) {
  std::vector<Vec2> world;
  if (dimension_of(shape) == 3) return world;
  for_each_world_point(shape, pose, [&](const Vec3& p) { world.emplace_back(p); });
  return world;
}

std::vector<Vec3> world_vertices(const Shape& shape, const Pose& pose) {
  std::vector<Vec3> world;
  if (dimension_of(shape) == 2) return world;
  for_each_world_point(shape, pose, [&](const Vec3& p) { world.push_back(p); });
  return world;
}

}  // namespace gridcull
