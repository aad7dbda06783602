// Closed meshes: holes, and what is inside (core/mesh.h), against winding numbers (cover_truth.h).
#include <doctest/doctest.h>

#include "cover_truth.h"
#include "gridcull/core/error.h"
#include "gridcull/core/mesh.h"
#include "gridcull/core/view_volume.h"
#include "random_meshes.h"

using namespace gridcull;

namespace {

const Faces tetrahedron{
    {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, true};

MeshSide side(const Faces& mesh, const Vec3& point) { return side_of_mesh(mesh.vertices, mesh.triangles, point); }

}  // namespace

TEST_CASE("a mesh closes when every edge is shared by an even number of triangles") {
  CHECK(find_holes(tetrahedron).open_edges == 0);
  Faces open = tetrahedron;
  open.triangles.pop_back();
  CHECK(find_holes(open).open_edges == 3);
  CHECK_THROWS_WITH_AS(validate(open), "mesh: expected no hole, found 3 open edges", Error);
  open.closed = false;
  CHECK_NOTHROW(validate(open));
  Faces with_sliver = tetrahedron;
  with_sliver.triangles.push_back({1, 1, 2});
  CHECK(find_holes(with_sliver).open_edges == 0);
}

TEST_CASE("inside is exact, on the surface and beside corners") {
  CHECK(side(tetrahedron, {1, 1, 1}) == MeshSide::inside);
  CHECK(side(tetrahedron, {2, 2, 2}) == MeshSide::outside);
  CHECK(side(tetrahedron, {0, 1, 1}) == MeshSide::on_surface);
  CHECK(side(tetrahedron, {0x1p-50, 1, 1}) == MeshSide::inside);
  CHECK(side(tetrahedron, {-0x1p-50, 1, 1}) == MeshSide::outside);
  // Rays along +x through corners and along edges.
  CHECK(side(tetrahedron, {-1, 0, 0}) == MeshSide::outside);
  CHECK(side(tetrahedron, {-1, 4, 0}) == MeshSide::outside);
  CHECK(side(tetrahedron, {-1, 0, 4}) == MeshSide::outside);
  CHECK(side(tetrahedron, {-1, 0, 2}) == MeshSide::outside);
  CHECK(side(tetrahedron, {-1, 2, 2}) == MeshSide::outside);
}

TEST_CASE("the turn of triangles does not matter, and the pose does") {
  Faces turned = tetrahedron;
  std::swap(turned.triangles[1][0], turned.triangles[1][1]);
  CHECK(side(turned, {1, 1, 1}) == MeshSide::inside);
  CHECK(interior_holds(tetrahedron, Pose{{10, 0, 0}, turn_about_z(3.0)}, {8.5, -0.7, 1}));
  CHECK_FALSE(interior_holds(tetrahedron, Pose{{10, 0, 0}, turn_about_z(3.0)}, {11, 1, 1}));
  Faces thin = tetrahedron;
  thin.closed = false;
  CHECK_FALSE(interior_holds(thin, Pose{}, {1, 1, 1}));
  CHECK(is_thin(thin));
  CHECK_FALSE(is_thin(tetrahedron));
  CHECK(name_of(tetrahedron) == "mesh");
}

TEST_CASE("random meshes close, and their inside is where they wind an odd number of times") {
  int inside = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    INFO("seed ", seed);
    std::mt19937_64 random(seed);
    const Faces mesh = test::random_mesh(random, 4.0);
    REQUIRE(find_holes(mesh).open_edges == 0);
    std::vector<std::vector<Vec3>> triangles;
    for (const auto& t : mesh.triangles) {
      triangles.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
    }
    for (int i = 0; i < 60; ++i) {
      const auto coordinate = [&] {
        const double at = 10.0 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
        return random() % 2 == 0 ? at : std::round(at);
      };
      const Vec3 point(coordinate(), coordinate(), coordinate());
      const MeshSide found = side(mesh, point);
      const cover_truth::Box about{point - Vec3(1e-9), point + Vec3(1e-9)};
      bool beside = false;
      for (const auto& t : triangles) beside = beside || cover_truth::meets(t, cover_truth::sides_of(about));
      if (beside) continue;
      CHECK(found == (cover_truth::winds(triangles, point) ? MeshSide::inside : MeshSide::outside));
      inside += found == MeshSide::inside ? 1 : 0;
    }
  }
  CHECK(inside > 1000);
}
