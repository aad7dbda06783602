#include "gridcull/methods/surface_points.h"

#include <algorithm>
#include <cmath>

namespace gridcull {
namespace {

using Kind = LocalShape::Kind;

/// By rejection: no sine, whose last bits differ between machines.
Vec3 on_ball(const LocalShape& shape, Random& random) {
  for (;;) {
    const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), shape.flat ? 0.0 : random.uniform(-1, 1));
    const double square = glm::dot(p, p);
    if (square <= 1.0 && square > 1e-4) return p * (shape.radius / std::sqrt(square));
  }
}

std::vector<Vec2> box_outline(const LocalShape& shape) {
  const Vec2 m(shape.middle), h(shape.half);
  return {m - h, m + Vec2(h.x, -h.y), m + h, m + Vec2(-h.x, h.y)};
}

/// Edge i of a closed outline.
Vec2 on_edge(const std::vector<Vec2>& points, std::size_t i, Random& random) {
  const Vec2 &a = points[i], &b = points[(i + 1) % points.size()];
  return a + random.unit() * (b - a);
}

Vec3 on_box_face(const LocalShape& shape, std::size_t face, Random& random) {
  Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  p[static_cast<int>(face / 2)] = face % 2 == 0 ? -1.0 : 1.0;
  return shape.middle + p * shape.half;
}

bool even_odd(const std::vector<Vec2>& points, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    const Vec2 &a = points[i], &b = points[j];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// A cap so thin that no draw meets it is as good as its rim.
Vec2 on_cap(const LocalShape& shape, Random& random) {
  const Vec2 m(shape.middle), h(shape.half);
  for (int i = 0; i < 64; ++i) {
    const Vec2 p = m + Vec2(random.uniform(-1, 1), random.uniform(-1, 1)) * h;
    if (even_odd(shape.points, p)) return p;
  }
  return shape.points[random.below(static_cast<std::uint32_t>(shape.points.size()))];
}

Vec3 on_triangle(const LocalShape& shape, std::size_t i, Random& random) {
  const auto& t = shape.triangles[i];
  double u = random.unit(), v = random.unit();
  if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
  const Vec3& a = shape.vertices[t[0]];
  return a + u * (shape.vertices[t[1]] - a) + v * (shape.vertices[t[2]] - a);
}

double outline_area(const std::vector<Vec2>& points) {
  double twice = 0.0;
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
    twice += cross2(points[j] - points[0], points[i] - points[0]);
  }
  return 0.5 * std::fabs(twice);
}

}  // namespace

SurfacePoints::SurfacePoints(const LocalShape& shape) {
  const Vec3 size = 2.0 * shape.half;
  const auto add_edges = [this](const std::vector<Vec2>& points, std::size_t count, double height) {
    for (std::size_t i = 0; i < count; ++i) add(height * glm::length(points[(i + 1) % points.size()] - points[i]));
  };
  if (shape.kind == Kind::box && shape.flat) {
    add_edges(box_outline(shape), 4, 1.0);
  } else if (shape.kind == Kind::box) {
    for (const double area : {size.y * size.z, size.x * size.z, size.x * size.y}) add(area), add(area);
  } else if (shape.kind == Kind::outline) {
    add_edges(shape.points, shape.points.size(), shape.flat ? 1.0 : size.z);
    if (shape.flat) return;
    const double cap = outline_area(shape.points);
    add(cap), add(cap);
  } else if (shape.kind == Kind::chain) {
    add_edges(shape.points, shape.points.size() - 1, 1.0);
  } else {
    for (const auto& t : shape.triangles) {
      const Vec3& a = shape.vertices[t[0]];
      add(0.5 * glm::length(glm::cross(shape.vertices[t[1]] - a, shape.vertices[t[2]] - a)));
    }
  }
}

std::size_t SurfacePoints::choose(Random& random) const {
  const double at = random.unit() * sums_.back();
  const auto found = std::upper_bound(sums_.begin(), sums_.end(), at);
  return std::min(static_cast<std::size_t>(found - sums_.begin()), sums_.size() - 1);
}

Vec3 SurfacePoints::at(const LocalShape& shape, Random& random) const {
  if (shape.kind == Kind::ball) return on_ball(shape, random);
  if (sums_.empty()) return shape.middle;
  const std::size_t piece = choose(random);
  switch (shape.kind) {
    case Kind::box:
      return shape.flat ? Vec3(on_edge(box_outline(shape), piece, random), 0.0) : on_box_face(shape, piece, random);
    case Kind::outline: {
      const double low = shape.middle.z - shape.half.z, high = shape.middle.z + shape.half.z;
      const std::size_t edges = shape.points.size();
      if (piece >= edges) return {on_cap(shape, random), piece == edges ? low : high};
      const Vec2 p = on_edge(shape.points, piece, random);
      return {p, shape.flat ? 0.0 : random.uniform(low, high)};
    }
    case Kind::chain: return {on_edge(shape.points, piece, random), 0.0};
    default: return on_triangle(shape, piece, random);
  }
}

}  // namespace gridcull
