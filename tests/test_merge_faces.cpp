// Merged faces of static objects: as large as they should be, and nowhere beyond their owners.
#include <algorithm>
#include <random>

#include <doctest/doctest.h>

#include "gridcull/grid/convex_union.h"
#include "gridcull/grid/merge_faces.h"
#include "gridcull/grid/piece_silhouette.h"
#include "ray_truth.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

double area_of(const std::vector<Vec3>& p) {
  Vec3 sum(0.0);
  for (std::size_t k = 1; k + 1 < p.size(); ++k) sum += glm::cross(p[k] - p[0], p[k + 1] - p[0]);
  return 0.5 * glm::length(sum);
}

FlatPolygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 2}, {x1, y0, 2}, {x1, y1, 2}, {x0, y1, 2}};
}

}  // namespace

TEST_CASE("unions of convex polygons: only where they are convex") {
  const FlatPolygon a = rectangle(0, 0, 2, 1);
  CHECK(convex_union(a, rectangle(2, 0, 3, 1)));
  CHECK(convex_union(a, rectangle(1, 0, 3, 1)));
  CHECK(convex_union(a, rectangle(0, 1, 2, 5)));
  CHECK_FALSE(convex_union(a, rectangle(2.5, 0, 3, 1)));                           // a gap
  CHECK_FALSE(convex_union(a, rectangle(2, 0, 3, 1.5)));                           // a step
  CHECK_FALSE(convex_union(a, rectangle(2, 1, 3, 2)));                             // a corner only
  CHECK_FALSE(convex_union(a, rectangle(1, -1, 1.5, 2)));                          // a cross
  CHECK_FALSE(convex_union(a, {{2, 0, 2}, {3, 0, 2.5}, {3, 1, 2.5}, {2, 1, 2}}));  // a fold
  CHECK(convex_union(rectangle(0, 0, 1, 1), {{1, 0, 2}, {2, 0.5, 2}, {1, 1, 2}})->size() == 5);
  const FlatPolygon triangle{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}};
  CHECK(convex_union(triangle, {{1, 1, 2}, {1, 0, 2}, {0, 1, 2}})->size() == 4);
}

TEST_CASE("merged faces: a wall of 400 abutting boxes is one rectangle on each side") {
  const Shape tile = Cuboid{{1, 0.25, 0.5}};
  std::vector<PlacedSource> sources;
  for (int j = 0; j < 20; ++j) {
    for (int i = 0; i < 20; ++i) {
      sources.push_back({static_cast<ObjectId>(sources.size()), &tile, {{i, 0.0, 0.5 * j}, {}}});
    }
  }
  std::shuffle(sources.begin(), sources.end(), std::mt19937_64(1));
  const auto merged = merge_static_faces(sources);
  REQUIRE(merged.size() >= 2);
  for (int k = 0; k < 2; ++k) {
    CHECK(merged[static_cast<std::size_t>(k)].owners.size() == 400);
    CHECK(area_of(merged[static_cast<std::size_t>(k)].piece.vertices) == doctest::Approx(200).epsilon(1e-3));
  }
}

TEST_CASE("merged faces: fronts of houses of one height merge, across boxes and turned prisms") {
  const Shape box = Cuboid{{4, 6, 8}};
  const Shape house = Prism{{{0, 0}, {5, 0}, {5, 6}, {0, 6}}, 8};
  const std::vector<PlacedSource> sources{{7, &box, {{2, 3, 4}, {}}}, {3, &house, {{4, 0, 0}, {}}}};
  const auto merged = merge_static_faces(sources);
  REQUIRE(merged.size() == 4);  // front, back, roof, floor
  CHECK(merged[0].owners == std::vector<ObjectId>{3, 7});
  CHECK(area_of(merged[0].piece.vertices) == doctest::Approx(72).epsilon(1e-3));
}

TEST_CASE("merged faces: a wall that another wall of the same outline runs along is left out") {
  const Shape odd = Prism{{{0, 0}, {6, 0}, {6, 4}, {4, 4}, {4, 0}, {2, 0}, {2, 4}, {0, 4}}, 3};
  const Shape box = Cuboid{{2, 2, 3}};
  const std::vector<PlacedSource> sources{{0, &odd, {}}, {1, &box, {{7, 1, 1.5}, {}}}};
  for (const MergedFace& face : merge_static_faces(sources)) {
    for (const Vec3& p : face.piece.vertices) CHECK((p.y > 0.1 || p.x > 5.9));
  }
}

TEST_CASE("merged faces: what crosses one meets an owner there") {
  std::mt19937_64 random(9);
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  int faces = 0, rays = 0;
  for (int round = 0; round < 400; ++round) {
    CAPTURE(round);
    // Boxes and prisms on a lattice, all turned alike by quarter turns or not at all.
    std::vector<Shape> shapes;
    std::vector<Pose> poses;
    for (int k = 0; k < 12; ++k) {
      const double a = 1.0 + static_cast<double>(random() % 2), b = 1.0 + static_cast<double>(random() % 2);
      if (random() % 3 == 0) {
        shapes.emplace_back(Prism{{{0, 0}, {2 * a, 0}, {2 * a, b}, {a, b}, {a, 2 * b}, {0, 2 * b}}, 2});
        poses.push_back({Vec3(random() % 5, random() % 5, random() % 2), {}});
      } else {
        shapes.emplace_back(Cuboid{{2 * a, 2 * b, 2}});
        poses.push_back({Vec3(random() % 5, random() % 5, random() % 2), {}});
      }
    }
    std::vector<PlacedSource> sources;
    for (std::size_t k = 0; k < shapes.size(); ++k) sources.push_back({static_cast<ObjectId>(k), &shapes[k], poses[k]});
    const Vec3 eye(10 * unit() - 3, 10 * unit() - 3, 6 * unit() - 2);
    for (const MergedFace& face : merge_static_faces(sources)) {
      ++faces;
      Outline outline;
      if (!silhouette({face.piece, sight_frame(Pose{}, Rotation{}, eye)}, outline)) continue;
      for (int k = 0; k < 6; ++k) {
        Long3 d{0, 0, 0};
        for (int i = 0; i < outline.count; ++i) d = d + unit() * longer(outline.rays[static_cast<std::size_t>(i)]);
        bool met = false;
        for (const ObjectId owner : face.owners) {
          const RayTruth truth(shapes[owner], poses[owner], eye);
          const auto at = truth.entrance(d);
          met = met || (at && *at <= static_cast<long double>(outline.farthest));
        }
        ++rays;
        REQUIRE(met);
      }
    }
  }
  MESSAGE(faces << " faces, " << rays << " rays");
  CHECK(rays > 1000);
}
