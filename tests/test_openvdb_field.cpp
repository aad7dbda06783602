// Volumes that OpenVDB's own tools make and write: read, refused where they are not good, and right as occluders.
#include <cmath>
#include <filesystem>
#include <limits>

#include <doctest/doctest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/core/volume.h"
#include "gridcull/grid/openvdb_field.h"
#include "gridcull/methods/catalog.h"
#include "sim_helpers.h"

using namespace gridcull;

namespace {

using Grid = openvdb::FloatGrid;

using test::content_of;
using test::TemporaryFolder;

Grid::Ptr ball(double radius, double voxel) {
  openvdb::initialize();
  auto grid = openvdb::tools::createLevelSetSphere<Grid>(static_cast<float>(radius), openvdb::Vec3f(0.0f),
                                                         static_cast<float>(voxel));
  grid->setName("ball");
  return grid;
}

/// A level set of a ring about the z axis, in a lattice turned by `angle` about x and y.
Grid::Ptr ring(double radius, double thick, double voxel, double angle) {
  openvdb::initialize();
  auto grid = Grid::create(static_cast<float>(3.0 * voxel));
  auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  transform->postRotate(angle, openvdb::math::X_AXIS);
  transform->postRotate(0.5 * angle, openvdb::math::Y_AXIS);
  transform->postTranslate(openvdb::Vec3d(0.3, -0.2, 0.1));
  grid->setTransform(transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("ring");
  auto values = grid->getAccessor();
  const int n = static_cast<int>(std::ceil(2.0 * (radius + thick) / voxel)) + 4;
  openvdb::Coord p;
  for (p[0] = -n; p[0] <= n; ++p[0]) {
    for (p[1] = -n; p[1] <= n; ++p[1]) {
      for (p[2] = -n; p[2] <= n; ++p[2]) {
        const openvdb::Vec3d w = transform->indexToWorld(p);
        const double d = std::hypot(std::hypot(w.x(), w.y()) - radius, w.z()) - thick;
        if (std::fabs(d) < 3.0 * voxel) values.setValue(p, static_cast<float>(d));
        if (d <= -3.0 * voxel) values.setValueOff(p, static_cast<float>(-3.0 * voxel));
      }
    }
  }
  grid->pruneGrid();
  return grid;
}

void write(const std::string& path, const openvdb::GridPtrVec& grids) {
  openvdb::io::File file(path);
  file.write(grids);
  file.close();
}

std::string refusal(ErrorCode code, const std::string& path, const std::string& grid = {},
                    std::uint64_t most = default_field_memory) {
  try {
    read_scalar_field(path, grid, most);
  } catch (const Error& fault) {
    const std::string line = fault.what();
    CAPTURE(line);
    CHECK(fault.code() == code);
    CHECK(line.find('\n') == std::string::npos);
    CHECK(line.starts_with(path + ": "));
    return line;
  }
  FAIL("was read: " << path);
  return {};
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a field has the values, the tiles and the place of its grid") {
  const TemporaryFolder folder;
  for (const Grid::Ptr& grid : {ball(3.0, 0.25), ball(20.0, 0.25), ring(3.0, 1.0, 0.125, 0.7)}) {
    const std::string path = folder.file("a.vdb");
    write(path, {grid});
    const ScalarField field = read_scalar_field(path);
    CHECK(field.background() == grid->background());
    const Rotation r = rotation_of(field.frame().pose.orientation);
    const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    openvdb::Coord p;
    for (p[0] = box.min().x() - 3; p[0] <= box.max().x() + 3; p[0] += 2) {
      for (p[1] = box.min().y() - 3; p[1] <= box.max().y() + 3; p[1] += 3) {
        for (p[2] = box.min().z() - 3; p[2] <= box.max().z() + 3; p[2] += 3) {
          if (field.at({p.x(), p.y(), p.z()}) != grid->tree().getValue(p)) FAIL_CHECK("another value at " << p);
        }
      }
    }
    const openvdb::Coord q(17, -5, 9);
    const openvdb::Vec3d w = grid->transform().indexToWorld(q);
    const Vec3 here = to_world(field.frame().pose, r, field.frame().voxel * Vec3(17, -5, 9));
    CHECK(glm::length(here - Vec3(w.x(), w.y(), w.z())) < 1e-9);
  }
  CHECK(read_scalar_field([&] {
          write(folder.file("b.vdb"), {ball(20.0, 0.25)});
          return folder.file("b.vdb");
        }())
            .tiles()
            .size() > 0);
}

TEST_CASE("a grid by its name, half floats, shared trees and fog") {
  const TemporaryFolder folder;
  const std::string path = folder.file("some.vdb");
  auto fog = ball(2.0, 0.1);
  openvdb::tools::sdfToFogVolume(*fog);
  fog->setName("fog");
  auto halves = ball(2.0, 0.1);
  halves->setName("half");
  halves->setSaveFloatAsHalf(true);
  auto whole = ball(1.0, 0.1);
  auto shared = openvdb::gridPtrCast<Grid>(whole->copyGrid());  // the same tree, elsewhere
  shared->setName("shared");
  shared->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  auto points = openvdb::Vec3SGrid::create();
  points->setName("wind");
  write(path, {points, fog, halves, whole, shared});
  CHECK(read_scalar_field(path).background() == 0.0f);  // the first of floats
  CHECK(read_scalar_field(path, "half").background() == doctest::Approx(0.3).epsilon(0.001));
  const ScalarField other = read_scalar_field(path, "shared");
  CHECK(other.frame().voxel == 0.5);
  CHECK(other.at({0, 0, 0}) == whole->tree().getValue({0, 0, 0}));
  CHECK(holds(refusal(ErrorCode::bad_scene, path, "wind"), "expected a float grid, found 'wind' of type Tree_vec3s"));
  CHECK(holds(refusal(ErrorCode::bad_scene, path, "rain"), "expected a grid 'rain', found 'wind' of type"));
  const Volume volume = make_volume(std::make_shared<const ScalarField>(read_scalar_field(path, "fog")), 0.5, false);
  CHECK(interior_holds(volume, {}, {0, 0, 0}));
  CHECK_FALSE(interior_holds(volume, {}, {2.0, 0, 0}));
}

TEST_CASE("what is no good volume is refused in one line") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.vdb");
  CHECK(holds(refusal(ErrorCode::io, folder.file("none.vdb")), "there is no such file"));
  CHECK(holds(refusal(ErrorCode::io, folder.file("")), "expected a file"));
  folder.with("a.vdb", "");
  refusal(ErrorCode::bad_scene, path);
  folder.with("a.vdb",
              "{ \"format\": \"gridcull.scene/1\" }, and some more, so that it is longer than any head of a file");
  refusal(ErrorCode::bad_scene, path);

  const auto with_transform = [&](const openvdb::math::Transform::Ptr& transform) {
    auto grid = ball(1.0, 0.25);
    grid->setTransform(transform);
    write(path, {grid});
    return refusal(ErrorCode::bad_scene, path);
  };
  const auto matrix = [](const openvdb::Mat4d& m) { return openvdb::math::Transform::createLinearTransform(m); };
  using openvdb::Mat4d;
  CHECK(holds(
      with_transform(matrix(Mat4d(1.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0))),
      "different lengths"));
  CHECK(holds(
      with_transform(matrix(Mat4d(1.0, 0.0, 0.0, 0.0, 0.6, 0.8, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0))),
      "not perpendicular"));
  CHECK(holds(
      with_transform(matrix(Mat4d(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0))),
      "mirrored"));
  CHECK(holds(with_transform(openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {10, 10, 10}),
                                                                              0.5, 10.0, 0.1)),
              "perspective"));

  auto broken = ball(1.0, 0.25);
  broken->tree().setValueOn({1, 2, 3}, std::numeric_limits<float>::quiet_NaN());
  write(path, {broken});
  CHECK(holds(refusal(ErrorCode::bad_scene, path), "expected finite values, found nan"));
  write(path, {openvdb::Vec3SGrid::create()});
  CHECK(holds(refusal(ErrorCode::bad_scene, path), "expected a float grid, found '' of type"));
  write(path, {});
  CHECK(holds(refusal(ErrorCode::bad_scene, path), "found no grid"));
  write(path, {ball(5.0, 0.1)});
  CHECK(holds(refusal(ErrorCode::limit, path, {}, 100000), "of --max-memory, found"));
  // A tile is small in the file and in memory, whatever it covers.
  auto wide = Grid::create(1.0f);
  wide->fill(openvdb::CoordBBox({0, 0, 0}, {(1 << 20) - 1, 4095, 4095}), -1.0f);
  write(path, {wide});
  CHECK(read_scalar_field(path, {}, 1 << 20).tiles().size() == 256);
}

TEST_CASE("a file cut short anywhere, or of another version, is refused") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.vdb");
  write(path, {ball(0.5, 0.25)});
  const std::string whole = content_of(path);
  REQUIRE(whole.size() < 200000);
  const std::size_t step = whole.size() / 3000 + 1;
  for (std::size_t length = 0; length < whole.size(); length += length < 500 ? 1 : step) {
    CAPTURE(length);
    folder.with("a.vdb", whole.substr(0, length));
    refusal(ErrorCode::bad_scene, path);
  }
  for (const char version : {'\0', '\x07', '\x7f'}) {
    std::string other = whole;
    other[8] = version;  // behind the magic number
    folder.with("a.vdb", other);
    refusal(ErrorCode::bad_scene, path);
  }
}

namespace {

struct Watch {
  std::size_t seen = 0, told = 0, all = 0, missed = 0;
};

/// A volume, objects behind, beside, in front of and in it, and viewers around: what a method tells against the
/// reference.
Watch watch(const std::string& method, const Volume& volume, const Pose& pose, double cell) {
  std::vector<Object> world{{0, volume, pose}};
  world[0].is_static = true;
  for (ObjectId id = 1; id <= 120; ++id) {
    const double turn = 2.399963 * id, up = std::fmod(0.618034 * id, 1.0) * 2.0 - 1.0, far = 3.0 + 0.07 * id;
    const double flat = std::sqrt(1.0 - up * up);
    Object o{id, Sphere{0.2}, {far * Vec3(flat * std::cos(turn), flat * std::sin(turn), up)}};
    o.is_static = id % 2 == 0;
    world.push_back(o);
  }
  std::vector<View> views;
  for (ViewerId id = 0; id < 8; ++id) {
    View& view = views.emplace_back();
    view.viewer = id;
    view.pose.position = 9.0 * glm::normalize(Vec3(id & 1 ? 1.0 : -1.0, id & 2 ? 0.9 : -1.1, id & 4 ? 0.2 : -0.7));
  }
  views.back().pose.position = {0.1, 0.2, 0.3};  // inside, or in a ring's hole
  MethodOptions options;
  options.dimension = 3;
  options.bounds = {Vec3(-13.0), Vec3(13.0)};
  options.cell = cell;
  const auto culler = make_method(method, options);
  for (const Object& o : world) culler->add(o);
  Answers answers;
  culler->query(0.0, views, answers);
  const ExactRays rays(world, 48);
  Watch sum;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const ExactAnswer exact = rays.visible(views[v]);
    const std::vector<ObjectId>& told = answers.views[v].visible;
    sum.seen += exact.visible.size(), sum.told += told.size(), sum.all += world.size();
    for (std::size_t i = 0; i < exact.visible.size(); ++i) {
      if (std::binary_search(told.begin(), told.end(), exact.visible[i])) continue;
      if (rays.confirm(views[v], exact.visible[i], exact.witness[i])) ++sum.missed;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("foreign volumes as occluders: nobody missed, and something hidden") {
  if (!ExactRays::available()) return;
  const TemporaryFolder folder;
  const std::string path = folder.file("a.vdb");
  auto fog = ball(2.5, 0.2);
  openvdb::tools::sdfToFogVolume(*fog);
  const Pose turned{{0.2, -0.1, 0.3}, normalised({0.8, 0.3, -0.4, 0.2})};
  for (const Grid::Ptr& grid : {ball(2.5, 0.5), ball(2.5, 0.1), fog, ring(2.0, 0.8, 0.15, 0.6)}) {
    write(path, {grid});
    const auto field = std::make_shared<const ScalarField>(read_scalar_field(path));
    const bool below = grid->background() > 0.0f;
    const Volume volume = make_volume(field, below ? 0.0 : 0.3, below);
    for (const Pose& pose : {Pose{}, turned}) {
      for (const double cell : {0.4, 1.1}) {
        for (const std::string method : {"voxel", "silhouette"}) {
          const Watch w = watch(method, volume, pose, cell);
          MESSAGE(grid->getName() << " of voxels " << field->frame().voxel << ", cell " << cell << ", " << method
                                  << ": " << w.seen << " seen, " << w.told << " told of " << w.all << ", " << w.missed
                                  << " missed");
          CHECK(w.missed == 0);
          if (method == "silhouette") CHECK(w.told < 0.97 * static_cast<double>(w.all));
        }
      }
    }
  }
}
