// The exact hull of large sets against the incremental one, and against its own promise.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <doctest/doctest.h>

#include "gridcull/core/hull.h"
#include "gridcull/core/predicates.h"
#include "gridcull/core/quick_hull.h"

using namespace gridcull;

namespace {

double in(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}
Vec3 cube(std::mt19937_64& random) { return {in(random, -1, 1), in(random, -1, 1), in(random, -1, 1)}; }

void check_holds(const ConvexBoundary& hull, const std::vector<Vec3>& points) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& face : hull.faces) {
    const auto at = [&](std::uint32_t i) { return hull.vertices[hull.loops[face.first + i]]; };
    for (const Vec3& p : points) REQUIRE(orientation(at(0), at(1), at(2), p) <= 0);
    for (std::uint32_t i = 0; i < face.count; ++i) {
      CHECK(++edges[{hull.loops[face.first + i], hull.loops[face.first + (i + 1) % face.count]}] == 1);
    }
  }
  for (const auto& [edge, count] : edges) CHECK(edges.contains({edge.second, edge.first}));
  CHECK(hull.vertices.size() + hull.faces.size() == edges.size() / 2 + 2);
}

}  // namespace

TEST_CASE("quick hull: closed, holds every point, and is as large as the incremental hull") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    std::vector<Vec3> points;
    for (std::uint64_t k = 0, n = 5 + random() % 60; k < n; ++k) {
      Vec3 p = 5.0 * cube(random);
      if (i % 3 == 0) p = glm::round(p);
      if (i % 3 == 1) p = glm::normalize(p);
      if (i % 5 == 0) p.z *= 1e-7;
      points.push_back(p);
    }
    points.insert(points.end(), {{5, 0, 0}, {0, 5, 0}, {0, 0, 0.1}, {-5, -5, -0.1}});
    const ConvexBoundary hull = hull_boundary(points, 3);
    check_holds(hull, points);
    const Hull other = convex_hull(points);
    double volume = 0.0;
    for (const auto& t : other.triangles) {
      volume += glm::dot(glm::cross(points[t[0]], points[t[1]]), points[t[2]]) / 6.0;
    }
    CHECK(volume_of(hull) == doctest::Approx(volume).epsilon(1e-9));
  }
}

TEST_CASE("quick hull: many points, most of them inside") {
  std::mt19937_64 random(2);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i) points.push_back(cube(random));
  const ConvexBoundary hull = hull_boundary(points, 3);
  CHECK(hull.vertices.size() < 400);
  CHECK(volume_of(hull) > 7.8);
  CHECK(volume_of(hull) < 8.0);
  std::vector<Vec3> some(points.begin(), points.begin() + 2000);
  check_holds(hull, some);
}

TEST_CASE("quick hull: what is flat, straight or one point") {
  const ConvexBoundary one = hull_boundary(std::vector<Vec3>{{1, 2, 3}, {1, 2, 3}}, 3);
  CHECK(one.vertices.size() == 1);
  CHECK(one.faces.empty());
  const ConvexBoundary line = hull_boundary(std::vector<Vec3>{{1, 1, 1}, {3, 3, 3}, {2, 2, 2}}, 3);
  CHECK(line.vertices == std::vector<Vec3>{{1, 1, 1}, {3, 3, 3}});
  std::vector<Vec3> square;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) square.emplace_back(x, y, x + y);  // a leaning plane
  }
  const ConvexBoundary flat = hull_boundary(square, 3);
  REQUIRE(flat.faces.size() == 2);
  CHECK(flat.vertices.size() == 4);
  CHECK(glm::dot(flat.faces[0].normal, area_normal(flat, flat.faces[0])) > 0.0);
  CHECK(glm::dot(flat.faces[1].normal, area_normal(flat, flat.faces[1])) > 0.0);
  CHECK(volume_of(flat) == doctest::Approx(0.0));
  const ConvexBoundary polygon = hull_boundary(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0, 2, 0}}, 2);
  CHECK(polygon.vertices.size() == 3);
  CHECK(polygon.faces.size() == 1);
}
