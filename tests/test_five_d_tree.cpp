// The five-dimensional tree: its rays, its bake with breaks, and what viewers are told.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/methods/five_d_bake.h"
#include "gridcull/methods/five_d_rays.h"
#include "gridcull/methods/five_d_tree.h"
#include "gridcull/sim/generate.h"
#include "sim_helpers.h"

namespace gridcull::test {
namespace {

using Ids = std::vector<ObjectId>;

const Bounds square{{-50, -50, 0}, {50, 50, 0}};

/// A room north and one south of a wall along y = 0 with a door at x = 40 .. 50; a box in each, and something that
/// moves.
std::vector<Object> rooms() {
  const auto box = [](ObjectId id, Vec2 at, Vec2 size, bool is_static) {
    return Object{.id = id, .shape = Rectangle{size}, .pose = {{at, 0}}, .is_static = is_static};
  };
  return {box(5, {-5, 0}, {90, 2}, true), box(2, {-30, 30}, {4, 4}, true), box(9, {-30, -30}, {4, 4}, true),
          box(7, {-20, -30}, {2, 2}, false)};
}

std::vector<Object> objects_of(const Scene& scene) {
  std::vector<Object> objects;
  for (const SceneObject& object : scene.objects) objects.push_back(object.object);
  return objects;
}

FiveDOptions quick(int threads = 1) {
  FiveDOptions options;
  options.s_thresh = 0.05;
  options.cells = 40;
  options.boxes = 64;
  options.threads = threads;
  return options;
}

struct Told {
  std::unique_ptr<Culler> culler;
  Answers answers{};
  double time = 0.0;

  explicit Told(const std::vector<Object>& objects, FiveDTreeOptions options = {.dimension = 2, .bounds = square})
      : culler(make_five_d_tree(options)) {
    for (const Object& object : objects) culler->add(object);
  }
  Ids operator()(const View& view) {
    culler->query(time += 1.0, std::span(&view, 1), answers);
    return answers.views.at(0).visible;
  }
  Ids operator()(Vec2 at) { return (*this)(View{.viewer = 1, .pose = {{at, 0}}}); }
};

/// Stops after a number of looks at the progress.
class Breaks final : public BakeListener {
 public:
  explicit Breaks(int looks) : looks_(looks) {}
  bool progress(double share) override {
    CHECK(share >= last);
    CHECK(share <= 1.0);
    last = share;
    return looks_-- > 0;
  }
  void checkpoint(std::span<const std::byte> bytes) override { state.assign(bytes.begin(), bytes.end()); }
  std::vector<std::byte> state{};
  double last = 0.0;

 private:
  int looks_;
};

Scene town() { return make_generator("town", {.count = 36, .viewers = 4, .frames = 2})->scene(); }

}  // namespace

TEST_CASE("points of surfaces lie on them, and everywhere on them") {
  const std::vector<Shape> shapes{Disc{2},
                                  Rectangle{{2, 6}},
                                  Polygon{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}},
                                  Polyline{{{0, 0}, {3, 1}, {3, 5}}},
                                  Sphere{2},
                                  Cuboid{{1, 2, 3}},
                                  Prism{{{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}}, 5},
                                  Convex{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {2, 2, 2}}},
                                  Faces{{{0, 0, 0}, {4, 0, 0}, {0, 4, 1}, {0, 0, 5}}, {{{0, 1, 2}}, {{0, 1, 3}}}}};
  for (const Shape& shape : shapes) {
    CAPTURE(name_of(shape));
    const LocalShape local = make_local_shape(shape);
    const SurfacePoints surface(local);
    Random random(11);
    std::vector<double> cuts;
    Bounds met;
    int blocked = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = surface.at(local, random);
      met.add(p);
      for (int k = 0; k < 3; ++k) REQUIRE(std::fabs(p[k] - local.middle[k]) <= local.half[k] + 1e-9);
      if (local.kind == LocalShape::Kind::ball) REQUIRE(glm::length(p) == doctest::Approx(local.radius));
      // A ray from one side of the surface to the other: one end is inside, or the thin face between them.
      const Vec3 d(random.uniform(-1, 1), random.uniform(-1, 1), local.flat ? 0.0 : random.uniform(-1, 1));
      blocked += blocks_segment(local, p - 1e-3 * d, 2e-3 * d, cuts) ? 1 : 0;
    }
    CHECK(blocked > 2900);
    for (int k = 0; k < (local.flat ? 2 : 3); ++k) {
      CHECK(met.min[k] < local.middle[k] - 0.85 * local.half[k]);
      CHECK(met.max[k] > local.middle[k] + 0.85 * local.half[k]);
    }
  }
}

TEST_CASE("no line of sight leaves the eighths of a turn that its member was given") {
  const FiveDScene scene(rooms(), 2, square, quick());
  FiveDScene::Scratch scratch;
  Random random(3);
  int some = 0;
  for (int round = 0; round < 200; ++round) {
    ViewCell cell = scene.space().whole();
    for (const std::size_t k : {0u, 1u}) {
      cell.low[k] = random.uniform(-50, 45);
      cell.high[k] = cell.low[k] + random.uniform(0.1, 50.0 - cell.low[k]);
    }
    CellRays rays(scene, cell, random.bits(), scratch);
    if (rays.solid()) continue;
    for (std::uint32_t member = 0; member < scene.members(); ++member) {
      const unsigned eighths = rays.eighths(member);
      some += eighths != 0xFFu ? 1 : 0;
      KeptRay ray{};
      for (int i = 0; i < 20; ++i) {
        REQUIRE(rays.aim(member, ray));
        const double turn = static_cast<double>(ray.at[turn_axis]);
        // In floats a turn may round up to the next eighth.
        const auto low = static_cast<int>(turn - 1e-5) % 8, high = static_cast<int>(turn + 1e-5) % 8;
        CHECK(((eighths >> low | eighths >> high) & 1) == 1);
      }
    }
  }
  CHECK(some > 1000);
}

TEST_CASE("motion boxes cover the world and are no more than asked for") {
  for (const int wanted : {0, 1, 7, 64, 500}) {
    FiveDOptions options = quick();
    options.boxes = wanted;
    const FiveDScene scene(rooms(), 2, square, options);
    const FiveDSpace& space = scene.space();
    CHECK(space.box_count() <= static_cast<std::uint32_t>(wanted));
    CHECK((space.box_count() > 0) == (wanted > 0));
    if (wanted >= 64) CHECK(space.box_count() > static_cast<std::uint32_t>(wanted) / 4);
    Bounds all;
    for (std::uint32_t b = 0; b < space.box_count(); ++b) all.add(space.box(b).min), all.add(space.box(b).max);
    if (wanted == 0) continue;
    CHECK(all.min == square.min);
    CHECK(all.max == square.max);
  }
}

TEST_CASE("a wall hides the other room, also from what moves, and the door shows it") {
  std::vector<Object> world = rooms();
  Told told(world);
  CHECK(told(Vec2(-35, 10)) == Ids{2, 5});
  CHECK(told(Vec2(-35, -10)) == Ids{5, 7, 9});
  told.culler->move(7, {{-20, 20, 0}});
  CHECK(told(Vec2(-35, 10)) == Ids{2, 5, 7});
  CHECK(told(Vec2(-35, -10)) == Ids{5, 9});
  // Through the door, and away from the wall.
  CHECK(told(Vec2(45, 0)) == Ids{2, 5, 7, 9});
  CHECK(told(View{.viewer = 1, .pose = {{-30, 20, 0}, turn_about_z(1.5707963)}, .fov = 0.5}) == Ids{2});
  CHECK(told(View{.viewer = 1, .pose = {{-35, 10, 0}}, .range = 12.0}) == Ids{5});
}

TEST_CASE("where the tree knows nothing, everything in view is reported") {
  std::vector<Object> world = rooms();
  {
    Told told(world);
    CHECK(told(Vec2(-35, 0)) == Ids{2, 5, 7, 9});   // inside the wall
    CHECK(told(Vec2(-35, 60)) == Ids{2, 5, 7, 9});  // outside the world
    View rider{.viewer = 1, .pose = {{-35, 10, 0}}, .rides = 5};
    CHECK(told(rider) == Ids{2, 7, 9});  // the wall does not hide from who rides on it
    rider.rides = 2;
    CHECK(told(rider) == Ids{5, 7, 9});  // nor does a box
    rider.rides = 7;
    CHECK(told(rider) == Ids{2, 5});
    told.culler->move(7, {{200, 200, 0}});
    CHECK(told(Vec2(-35, -10)) == Ids{5, 7, 9});  // it left the motion boxes
    told.culler->move(2, {{-31, 30, 0}});
    CHECK(told(Vec2(-35, 10)) == Ids{2, 5, 7, 9});  // a static object moved: the tree is out of date
  }
  Told told(world);
  CHECK(told(Vec2(-35, 10)) == Ids{2, 5});
  told.culler->remove(5);
  CHECK(told(Vec2(-35, 10)) == Ids{2, 7, 9});
  world[0].occluder = false;
  Told open(world);
  CHECK(open(Vec2(-35, 10)) == Ids{2, 5, 7, 9});
  for (Object& object : world) object.is_static = false;
  Told moving(world);
  CHECK(moving(Vec2(-35, 10)) == Ids{2, 5, 7, 9});
}

TEST_CASE("the same bits at any number of threads, and with or without a break") {
  const Scene scene = town();
  const std::vector<Object> objects = objects_of(scene);
  const auto bake = [&](int threads, std::span<const std::byte> state, BakeListener* listener) {
    return bake_five_d(objects, 2, *scene.bounds, quick(threads), state, listener);
  };
  const std::vector<std::byte> whole = five_d_payload(*bake(1, {}, nullptr));
  CHECK(five_d_payload(*bake(4, {}, nullptr)) == whole);
  Breaks patient(1 << 30);
  CHECK(five_d_payload(*bake(2, {}, &patient)) == whole);
  CHECK(patient.last == 1.0);
  CHECK(patient.state.empty());
  // Broken off at once, and again and again.
  std::vector<std::byte> state;
  std::optional<FiveDBaked> done;
  int breaks = 0;
  for (int looks = 0; !done; ++looks) {
    REQUIRE(looks < 1000);
    Breaks listener(looks);
    done = bake(2, state, &listener);
    if (!done) state = listener.state, ++breaks;
    CHECK((done || !state.empty()));
  }
  CHECK(breaks > 0);
  CHECK(five_d_payload(*done) == whole);
  // A state that is cut short, or of other objects.
  for (std::size_t length = 1; length < state.size(); length += 1 + state.size() / 30) {
    CHECK_THROWS_AS(bake(1, std::span(state).first(length), nullptr), Error);
  }
  std::vector<Object> fewer(objects.begin() + 1, objects.end());
  CHECK_THROWS_AS(bake_five_d(fewer, 2, *scene.bounds, quick(), state, nullptr), Error);
}

TEST_CASE("payloads are read back, described, and refused when they are damaged") {
  const Scene scene = town();
  const FiveDBaked baked = *bake_five_d(objects_of(scene), 2, *scene.bounds, quick(), {}, nullptr);
  const std::vector<std::byte> payload = five_d_payload(baked);
  CHECK(five_d_payload(read_five_d_payload(payload, "test")) == payload);
  CHECK(baked.cells > 20);
  CHECK(baked.cells <= 40);
  const std::string text = describe_five_d(payload);
  for (const char* words : {"36 static objects", "cells", "leaves alone", "within the parent", "parent and sibling"}) {
    CHECK(text.find(words) != std::string::npos);
  }
  // Each relative coding is shorter, and the shortest is what is written.
  const auto bits = [&](FiveDCoding coding) { return encode(baked.tree, baked.space, coding).size; };
  CHECK(bits(FiveDCoding::parent) < bits(FiveDCoding::plain));
  CHECK(bits(FiveDCoding::sibling) < bits(FiveDCoding::parent));
  CHECK(payload.size() < bits(FiveDCoding::sibling) / 8 + 200);
  for (std::size_t length = 0; length < payload.size(); length += 1 + payload.size() / 50) {
    CHECK_THROWS_AS(read_five_d_payload(std::span(payload).first(length), "test"), Error);
  }
}

TEST_CASE("a baked file is used, and refused in another world") {
  const Scene scene = town();
  const std::vector<Object> objects = objects_of(scene);
  const TemporaryFolder folder;
  const std::string path = folder.file("town.baked");
  FiveDTreeOptions options{.dimension = 2, .bounds = *scene.bounds, .baked = path};
  const View view{.viewer = 1, .pose = {{60, 60, 0}}};
  Told unbaked(objects, {.dimension = 2, .bounds = *scene.bounds});
  Told missing(objects, options);
  CHECK_THROWS_AS(missing(view), Error);
  const FiveDBaked baked = *bake_five_d(objects, 2, *scene.bounds, quick(), {}, nullptr);
  write_baked(path, {"five-d-tree", five_d_version, static_world_hash(objects)}, five_d_payload(baked));
  Told told(objects, options);
  const Ids visible = told(view);
  CHECK_FALSE(visible.empty());
  CHECK(visible.size() < objects.size());
  CHECK(visible != unbaked(view));
  Told wider(objects, {.dimension = 2, .bounds = *scene.bounds, .baked = path, .view_box = 30.0});
  CHECK(wider(view).size() > visible.size());
  std::vector<Object> other = objects;
  other[0].pose.position.x += 1.0;
  Told elsewhere(other, options);
  CHECK_THROWS_AS(elsewhere(view), Error);
}

TEST_CASE("settings: significant visibility lists fewer, direction planes and no intervals work") {
  const Scene scene = town();
  const std::vector<Object> objects = objects_of(scene);
  const auto bake = [&](auto&& change) {
    FiveDOptions options = quick();
    change(options);
    return *bake_five_d(objects, 2, *scene.bounds, options, {}, nullptr);
  };
  const auto listed = [](const FiveDBaked& baked) {
    std::size_t count = 0;
    for (const std::uint64_t word : baked.tree.sets) count += static_cast<std::size_t>(std::popcount(word));
    return static_cast<double>(count) / static_cast<double>(baked.tree.leaves(baked.space));
  };
  const double standard = listed(bake([](FiveDOptions&) {}));
  CHECK(listed(bake([](FiveDOptions& o) { o.significant = true; })) < standard);
  const FiveDBaked whole = bake([](FiveDOptions& o) { o.intervals = 1; });
  CHECK(listed(whole) > 1.5 * standard);
  CHECK(whole.tree.leaves(whole.space) <= 40);
  const FiveDBaked directed = bake([](FiveDOptions& o) { o.direction_planes = 7, o.intervals = 1; });
  const auto turns = [](const FiveDNode& node) { return node.axis == turn_axis; };
  CHECK(std::any_of(directed.tree.nodes.begin(), directed.tree.nodes.end(), turns));
  CHECK_THROWS_AS(five_d_options({{"intervals", 3.0}}), Error);
  CHECK_THROWS_AS(five_d_options({{"low", 3.0}, {"high", 2.0}}), Error);
}

TEST_CASE("in a small town few are missed, and the misses are what the reference says") {
  const auto generator = make_generator("town", {.count = 64, .viewers = 8, .range = 80.0, .frames = 2});
  const Scene& scene = generator->scene();
  const std::vector<Object> objects = objects_of(scene);
  Told told(objects, {.dimension = 2, .bounds = *scene.bounds});
  std::size_t exact = 0, missed = 0, reported = 0, in_view = 0;
  for (const SceneObject& viewer : scene.objects) {
    if (viewer.object.is_static) continue;
    const View view{.viewer = 1, .pose = viewer.object.pose, .range = 80.0, .rides = viewer.object.id};
    const Ids visible = told(view);
    const ExactAnswer truth = exact_visible_2d(objects, view);
    exact += truth.visible.size();
    reported += visible.size();
    for (const ObjectId id : truth.visible) missed += std::binary_search(visible.begin(), visible.end(), id) ? 0 : 1;
    const ViewVolume volume(view, 2);
    for (const Object& o : objects) in_view += volume.may_touch(o.shape, o.pose) ? 1 : 0;
  }
  MESSAGE(exact << " visible, " << missed << " missed, " << reported << " reported, " << in_view << " in range");
  CHECK(exact > 150);
  CHECK(50 * missed < exact);
  CHECK(2 * (reported - exact) < in_view - exact);
}

}  // namespace gridcull::test
