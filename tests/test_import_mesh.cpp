// `gridcull import mesh`: parts, groups, the whole; place and holes.
#include <doctest/doctest.h>

#include "gridcull/core/view_volume.h"
#include "gridcull/sim/import_mesh.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

const auto needs_assimp = doctest::skip(!reads_meshes());

// Two tetrahedra in one group, the second 100 units along x; a lone triangle in another.
const std::string model = R"(o town
v 0 0 0
v 4 0 0
v 0 4 0
v 0 0 4
v 100 0 0
v 104 0 0
v 100 4 0
v 100 0 4
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
f 5 7 6
f 5 6 8
f 5 8 7
f 6 7 8
o sign
v 50 0 0
v 50 1 0
v 50 0 1
f 9 10 11
)";

Imported import(const TemporaryFolder& folder, MeshImportOptions options) {
  options.file = folder.with("town.obj", model);
  return import_mesh(options);
}

}  // namespace

TEST_CASE("what hangs together is an object, closed or with a note" * needs_assimp) {
  const TemporaryFolder folder;
  const Imported got = import(folder, {});
  REQUIRE(got.scene.objects.size() == 3);
  CHECK(got.scene.dimension == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Object& object = got.scene.objects[i].object;
    CHECK(object.id == i);
    CHECK(object.is_static);
    CHECK(std::get<Faces>(object.shape).closed == (i < 2));
    CHECK(reach_of(object.shape) < 8.0);
  }
  CHECK(interior_holds(got.scene.objects[1].object.shape, got.scene.objects[1].object.pose, {101, 1, 1}));
  REQUIRE(got.notes.size() == 1);
  CHECK(got.notes[0].starts_with("1 of 3 have holes and hide as faces, without an interior; most: "));
  CHECK(holds(got.notes[0], "with 3 open edges"));
  CHECK(got.scene.bounds->min == Vec3(0, 0, 0));
  CHECK(got.scene.bounds->max == Vec3(104, 4, 4));
}

TEST_CASE("groups and the whole" * needs_assimp) {
  const TemporaryFolder folder;
  const Imported groups = import(folder, {.split = MeshImportOptions::Split::groups});
  REQUIRE(groups.scene.objects.size() == 2);
  CHECK(groups.scene.objects[0].name == "town");
  CHECK(std::get<Faces>(groups.scene.objects[0].object.shape).closed);
  const Imported whole = import(folder, {.split = MeshImportOptions::Split::whole});
  REQUIRE(whole.scene.objects.size() == 1);
  CHECK(std::get<Faces>(whole.scene.objects[0].object.shape).triangles.size() == 9);
}

TEST_CASE("scaled, turned and moved" * needs_assimp) {
  const TemporaryFolder folder;
  // z down to z up, in centimetres, 5 m further north.
  const Imported got = import(folder, {.scale = 0.01, .pose = {{0, 5, 0}, {0, 1, 0, 0}}});
  Bounds box;
  for (const SceneObject& o : got.scene.objects) {
    for (const Vec3& p : world_vertices(o.object.shape, o.object.pose)) box.add(p);
  }
  CHECK(box.min.x == doctest::Approx(0.0));
  CHECK(box.max.x == doctest::Approx(1.04));
  CHECK(box.min.y == doctest::Approx(4.96));
  CHECK(box.max.y == doctest::Approx(5.0));
  CHECK(box.min.z == doctest::Approx(-0.04));
  CHECK(box.max.z == doctest::Approx(0.0));
}
