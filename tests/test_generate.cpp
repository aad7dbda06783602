#include <map>

#include <doctest/doctest.h>

#include "gridcull/core/hash.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/generate_parts.h"
#include "gridcull/sim/world.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// Small versions of all kinds.
GenerateOptions small(std::string_view name) {
  GenerateOptions options;
  options.count = name == "maze" ? 6 : 60;
  options.blocks = 3;
  options.frames = 250;
  return options;
}

std::string text_of(std::string_view name, const GenerateOptions& options) {
  const auto generator = make_generator(name, options);
  std::string out = scene_text(generator->scene());
  Frame frame;
  while (generator->next(frame)) out += frame_text(frame, generator->scene().dimension) + "\n";
  return out;
}

std::uint64_t hash_of(const std::string& text) {
  StableHash hash;
  for (const char c : text) hash.add(static_cast<std::uint32_t>(static_cast<unsigned char>(c)));
  return hash.value();
}

}  // namespace

TEST_CASE("generated scenes have the same bits everywhere") {
  // Golden: a change of these is a change of everybody's benchmark scenes.
  const std::map<std::string_view, std::uint64_t> golden{{"spheres", 0xC09965A648577F81ull},
                                                         {"city", 0x3D15E0B490CE04CCull},
                                                         {"discs", 0x288FAC7D60FABBC4ull},
                                                         {"town", 0x20F2FA115AE09648ull},
                                                         {"maze", 0x6A43953262FE61CAull}};
  for (const std::string_view name : generated_scenes()) {
    const std::string text = text_of(name, small(name));
    CAPTURE(std::string(name));
    CHECK(hash_of(text) == golden.at(name));
    CHECK(text == text_of(name, small(name)));
    GenerateOptions other = small(name);
    other.seed = 2;
    CHECK(text != text_of(name, other));
  }
}

TEST_CASE("scenes and frames read back from their text, in step, within bounds and max_speed") {
  for (const std::string_view name : generated_scenes()) {
    CAPTURE(std::string(name));
    const auto generator = make_generator(name, small(name));
    const Scene scene = parse_scene(scene_text(generator->scene()), "scene");
    World world(scene);
    Frame frame;
    std::uint64_t frames = 0, moves = 0;
    double slowest = 1e9, fastest = 0.0;  // of the share of max_speed that is used
    while (generator->next(frame)) {
      const Frame read = parse_frame(frame_text(frame, scene.dimension), scene.dimension, "f");
      const double seconds = world.time() ? read.time - *world.time() : 0.0;
      std::map<ObjectId, Vec3> before;
      for (const ObjectMove& move : read.set) before[move.id] = world.object(move.id).pose.position;
      world.apply(read);
      for (const ObjectMove& move : read.set) {
        const Object& object = world.object(move.id);
        const double way = glm::length(object.pose.position - before[move.id]);
        REQUIRE(object.max_speed);
        REQUIRE(way <= *object.max_speed * seconds);
        REQUIRE_FALSE(object.is_static);
        const double share = way / (*object.max_speed * seconds);
        slowest = std::min(slowest, share);
        fastest = std::max(fastest, share);
        for (int axis = 0; axis < scene.dimension; ++axis) {
          const double reach = reach_of(object.shape);
          REQUIRE(object.pose.position[axis] - reach >= scene.bounds->min[axis] - reach);
          REQUIRE(object.pose.position[axis] <= scene.bounds->max[axis]);
        }
        ++moves;
      }
      for (const View& view : world.views()) REQUIRE_NOTHROW(ViewVolume(view, scene.dimension));
      CHECK(frame.time == static_cast<double>(frames) / 30.0);
      ++frames;
    }
    CHECK(frames == 250);
    CHECK(moves > 249 * 5);
    // The bound is no loose one either.
    CHECK(fastest > 0.99);
    CHECK(slowest < fastest);
    CHECK(world.viewer_count() > 0);
  }
}

TEST_CASE("counts are as asked") {
  const auto objects = [](std::string_view name, const GenerateOptions& options) {
    return make_generator(name, options)->scene().objects.size();
  };
  CHECK(objects("spheres", {}) == 5000);
  CHECK(objects("spheres", {.count = 10}) == 10);
  CHECK(objects("discs", {}) == 300);
  CHECK(objects("town", {.count = 100}) == 125);
  CHECK(make_generator("spheres", {})->frame_count() == 140);
  const Scene city = make_generator("city", {.count = 0, .blocks = 10})->scene();
  CHECK(city.objects.size() >= 100);
  CHECK(city.objects.size() <= 400);
  CHECK(city.bounds->max.x == 208.0);
}

TEST_CASE("viewers, range and cell are as asked") {
  for (const std::string_view name : generated_scenes()) {
    GenerateOptions options = small(name);
    options.viewers = 3;
    options.range = 77.0;
    options.cell = 1.25;
    const auto generator = make_generator(name, options);
    const Scene& scene = generator->scene();
    CAPTURE(std::string(name));
    CHECK(scene.cell == 1.25);
    REQUIRE(scene.viewers.size() == 3);
    ObjectId last = 0;
    for (const SceneViewer& viewer : scene.viewers) {
      CHECK(viewer.range == 77.0);
      CHECK(viewer.follows == viewer.id);
      CHECK(viewer.id >= last);
      CHECK_FALSE(scene.objects.at(viewer.id).object.is_static);
      CHECK_FALSE(viewer.frustum);
      last = viewer.id + 1;
    }
    Frame frame;
    while (generator->next(frame)) CHECK(frame.viewers.empty());
  }
}

TEST_CASE("the camera of spheres looks at the middle, that of the city along the street") {
  const auto spheres = make_generator("spheres", {.count = 1});
  World world(spheres->scene());
  Frame frame;
  while (spheres->next(frame)) {
    world.apply(frame);
    const View view = world.views().at(0);
    const Vec3 to_middle = Vec3(50, 50, 30) - view.pose.position;
    const Rotation r = rotation_of(view.pose.orientation);
    CHECK(glm::dot(r.x, glm::normalize(to_middle)) == doctest::Approx(1.0).epsilon(1e-12));
    CHECK(r.y.z == doctest::Approx(0.0));
    CHECK(r.z.z > 0.0);
    CHECK(glm::length(Vec2(to_middle)) == doctest::Approx(45.0));
    CHECK(view.frustum->fov_y == doctest::Approx(1.0471975511965976));
  }
  const auto city = make_generator("city", {.count = 0, .blocks = 10});
  World streets(city->scene());
  while (city->next(frame)) {
    streets.apply(frame);
    const View view = streets.views().at(0);
    CHECK(view.pose.position.z == 1.6);
    for (const Object& building : streets.objects()) {
      REQUIRE_FALSE(interior_holds(building.shape, building.pose, view.pose.position));
    }
  }
}

TEST_CASE("walkers of a maze never touch a wall") {
  const auto generator = make_generator("maze", {.count = 8, .frames = 400});
  World world(generator->scene());
  Frame frame;
  while (generator->next(frame)) {
    world.apply(frame);
    for (const Object& walker : world.objects()) {
      const auto* disc = std::get_if<Disc>(&walker.shape);
      if (!disc) continue;
      for (const Object& wall : world.objects()) {
        if (!wall.is_static) continue;
        REQUIRE(distance_2d(Vec2(walker.pose.position), wall.shape, wall.pose) > disc->radius);
      }
    }
  }
}

TEST_CASE("buildings of city and town stand apart") {
  for (const std::string_view name : {"city", "town"}) {
    const Scene scene = make_generator(name, {.count = 100, .blocks = 6, .seed = 4})->scene();
    std::vector<Bounds> boxes;
    for (const SceneObject& object : scene.objects) {
      if (!object.object.is_static) continue;
      Vec3 size(0.0);
      if (const auto* box = std::get_if<Cuboid>(&object.object.shape))
        size = box->size;
      else
        size = Vec3(std::get<Rectangle>(object.object.shape).size, 0.0);
      boxes.push_back({object.object.pose.position - 0.5 * size, object.object.pose.position + 0.5 * size});
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      CHECK(boxes[i].min.z == 0.0);
      for (std::size_t j = i + 1; j < boxes.size(); ++j) {
        const Bounds &a = boxes[i], &b = boxes[j];
        const double gap_x = std::max(a.min.x - b.max.x, b.min.x - a.max.x);
        const double gap_y = std::max(a.min.y - b.max.y, b.min.y - a.max.y);
        REQUIRE(std::max(gap_x, gap_y) >= 1.0 - 1e-9);
      }
    }
  }
}

TEST_CASE("bad options are refused") {
  const auto said = [](std::string_view name, const GenerateOptions& options) {
    return refusal(ErrorCode::usage, [&] { make_generator(name, options); });
  };
  CHECK(said("cubes", {}) == "no generated scene is called \"cubes\": expected spheres, city, discs, town or maze");
  CHECK(said("maze", {.count = 0}).starts_with("count: "));
  CHECK(said("city", {.blocks = 0}).starts_with("blocks: "));
  CHECK(said("discs", {.range = -1.0}).starts_with("range: expected metres above 0 and at most 1e9, found -1"));
  CHECK(said("discs", {.cell = 0.0}).starts_with("cell: "));
  CHECK(said("discs", {.cell = 1e10}) == "cell: expected metres above 0 and at most 1e9, found 1e+10");
  CHECK(said("discs", {.frames = 0}).starts_with("frames: "));
  CHECK(said("discs", {.count = 4'000'000'000u}).starts_with("count: "));
}

TEST_CASE("the sum of uniforms has mean 0 and variance 1, and the numbers are splitmix64's") {
  Random random(1);
  CHECK(random.bits() == 0x910A2DEC89025CC1ull);  // the first output of the published code for seed 1
  double sum = 0.0, squares = 0.0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
  }
  CHECK(sum / n == doctest::Approx(0.0).scale(1.0).epsilon(0.02));
  CHECK(squares / n == doctest::Approx(1.0).epsilon(0.02));
  for (int i = 0; i < 1000; ++i) CHECK(random.below(7) < 7);
}
