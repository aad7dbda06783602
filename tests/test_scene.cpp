#include <bit>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "gridcull/sim/random.h"
#include "gridcull/sim/scene.h"
#include "gridcull/sim/scene_json.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

const char* const formats_example = R"({ "format": "gridcull.scene/1", "dimension": 2,
  "bounds": {"min": [0, 0], "max": [2000, 2000]},
  "grid": {"cell": 2.0},
  "objects": [
    {"id": 0, "name": "b-17", "static": true, "shape": {"type": "polygon", "vertices": [[0,0],[10,0],[10,8],[0,8]]}, "position": [100, 40]},
    {"id": 9, "name": "veh9", "shape": {"type": "box", "size": [5.0, 1.8]}, "position": [12.5, 7.0], "heading": 1.5708, "max_speed": 60.0},
    {"id": 12, "shape": {"type": "disc", "radius": 0.25}, "position": [30, 7], "max_speed": 5.0, "occluder": false} ],
  "viewers": [ {"id": 1, "follows": 9, "range": 150.0}, {"id": 2, "position": [50, 50], "heading": 0.0, "fov_degrees": 90} ] })";

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
bool same_bits(const Pose& a, const Pose& b) {
  const Quat &p = a.orientation, &q = b.orientation;
  return same_bits(a.position, b.position) && same_bits(p.w, q.w) && same_bits(p.x, q.x) && same_bits(p.y, q.y) &&
         same_bits(p.z, q.z);
}

/// Full-length digits of any size up to 1e9.
double odd_number(Random& random) {
  const double sizes[] = {1e-7, 1e-3, 1.0, 1e3, 1e6, 9.9e8};
  return random.uniform(-1.0, 1.0) * sizes[random.below(6)];
}

Shape random_shape(Random& random, int dimension) {
  const auto positive = [&] { return std::fabs(odd_number(random)) + 1e-9; };
  const auto flat = [&] { return Vec2(odd_number(random), odd_number(random)); };
  const auto point = [&] { return Vec3(odd_number(random), odd_number(random), odd_number(random)); };
  const std::vector<Vec2> outline{flat(), flat(), flat(), flat()};
  const std::vector<Vec3> corners{point(), point(), point(), point(), point()};
  if (dimension == 2) {
    switch (random.below(4)) {
      case 0: return Disc{positive()};
      case 1: return Rectangle{{positive(), positive()}};
      case 2: return Polygon{outline};
      default: return Polyline{outline};
    }
  }
  switch (random.below(5)) {
    case 0: return Sphere{positive()};
    case 1: return Cuboid{{positive(), positive(), positive()}};
    case 2: return Prism{outline, positive()};
    case 3:
      return Convex{{{0, 0, 0}, {1.1, 0, 0}, {0, random.uniform(0.5, 9.0), 0}, {0.3, 0, random.uniform(0.5, 9.0)}}};
    default: return Faces{corners, {{0, 1, 2}, {4, 3, 2}}};
  }
}

SceneObject random_object(Random& random, int dimension, ObjectId id) {
  SceneObject out;
  out.object.id = id;
  out.object.shape = random_shape(random, dimension);
  out.object.pose.position = {odd_number(random), odd_number(random), dimension == 3 ? odd_number(random) : 0.0};
  if (dimension == 2 || random.below(2) == 0) {
    out.heading = random.uniform(-4.0, 4.0);
    out.object.pose.orientation = turn_about_z(*out.heading);
  } else {
    Quat q{random.normal(), random.normal(), random.normal(), random.normal()};
    for (int i = 0; i < 4; ++i) q = normalised(q);
    out.object.pose.orientation = q;
  }
  if (random.below(2) == 0) out.object.max_speed = std::fabs(odd_number(random));
  out.object.occluder = random.below(2) == 0;
  out.object.is_static = random.below(2) == 0;
  if (random.below(2) == 0) out.name = "n\"\\\n\x01 \xC3\xA9" + std::to_string(id);
  return out;
}

}  // namespace

TEST_CASE("the scene of FORMATS reads as it says") {
  const Scene scene = parse_scene(formats_example, "town.json");
  CHECK(scene.dimension == 2);
  REQUIRE(scene.bounds);
  CHECK(scene.bounds->max == Vec3(2000, 2000, 0));
  CHECK(scene.cell == 2.0);
  REQUIRE(scene.objects.size() == 3);
  const Object& building = scene.objects[0].object;
  CHECK(scene.objects[0].name == "b-17");
  CHECK(building.is_static);
  CHECK(building.occluder);
  CHECK_FALSE(building.max_speed);
  CHECK(std::get<Polygon>(building.shape).vertices.size() == 4);
  const SceneObject& vehicle = scene.objects[1];
  CHECK(vehicle.heading == 1.5708);
  CHECK(same_bits(vehicle.object.pose, {{12.5, 7.0, 0.0}, turn_about_z(1.5708)}));
  CHECK(vehicle.object.max_speed == 60.0);
  CHECK_FALSE(scene.objects[2].object.occluder);
  REQUIRE(scene.viewers.size() == 2);
  CHECK(scene.viewers[0].follows == 9u);
  CHECK(scene.viewers[0].range == 150.0);
  CHECK_FALSE(scene.viewers[0].own_direction);
  CHECK(scene.viewers[0].fov == 2.0 * std::numbers::pi);
  CHECK(scene.viewers[1].own_direction);
  CHECK(scene.viewers[1].fov == doctest::Approx(0.5 * std::numbers::pi));
  CHECK(std::isinf(scene.viewers[1].range));
}

TEST_CASE("the empty scene is valid and reads back") {
  for (const int dimension : {2, 3}) {
    Scene empty;
    empty.dimension = dimension;
    const Scene back = parse_scene(scene_text(empty), "empty");
    CHECK(back.dimension == dimension);
    CHECK(back.objects.empty());
    CHECK(back.viewers.empty());
    CHECK_FALSE(back.bounds);
    CHECK_FALSE(back.cell);
  }
}

TEST_CASE("3D: heading and orientation, frustum and its defaults") {
  const Scene scene = parse_scene(R"({"format": "gridcull.scene/1", "dimension": 3, "objects": [
    {"id": 1, "shape": {"type": "sphere", "radius": 2}, "position": [1, 2, 3], "orientation": [0, 0, 0, 2]},
    {"id": 2, "shape": {"type": "box", "size": [1, 2, 3]}, "position": [1, 2, 3], "heading": 0.5}],
    "viewers": [{"id": 0, "position": [0, 0, 1], "frustum": {"fov_y_degrees": 60, "aspect": 1.5}},
                {"id": 7, "follows": 2, "offset": [0, 0, 1], "orientation": [1, 0, 0, 0],
                 "frustum": {"fov_y_degrees": 90, "aspect": 2, "near": 0.5, "far": 100}}]})",
                                  "s");
  CHECK(scene.objects[0].object.pose.orientation.z == 1.0);
  CHECK_FALSE(scene.objects[0].heading);
  CHECK(same_bits(scene.objects[1].object.pose.orientation.z, turn_about_z(0.5).z));
  REQUIRE(scene.viewers[0].frustum);
  CHECK(scene.viewers[0].frustum->fov_y == doctest::Approx(std::numbers::pi / 3));
  CHECK(scene.viewers[0].frustum->near == 0.0);
  CHECK(std::isinf(scene.viewers[0].frustum->far));
  CHECK(scene.viewers[1].frustum->far == 100.0);
  CHECK(scene.viewers[1].pose.position == Vec3(0, 0, 1));
  CHECK(scene.viewers[1].own_direction);
}

TEST_CASE("what is written reads back with the same bits") {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Scene scene;
    scene.dimension = seed % 2 == 0 ? 2 : 3;
    for (ObjectId id = 0; id < 6; ++id) {
      scene.objects.push_back(random_object(random, scene.dimension, id * 700'000'000u));
    }
    const Scene back = parse_scene(scene_text(scene), "s");
    REQUIRE(back.objects.size() == scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const SceneObject &a = scene.objects[i], &b = back.objects[i];
      CHECK(a.object.id == b.object.id);
      CHECK(a.name == b.name);
      CHECK(same_bits(a.object.pose, b.object.pose));
      CHECK(a.heading == b.heading);
      CHECK(a.object.max_speed == b.object.max_speed);
      CHECK(a.object.occluder == b.object.occluder);
      CHECK(a.object.is_static == b.object.is_static);
      CHECK(a.object.shape.index() == b.object.shape.index());
    }
    // Shapes and everything else, by their text.
    CHECK(scene_text(back) == scene_text(scene));
  }
}

TEST_CASE("a quaternion of any length is made unit once and then stays") {
  Random random(5);
  for (int i = 0; i < 20'000; ++i) {
    std::string text = R"({"format": "gridcull.scene/1", "dimension": 3, "viewers": [], "objects": [
      {"id": 1, "shape": {"type": "sphere", "radius": 2}, "position": [1, 2, 3], "orientation": [)";
    for (int k = 0; k < 4; ++k) text += std::to_string(random.normal()) + (k < 3 ? ", " : "]}]}");
    const Scene once = parse_scene(text, "s");
    const Scene twice = parse_scene(scene_text(once), "s");
    REQUIRE(same_bits(once.objects[0].object.pose, twice.objects[0].object.pose));
  }
}

TEST_CASE("angles in degrees read back as the same radians") {
  Random random(6);
  for (int i = 0; i < 20'000; ++i) {
    const double degrees =
        i % 2 == 0 ? random.uniform(1e-3, 360.0) : static_cast<double>(random.below(36'000) + 1) / 100.0;
    CAPTURE(degrees);
    REQUIRE(same_bits(radians_of(degrees_of(radians_of(degrees))), radians_of(degrees)));
  }
  CHECK(degrees_of(radians_of(90.0)) == 90.0);
  CHECK(degrees_of(radians_of(170.0)) == 170.0);
  CHECK(radians_of(360.0) == 2.0 * std::numbers::pi);
}

TEST_CASE("minus zero keeps its sign") {
  Scene scene;
  SceneObject& object = scene.objects.emplace_back();
  object.object.id = 3;
  object.object.pose.position = {-0.0, 1.0, 0.0};
  const Scene back = parse_scene(scene_text(scene), "s");
  CHECK(std::signbit(back.objects[0].object.pose.position.x));
}

TEST_CASE("viewers read back as they were") {
  Scene scene = parse_scene(formats_example, "s");
  SceneViewer& rider = scene.viewers.emplace_back();
  rider.id = 77;
  rider.follows = 12;
  rider.pose = {{0.1, -0.3, 0.0}, turn_about_z(2.5)};
  rider.own_direction = true;
  rider.heading = 2.5;
  rider.fov = radians_of(123.4);
  const Scene back = parse_scene(scene_text(scene), "s");
  REQUIRE(back.viewers.size() == 3);
  CHECK(back.viewers[2].follows == 12u);
  CHECK(same_bits(back.viewers[2].pose, rider.pose));
  CHECK(back.viewers[2].own_direction);
  CHECK(same_bits(back.viewers[2].fov, rider.fov));
  CHECK(scene_text(back) == scene_text(scene));
}
