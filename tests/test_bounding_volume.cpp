// Bounding volumes hold what they bound, exactly: every stored vertex is taken as the doubles that it is, and world
// points are held against the exact hull of those.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <doctest/doctest.h>

#include "gridcull/core/bounding_volume.h"
#include "gridcull/core/predicates.h"
#include "gridcull/core/quick_hull.h"
#include "random_solids.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
double in(std::mt19937_64& random, double low, double high) { return low + (high - low) * unit(random); }
Vec3 cube(std::mt19937_64& random) { return {in(random, -1, 1), in(random, -1, 1), in(random, -1, 1)}; }

/// Whether the exact hull of the boundary's vertices holds the point, its border included.
bool hull_of_vertices_holds(const std::vector<Vec3>& vertices, int dimension, const Vec3& p,
                            const ConvexBoundary& hull) {
  if (hull.faces.empty()) return std::find(vertices.begin(), vertices.end(), p) != vertices.end();
  for (const auto& face : hull.faces) {
    const auto at = [&](std::uint32_t i) { return hull.vertices[hull.loops[face.first + i % face.count]]; };
    if (dimension == 2) {
      for (std::uint32_t i = 0; i < face.count; ++i) {
        if (orientation(Vec2(at(i)), Vec2(at(i + 1)), Vec2(p)) < 0) return false;
      }
    } else if (orientation(at(0), at(1), at(2), p) > 0) {
      return false;
    }
  }
  return true;
}

bool ball_holds(const Ball& ball, const Vec3& p) {
  long double square = 0;
  for (int k = 0; k < 3; ++k) square += (static_cast<long double>(p[k]) - ball.centre[k]) * (p[k] - ball.centre[k]);
  return square <= static_cast<long double>(ball.radius) * ball.radius;
}

std::vector<Vec3> truth_of(const Shape& shape, const Pose& pose) {
  std::vector<Vec3> points = world_vertices(shape, pose);
  for (const Vec2& p : world_outline(shape, pose)) points.emplace_back(p, 0.0);
  return points;
}

void check_points(const PlacedBound& placed, int dimension, const std::vector<Vec3>& points) {
  if (placed.round) {
    for (const Vec3& p : points) REQUIRE(ball_holds(placed.ball, p));
    return;
  }
  const ConvexBoundary hull = hull_boundary(placed.boundary.vertices, dimension);
  for (const Vec3& p : points) REQUIRE(hull_of_vertices_holds(placed.boundary.vertices, dimension, p, hull));
}

/// A round shape is all points at its radius from the exact centre: held to within the distance's own rounding.
void check_round(const PlacedBound& placed, int dimension, const Vec3& centre, double radius, std::mt19937_64& random) {
  if (placed.round) {
    REQUIRE(placed.ball.centre == centre);
    REQUIRE(placed.ball.radius >= radius);
    return;
  }
  const ConvexBoundary hull = hull_boundary(placed.boundary.vertices, dimension);
  std::vector<Vec3> directions;
  for (int i = 0; i < 60; ++i) directions.push_back(i < 30 ? glm::round(1.4 * cube(random)) : cube(random));
  // Where the faces come closest.
  for (const auto& face : placed.boundary.faces) directions.push_back(area_normal(placed.boundary, face));
  for (Vec3 u : directions) {
    if (dimension == 2) u.z = 0.0;
    if (!(glm::length(u) > 0.0)) continue;
    // On the sphere or within an ulp of the coordinates, not beyond.
    const Vec3 p = centre + (radius / glm::length(u)) * (1.0 - 4e-16) * u;
    if (glm::length(p - centre) > radius) continue;
    REQUIRE(hull_of_vertices_holds(placed.boundary.vertices, dimension, p, hull));
  }
}

/// As world_axes: the placed volume once more, as points.
void check_bound(const Shape& shape, const Pose& pose, BoundKind kind, std::mt19937_64& random) {
  const int dimension = dimension_of(shape);
  const BoundingVolume bound = bound_of(shape, kind);
  PlacedBound placed, fitted;
  place(bound, pose, placed);
  place(refit(bound, pose), Pose{}, fitted);
  for (const PlacedBound* p : {&placed, &fitted}) {
    if (const auto* disc = std::get_if<Disc>(&shape)) {
      check_round(*p, 2, pose.position, disc->radius, random);
    } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
      check_round(*p, 3, pose.position, sphere->radius, random);
    } else {
      check_points(*p, dimension, truth_of(shape, pose));
    }
  }
  // Volumes placed elsewhere are as large, but for rounding: 2^-40 of where they stand.
  if (!placed.round && !placed.boundary.faces.empty() && glm::length(pose.position) < 1e4 * bound.size) {
    CHECK(area_of(placed.boundary) == doctest::Approx(area_of(bound.boundary)).epsilon(1e-5));
  }
}

Shape flat_or_tiny(std::mt19937_64& random) {
  const double tiny = std::pow(10.0, in(random, -9, 0));
  switch (random() % 8) {
    case 0: return Sphere{tiny};
    case 1: return Cuboid{{10, tiny, 3}};
    case 2: return Cuboid{{tiny, tiny, tiny}};
    case 3: return Faces{{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
    case 4: return Faces{{3.0 * cube(random), 3.0 * cube(random), 3.0 * cube(random)}, {{0, 1, 2}}};
    case 5: return Faces{{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}};
    case 6: return Faces{{{1, 1, 1}, {2, 3, 1}, {1.5, 2, 1}}, {{0, 1, 2}}};
    default: return Prism{{{0, 0}, {tiny, 0}, {tiny, 5}}, 2.0};
  }
}

Shape shape_2d(std::mt19937_64& random) {
  switch (random() % 6) {
    case 0: return Disc{std::pow(10.0, in(random, -6, 2))};
    case 1: return Rectangle{{in(random, 0.1, 9), std::pow(10.0, in(random, -9, 1))}};
    case 2: return Polyline{{{in(random, -1, 1), 2}, {4, in(random, -1, 1)}}};
    case 3: return Polyline{{{0, 0}, {1, 0}, {3, 0}}};
    default: return Polygon{random_outline(random)};
  }
}

Pose random_pose(std::mt19937_64& random, int dimension) {
  Pose pose;
  const int size = static_cast<int>(random() % 6);
  pose.position = (size == 0 ? 0.0 : std::pow(10.0, 2.0 * size - 1.0)) * cube(random);
  if (dimension == 2) pose.position.z = 0.0;
  const int turn = static_cast<int>(random() % 3);
  if (turn == 1) pose.orientation = turn_about_z(in(random, -3, 3));
  if (turn == 2 && dimension == 3) {
    pose.orientation = normalised({in(random, -1, 1), in(random, -1, 1), in(random, -1, 1), in(random, 0.1, 1)});
    // As far from length 1 as a pose may be.
    if (random() % 4 == 0) {
      for (double* part : {&pose.orientation.w, &pose.orientation.x, &pose.orientation.y, &pose.orientation.z}) {
        *part *= random() % 2 == 0 ? 1.0 + 4e-10 : 1.0 - 4e-10;
      }
    }
  }
  return pose;
}

}  // namespace

TEST_CASE("bound kinds have the names of the command line") {
  CHECK(bound_kind_names() == "box, sphere, obb, 14-dop, 18-dop, 26-dop or hull");
  for (const BoundKind kind : all_bound_kinds) CHECK(find_bound_kind(name_of(kind)) == kind);
  CHECK_FALSE(find_bound_kind("16-dop"));
  CHECK_FALSE(find_bound_kind(""));
}

TEST_CASE("volumes and surfaces of known solids") {
  const auto volume = [](const Shape& s, BoundKind k) { return volume_of(bound_of(s, k)); };
  const auto surface = [](const Shape& s, BoundKind k) { return surface_of(bound_of(s, k)); };
  const Shape brick = Cuboid{{2, 3, 4}};
  for (const BoundKind kind : all_bound_kinds) {
    CAPTURE(name_of(kind));
    if (kind == BoundKind::sphere) continue;
    CHECK(volume(brick, kind) == doctest::Approx(24.0).epsilon(1e-6));
    CHECK(surface(brick, kind) == doctest::Approx(52.0).epsilon(1e-6));
  }
  CHECK(volume(brick, BoundKind::sphere) ==
        doctest::Approx(4.1887902 * std::pow(std::sqrt(29.0) / 2, 3)).epsilon(0.05));

  // An octahedron is its own 14-DOP; its 18-DOP is the rhombic dodecahedron's cut, its box a cube.
  const Shape octahedron = Convex{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  CHECK(volume(octahedron, BoundKind::hull) == doctest::Approx(4.0 / 3.0));
  CHECK(volume(octahedron, BoundKind::dop14) == doctest::Approx(4.0 / 3.0).epsilon(1e-6));
  CHECK(volume(octahedron, BoundKind::dop26) == doctest::Approx(4.0 / 3.0).epsilon(1e-6));
  CHECK(volume(octahedron, BoundKind::dop18) == doctest::Approx(2.0).epsilon(1e-6));
  CHECK(volume(octahedron, BoundKind::box) == doctest::Approx(8.0).epsilon(1e-6));
  CHECK(volume(octahedron, BoundKind::sphere) == doctest::Approx(4.18879).epsilon(1e-3));

  // A ball of radius 1.
  const Shape ball = Sphere{1.0};
  CHECK(volume(ball, BoundKind::box) == doctest::Approx(8.0).epsilon(1e-6));
  CHECK(volume(ball, BoundKind::obb) == doctest::Approx(8.0).epsilon(1e-6));
  CHECK(volume(ball, BoundKind::sphere) == doctest::Approx(4.18879).epsilon(1e-6));
  CHECK(volume(ball, BoundKind::hull) == doctest::Approx(4.18879).epsilon(1e-6));
  // A polyhedron about a ball: volume = surface * radius / 3.
  for (const BoundKind kind : {BoundKind::dop14, BoundKind::dop18, BoundKind::dop26}) {
    CHECK(volume(ball, kind) == doctest::Approx(surface(ball, kind) / 3.0).epsilon(1e-6));
  }
  CHECK(bound_of(ball, BoundKind::dop26).boundary.faces.size() == 26);
  CHECK(bound_of(ball, BoundKind::dop26).boundary.vertices.size() == 48);
  CHECK(bound_of(ball, BoundKind::dop18).boundary.faces.size() == 18);
  CHECK(bound_of(ball, BoundKind::dop14).boundary.faces.size() == 14);
  // 2D: an octagon about a disc has area 8 tan(22.5 degrees).
  CHECK(volume(Disc{1.0}, BoundKind::dop18) == doctest::Approx(3.3137085).epsilon(1e-6));
  CHECK(surface(Disc{1.0}, BoundKind::box) == doctest::Approx(8.0).epsilon(1e-6));
  CHECK(volume(Polygon{{{0, 0}, {3, 3}, {2, 4}, {-1, 1}}}, BoundKind::obb) == doctest::Approx(6.0).epsilon(1e-6));
  CHECK(volume(Polygon{{{0, 0}, {3, 3}, {2, 4}, {-1, 1}}}, BoundKind::box) == doctest::Approx(16.0).epsilon(1e-6));
}

TEST_CASE("an oriented box finds the turn of a brick") {
  const Rotation r = rotation_of(normalised({0.9, 0.3, -0.2, 0.4}));
  Convex convex;
  for (const Vec3& p : world_vertices(Cuboid{{1, 2, 5}}, Pose{})) convex.vertices.push_back(r * p);
  CHECK(volume_of(bound_of(Shape(convex), BoundKind::obb)) == doctest::Approx(10.0).epsilon(1e-6));
  CHECK(volume_of(bound_of(Shape(convex), BoundKind::box)) > 15.0);
}

TEST_CASE("more planes never hold more") {
  std::mt19937_64 random(3);
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    const Shape shape = random_placement(seed).shape;
    const auto volume = [&](BoundKind kind) { return volume_of(bound_of(shape, kind)); };
    const double box = volume(BoundKind::box), d14 = volume(BoundKind::dop14), d18 = volume(BoundKind::dop18);
    const double d26 = volume(BoundKind::dop26), hull = volume(BoundKind::hull), more = 1.0 + 1e-5;
    CHECK(hull <= d26 * more);
    CHECK(d26 <= d14 * more);
    CHECK(d26 <= d18 * more);
    CHECK(d14 <= box * more);
    CHECK(d18 <= box * more);
    CHECK(volume(BoundKind::obb) <= box * 1.5);  // chosen by surface
    CHECK(hull <= volume(BoundKind::sphere));
  }
}

namespace {

/// A closed surface that turns outward everywhere; every vertex in every face's plane or below it.
void check_boundary(const ConvexBoundary& b, double size) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& face : b.faces) {
    REQUIRE(face.count >= 3);
    CHECK(glm::length(face.normal) == doctest::Approx(1.0));
    const Vec3 newell = area_normal(b, face);
    if (glm::length(newell) > 1e-12 * size * size) CHECK(glm::dot(newell, face.normal) > 0.9 * glm::length(newell));
    const double height = glm::dot(face.normal, b.vertices[b.loops[face.first]]);
    for (const Vec3& v : b.vertices) CHECK(glm::dot(face.normal, v) <= height + 1e-12 * size);
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t a = b.loops[face.first + i], c = b.loops[face.first + (i + 1) % face.count];
      CHECK(glm::dot(face.normal, b.vertices[a]) >= height - 1e-12 * size);
      CHECK(++edges[{a, c}] == 1);
    }
  }
  for (const auto& [edge, count] : edges) CHECK(edges.contains({edge.second, edge.first}));
  CHECK(b.vertices.size() + b.faces.size() == edges.size() / 2 + 2);
}

}  // namespace

TEST_CASE("boundaries of k-DOPs are closed, whatever planes meet in one vertex") {
  std::mt19937_64 random(5);
  std::size_t most = 0;
  for (int i = 0; i < 1500; ++i) {
    CAPTURE(i);
    std::vector<Vec3> points;
    // Lattice points: planes through one vertex and edge in all ways; anything; what is flat along some direction.
    const bool lattice = i % 3 != 0;
    for (std::uint64_t k = 0, n = 1 + random() % 12; k < n; ++k) {
      Vec3 p = 4.0 * cube(random);
      if (lattice) p = glm::round(p);
      if (i % 5 == 0) p.z = 0.0;
      if (i % 7 == 0) p.y = p.x;
      points.push_back(p);
    }
    for (const BoundKind kind : {BoundKind::box, BoundKind::dop14, BoundKind::dop18, BoundKind::dop26}) {
      CAPTURE(name_of(kind));
      const BoundingVolume bound = bound_of(points, kind);
      check_boundary(bound.boundary, bound.size + 1.0);
      // Each plane that the volume has touches a point: it is as tight as its directions allow.
      for (const auto& face : bound.boundary.faces) {
        double support = -1e300;
        for (const Vec3& p : points) support = std::max(support, glm::dot(face.normal, p));
        CHECK(glm::dot(face.normal, bound.boundary.vertices[bound.boundary.loops[face.first]]) - support <
              3.0 * bound.grown + 1e-12 * bound.size);
      }
      most = std::max(most, bound.boundary.vertices.size());
    }
  }
  CHECK(most <= 48);
}

TEST_CASE("placed and re-fitted volumes hold the world points, exactly, in 3D") {
  std::mt19937_64 random(11);
  for (std::uint64_t seed = 0; seed < 700; ++seed) {
    CAPTURE(seed);
    const Shape shape = seed % 3 == 0 ? flat_or_tiny(random) : random_placement(seed).shape;
    const Pose pose = random_pose(random, 3);
    for (const BoundKind kind : all_bound_kinds) {
      CAPTURE(name_of(kind));
      check_bound(shape, pose, kind, random);
    }
  }
}

TEST_CASE("placed and re-fitted volumes hold the world points, exactly, in 2D") {
  std::mt19937_64 random(12);
  for (int i = 0; i < 1500; ++i) {
    CAPTURE(i);
    const Shape shape = shape_2d(random);
    const Pose pose = random_pose(random, 2);
    for (const BoundKind kind : all_bound_kinds) {
      CAPTURE(name_of(kind));
      check_bound(shape, pose, kind, random);
    }
  }
}

TEST_CASE("points far from the origin, close together") {
  std::mt19937_64 random(13);
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const Vec3 base = std::pow(10.0, in(random, 3, 9)) * cube(random);
    std::vector<Vec3> points;
    for (int k = 0; k < 12; ++k) points.push_back(base + std::pow(10.0, in(random, -9, 0)) * cube(random));
    for (const BoundKind kind : all_bound_kinds) {
      CAPTURE(name_of(kind));
      PlacedBound placed;
      place(bound_of(points, kind), Pose{}, placed);
      check_points(placed, 3, points);
    }
  }
}

TEST_CASE("a volume re-fitted under a turn is looser than one made anew, and not by more than its corners") {
  std::mt19937_64 random(14);
  Convex many;
  for (int i = 0; i < 400; ++i) many.vertices.push_back(glm::normalize(cube(random) + Vec3(1e-9)));
  const Shape ball(many);
  const Pose pose{{5, 6, 7}, normalised({0.8, 0.1, 0.5, 0.3})};
  for (const BoundKind kind : {BoundKind::box, BoundKind::dop14, BoundKind::dop18, BoundKind::dop26}) {
    CAPTURE(name_of(kind));
    const double anew = volume_of(bound_of(world_vertices(ball, pose), kind));
    const double fitted = volume_of(refit(bound_of(ball, kind), pose));
    CHECK(fitted >= anew * (1.0 - 1e-9));
    CHECK(fitted < anew * (kind == BoundKind::box ? 6.0 : kind == BoundKind::dop26 ? 1.6 : 3.0));
  }
}
