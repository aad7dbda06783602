// Convex parts of outlines and joined triangles: inside the shape, and nearly all of it.
#include <algorithm>
#include <cmath>
#include <random>

#include <doctest/doctest.h>

#include "gridcull/grid/convex_cut.h"
#include "gridcull/grid/convex_parts.h"
#include "gridcull/grid/flat_polygons.h"
#include "gridcull/grid/occluder_pieces.h"
#include "random_solids.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// Even-odd, by crossings to the right, in long doubles.
bool in_outline(const std::vector<Vec2>& v, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++) {
    if ((v[i].y > p.y) == (v[j].y > p.y)) continue;
    const long double t = (static_cast<long double>(p.y) - v[i].y) / (static_cast<long double>(v[j].y) - v[i].y);
    if (v[i].x + t * (static_cast<long double>(v[j].x) - v[i].x) > p.x) inside = !inside;
  }
  return inside;
}

double distance_to(const std::vector<Vec2>& v, const Vec2& p) {
  double least = 1e300;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++) {
    const Vec2 e = v[i] - v[j];
    const double t = glm::dot(e, e) > 0.0 ? std::clamp(glm::dot(p - v[j], e) / glm::dot(e, e), 0.0, 1.0) : 0.0;
    least = std::min(least, glm::distance(p, v[j] + t * e));
  }
  return least;
}

bool in_part(const ConvexPart& part, const Vec2& p) {
  for (std::size_t i = 0, j = part.size() - 1; i < part.size(); j = i++) {
    if (!(cross2(part[i] - part[j], p - part[j]) >= 0.0)) return false;
  }
  return true;
}

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace

TEST_CASE("parts: an L gives its two overlapping rectangles") {
  const auto parts = convex_parts({{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}});
  REQUIRE(parts.size() == 2);
  CHECK(area_of(parts[0]) == doctest::Approx(12));
  CHECK(area_of(parts[1]) == doctest::Approx(10));
}

TEST_CASE("parts: a convex outline is one part, whatever its turn, repeats and straight corners") {
  CHECK(convex_parts({{0, 0}, {0, 5}, {0, 5}, {3, 5}, {6, 5}, {6, 0}, {0, 0}}).size() == 1);
  std::vector<Vec2> ring;
  for (int i = 0; i < 1000; ++i) ring.emplace_back(10 * std::cos(0.0062831853 * i), 10 * std::sin(0.0062831853 * i));
  const auto parts = convex_parts(ring);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].size() <= 32);
  CHECK(area_of(parts[0]) > 308);
}

TEST_CASE("parts: outlines without area have none") {
  CHECK(convex_parts({{0, 0}, {4, 0}, {2, 0}}).empty());
  CHECK(convex_parts({{0, 0}, {4, 4}, {0, 0}, {2, 2}}).empty());
}

TEST_CASE("parts: inside the outline, and nearly all of it") {
  std::mt19937_64 random(3);
  long inside = 0, covered = 0;
  std::size_t most = 0;
  for (int round = 0; round < 3000; ++round) {
    CAPTURE(round);
    std::vector<Vec2> outline = random_outline(random);
    const double turn = round % 2 == 0 ? 0.0 : unit(random);
    const Vec2 off = round % 3 == 0 ? Vec2(0) : 1e4 * Vec2(unit(random), unit(random));
    for (Vec2& p : outline) {
      p = off + Vec2(std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y);
    }
    const auto parts = convex_parts(outline);
    most = std::max(most, parts.size());
    for (int k = 0; k < 60; ++k) {
      const Vec2 p = off + 14.0 * Vec2(unit(random) - 0.5, unit(random) - 0.3);
      const bool in = in_outline(outline, p);
      bool found = false;
      for (const ConvexPart& part : parts) found = found || in_part(part, p);
      if (found) REQUIRE((in || distance_to(outline, p) < 1e-9));
      inside += in, covered += in && found;
    }
    // Corners of parts, where a part that sticks out does so first.
    for (const ConvexPart& part : parts) {
      REQUIRE(part.size() <= 32);
      for (const Vec2& p : part) REQUIRE((in_outline(outline, p) || distance_to(outline, p) < 1e-9));
    }
  }
  MESSAGE("covered " << static_cast<double>(covered) / static_cast<double>(inside) << " of the inside, at most " << most
                     << " parts");
  CHECK(covered > 0.99 * inside);
}

TEST_CASE("joined triangles: a wall of 400 tiles is one rectangle") {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t j = 0; j <= 20; ++j) {
    for (std::uint32_t i = 0; i <= 20; ++i) vertices.emplace_back(0.5 * i, 0.25 * i, j);
  }
  for (std::uint32_t j = 0; j < 20; ++j) {
    for (std::uint32_t i = 0; i < 20; ++i) {
      const std::uint32_t a = 21 * j + i;
      triangles.push_back({a, a + 1, a + 22});
      triangles.push_back({a + 21, a, a + 22});  // the other turn
    }
  }
  const auto polygons = join_triangles(vertices, triangles);
  CHECK(polygons.size() == 1);
  CHECK(make_occluder_pieces(Faces{vertices, triangles}).pieces.size() == 1);
}

TEST_CASE("joined triangles: only within one plane, only to convex polygons, the area kept") {
  std::mt19937_64 random(4);
  for (int round = 0; round < 300; ++round) {
    CAPTURE(round);
    // A height field of steps: many coplanar neighbours, some not.
    std::vector<Vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (int j = 0; j < 5; ++j) {
      for (int i = 0; i < 5; ++i) vertices.emplace_back(i, j, random() % 4 == 0 ? 1 : 0);
    }
    double area = 0.0;
    const auto area_vector = [](const std::vector<Vec3>& p) {
      Vec3 sum(0.0);
      for (std::size_t k = 1; k + 1 < p.size(); ++k) sum += glm::cross(p[k] - p[0], p[k + 1] - p[0]);
      return glm::length(sum);
    };
    for (std::uint32_t j = 0; j < 4; ++j) {
      for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t a = 5 * j + i;
        if (random() % 5 == 0) continue;
        triangles.push_back({a, a + 1, a + 6});
        triangles.push_back({a, a + 6, a + 5});
      }
    }
    for (const auto& t : triangles) area += area_vector({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
    double joined = 0.0;
    for (const FlatPolygon& polygon : join_triangles(vertices, triangles)) joined += area_vector(polygon);
    CHECK(joined == doctest::Approx(area));
  }
}
