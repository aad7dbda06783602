#include "gridcull/sim/cut_polygon.h"

#include <algorithm>
#include <cmath>

#include "gridcull/core/predicates.h"

namespace gridcull {
namespace {

/// M. E. Newell's normal, of any length: right for concave outlines too.
Vec3 normal_of(std::span<const Vec3> vertices, const std::vector<std::uint32_t>& polygon) {
  Vec3 sum(0.0);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = vertices[polygon[i]] - vertices[polygon[0]];
    const Vec3 b = vertices[polygon[(i + 1) % polygon.size()]] - vertices[polygon[0]];
    sum += glm::cross(a, b);
  }
  return sum;
}

/// Drops the axis along which the normal is longest; counter-clockwise polygons stay so.
class Flat {
 public:
  Flat(std::span<const Vec3> vertices, const Vec3& normal) : vertices_(vertices) {
    const Vec3 n = glm::abs(normal);
    const int drop = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
    u_ = (drop + 1) % 3;
    v_ = (drop + 2) % 3;
    if (normal[drop] < 0.0) std::swap(u_, v_);
  }
  Vec2 operator()(std::uint32_t i) const { return {vertices_[i][u_], vertices_[i][v_]}; }

 private:
  std::span<const Vec3> vertices_;
  int u_, v_;
};

/// A corner that turns left and whose triangle holds no other vertex.
bool is_ear(const Flat& at, const std::vector<std::uint32_t>& polygon, std::size_t i) {
  const std::size_t n = polygon.size();
  const Vec2 a = at(polygon[(i + n - 1) % n]), b = at(polygon[i]), c = at(polygon[(i + 1) % n]);
  if (orientation(a, b, c) <= 0) return false;
  return std::none_of(polygon.begin(), polygon.end(), [&](std::uint32_t other) {
    const Vec2 p = at(other);
    if (p == a || p == b || p == c) return false;
    return orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
  });
}

/// No corner turns right, and none is so many that the rest would take long: then a fan will do.
bool is_simple(const Flat& at, const std::vector<std::uint32_t>& polygon) {
  constexpr std::size_t too_many = 2000;
  const std::size_t n = polygon.size();
  if (n > too_many) return true;
  for (std::size_t i = 0; i < n; ++i) {
    if (orientation(at(polygon[i]), at(polygon[(i + 1) % n]), at(polygon[(i + 2) % n])) <= 0) return false;
  }
  // A star turns left everywhere too: the last triangles of the fan would turn right.
  for (std::size_t i = 1; i + 1 < n; ++i) {
    if (orientation(at(polygon[0]), at(polygon[i]), at(polygon[i + 1])) <= 0) return false;
  }
  return true;
}

}  // namespace

void cut_polygon(std::span<const Vec3> vertices, std::vector<std::uint32_t> polygon, std::vector<Triangle>& out) {
  if (polygon.size() < 3) return;
  const Flat at(vertices, normal_of(vertices, polygon));
  if (is_simple(at, polygon)) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) out.push_back({polygon[0], polygon[i], polygon[i + 1]});
    return;
  }
  while (polygon.size() > 3) {
    std::size_t ear = 0;
    while (ear < polygon.size() && !is_ear(at, polygon, ear)) ++ear;
    ear %= polygon.size();  // none: it crosses itself or is flat
    const std::size_t n = polygon.size();
    out.push_back({polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n]});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  out.push_back({polygon[0], polygon[1], polygon[2]});
}

}  // namespace gridcull
