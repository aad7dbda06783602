#include <map>
#include <random>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/hull.h"
#include "gridcull/core/pose.h"
#include "gridcull/core/predicates.h"

using namespace gridcull;

namespace {

std::vector<Vec3> box_corners(const Vec3& size) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(size * Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  return points;
}

bool inside(const Hull& hull, const Vec3& p, double margin) {
  for (const HalfSpace& s : hull.sides) {
    if (!(glm::dot(s.normal, p) >= s.offset + margin)) return false;
  }
  return true;
}

/// Every edge is walked once each way, and the surface is a sphere.
void check_closed(const Hull& hull) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  std::map<std::uint32_t, int> vertices;
  for (const auto& t : hull.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}], ++vertices[t[k]];
  }
  for (const auto& [edge, count] : edges) {
    CHECK(count == 1);
    CHECK(edges.contains({edge.second, edge.first}));
  }
  CHECK(vertices.size() + hull.triangles.size() == edges.size() / 2 + 2);
}

/// Least over many directions of (support of the points - support of {p}): >= 0 for a point of the hull.
double support_gap(const std::vector<Vec3>& points, const Vec3& p, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  double least = 1e300;
  for (int k = 0; k < 300; ++k) {
    const Vec3 u = glm::normalize(Vec3(normal(random), normal(random), normal(random)));
    double support = -1e300;
    for (const Vec3& q : points) support = std::max(support, glm::dot(u, q));
    least = std::min(least, support - glm::dot(u, p));
  }
  return least;
}

}  // namespace

TEST_CASE("hull: a cube with points on faces, edges and repeated corners has six sides") {
  std::vector<Vec3> points = box_corners({2, 3, 4});
  const std::vector<Vec3> more{{1, 0, 0}, {1, 1, 0}, {0, 1, 1}, {2, 1, 1}, {1, 3, 1}, {1, 1, 4}, {2, 3, 4}, {1, 1, 1}};
  points.insert(points.begin(), more.begin(), more.end());
  points.insert(points.end(), more.begin(), more.end());
  const Hull hull = convex_hull(points);
  CHECK(hull.sides.size() == 6);
  CHECK(hull.margin < 1e-12);
  check_closed(hull);
  CHECK(hull_holds(points, {1, 1, 1}));
  CHECK_FALSE(hull_holds(points, {0, 1, 1}));
  CHECK_FALSE(hull_holds(points, {2, 3, 4}));
  CHECK_FALSE(hull_holds(points, {2.5, 1, 1}));
}

TEST_CASE("hull: a turned box keeps six sides although its corners are rounded") {
  const Rotation turn = rotation_of(normalised({0.9, 0.1, 0.3, -0.2}));
  std::vector<Vec3> points = box_corners({5, 1, 2});
  for (double t : {0.25, 0.5, 0.75}) points.emplace_back(5 * t, 0, 0), points.emplace_back(5 * t, 1, 2 * t);
  for (Vec3& p : points) p = Vec3(1000, 2000, 30) + turn * p;
  const Hull hull = convex_hull(points);
  CHECK(hull.sides.size() == 6);
  CHECK(hull.margin < 1e-8);
  check_closed(hull);
}

TEST_CASE("hull: flat and small sets are refused") {
  CHECK_THROWS_AS(convex_hull({}), Error);
  CHECK_THROWS_AS(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), Error);
  CHECK_THROWS_AS(convex_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 3, 0}}), Error);
  CHECK_THROWS_AS(convex_hull({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), Error);
  CHECK_THROWS_AS(convex_hull({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}), Error);
  CHECK_FALSE(hull_holds({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1e-12}}, {0.5, 0.5, 5e-13}));
}

TEST_CASE("hull: outer holds every point, inner lies in the hull") {
  const std::uint64_t seed = 20020417;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 120; ++round) {
    CAPTURE(seed);
    CAPTURE(round);
    const int kind = round % 4;  // ball, lattice points (many coplanar), thin plate, needle
    const int count = 4 + static_cast<int>(random() % 60);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      Vec3 p(unit(random), unit(random), unit(random));
      if (kind == 1) p = Vec3(std::round(2 * p.x), std::round(2 * p.y), std::round(2 * p.z));
      if (kind == 2) p.z *= 1e-6;
      if (kind == 3) p.y *= 1e-4, p.z *= 1e-4;
      points.push_back(p);
    }
    points.emplace_back(0.5, 0.5, 0.5), points.emplace_back(-0.5, -0.5, 0.25);
    points.emplace_back(0.5, -0.5, 0.25), points.emplace_back(0, 0, -1);
    const Hull hull = convex_hull(points);
    check_closed(hull);
    for (const Vec3& p : points) CHECK(inside(hull, p, 0.0));
    for (int i = 0; i < 20; ++i) {
      // Near the surface: a vertex pulled a little towards the middle or pushed a little out.
      const Vec3 base = points[random() % points.size()];
      const Vec3 p = base * (1.0 + 1e-3 * unit(random)) + 1e-6 * Vec3(unit(random), unit(random), unit(random));
      if (inside(hull, p, hull.margin)) {
        CHECK(support_gap(points, p, random) > -1e-15);
        CHECK(hull_holds(points, p));
      }
      if (hull_holds(points, p)) CHECK(inside(hull, p, 0.0));
    }
  }
}

TEST_CASE("hull: a thousand points") {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points;
  for (int i = 0; i < 1000; ++i) points.push_back(glm::normalize(Vec3(normal(random), normal(random), normal(random))));
  const Hull hull = convex_hull(points);
  CHECK(hull.triangles.size() == 1996);  // all on the sphere: 2 n - 4
  check_closed(hull);
}

TEST_CASE("predicates: signs are exact where rounding decides") {
  // The classic: points about the line y = x at the last bit.
  const double ulp = 0x1p-53;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec2 p(0.5 + i * ulp, 0.5 + j * ulp);
      CHECK(orientation(Vec2(12, 12), Vec2(24, 24), p) == (j > i) - (j < i));
      CHECK(orientation(p, Vec2(12, 12), Vec2(24, 24)) == (j > i) - (j < i));
    }
  }
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      const Vec3 p(0.5 + i * ulp, 0.5 + j * ulp, 0.25);
      CHECK(orientation(Vec3(12, 12, 0), Vec3(24, 24, 0), Vec3(12, 12, 7), p) == (i > j) - (i < j));
    }
  }
  CHECK(orientation(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)) == 1);
}
