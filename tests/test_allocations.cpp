// A steady frame allocates nothing (core/culler.h), for every conservative method on every generated scene; nor do the
// indexes of temporal bounding volumes. A program of its own, because it replaces the global operator new.
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/shape.h"
#include "gridcull/grid/engine.h"
#include "gridcull/grid/tbv_matrix.h"
#include "gridcull/grid/tbv_octree.h"
#include "gridcull/grid/tbv_volume_tree.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"

namespace {

std::atomic<std::uint64_t> allocations{0};
std::atomic<long> left{-1};  // allocations until one fails; below 0: none does

void* counted(std::size_t bytes, std::size_t alignment) {
  ++allocations;
  if (left >= 0 && left-- == 0) throw std::bad_alloc();
  void* p = alignment > 16 ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
                           : std::malloc(bytes == 0 ? 1 : bytes);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace

void* operator new(std::size_t bytes) { return counted(bytes, 16); }
void* operator new[](std::size_t bytes) { return counted(bytes, 16); }
// The standard library's own goes past the one above under a sanitizer. (No tests run out of memory.)
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return counted(bytes, 16); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return counted(bytes, 16); }
void* operator new(std::size_t bytes, std::align_val_t to) { return counted(bytes, static_cast<std::size_t>(to)); }
void* operator new[](std::size_t bytes, std::align_val_t to) { return counted(bytes, static_cast<std::size_t>(to)); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace gridcull;

namespace {

/// The frames of a generator, forwards and backwards again and again: nobody jumps and every buffer soon has seen
/// its greatest load.
class ThereAndBack final : public FrameSource {
 public:
  explicit ThereAndBack(FrameSource& frames) {
    for (Frame frame; frames.next(frame);) frames_.push_back(frame);
  }
  std::size_t count() const { return frames_.size(); }

  bool next(Frame& frame) override {
    const std::size_t way = place_ % (2 * frames_.size() - 2);
    frame = frames_[way < frames_.size() ? way : 2 * frames_.size() - 2 - way];
    frame.time = static_cast<double>(place_++) / 30.0;
    return true;
  }

 private:
  std::vector<Frame> frames_;
  std::size_t place_ = 0;
};

/// Counts what query() allocates.
class Counted final : public Culler {
 public:
  explicit Counted(Culler& culler) : culler_(culler) {}

  const MethodInfo& info() const override { return culler_.info(); }
  void add(const Object& object) override { culler_.add(object); }
  void remove(ObjectId object) override { culler_.remove(object); }
  void move(ObjectId object, const Pose& pose) override { culler_.move(object, pose); }
  void set_source(PositionSource* source) override { culler_.set_source(source); }
  void announce_jump(ObjectId object) override { culler_.announce_jump(object); }
  void query(double time, std::span<const View> views, Answers& out) override {
    const std::uint64_t before = allocations;
    culler_.query(time, views, out);
    in_query += allocations - before;
  }

  std::uint64_t in_query = 0;

 private:
  Culler& culler_;
};

/// Volumes that go round, vanish and come back, and looks at every brick: allocations of the last laps.
template <class Index>
std::uint64_t last_laps(Index& index, const Lattice& lattice) {
  constexpr Slot slots = 500;
  constexpr int lap = 30;
  index.reserve(slots);
  const auto ball = [](Slot slot, int frame) {
    const int way = (static_cast<int>(slot) * 7 + frame) % lap;
    const double along = way < lap / 2 ? way : lap - way;
    return TbvBall{{6.0 + 1.8 * along, 4.0 + 0.06 * slot, 4.0 + slot % 13}, 0.5 + 0.2 * (slot % 9)};
  };
  std::uint64_t before = 0;
  for (int frame = 0; frame < 6 * lap; ++frame) {
    if (frame == 4 * lap) before = allocations;
    for (Slot slot = 0; slot < slots; ++slot) {
      const bool hidden = (static_cast<int>(slot) + frame) % lap > 3;
      if (hidden && index.holds(slot)) index.renew(slot, ball(slot, frame));
      if (hidden && !index.holds(slot)) index.insert(slot, ball(slot, frame));
      if (!hidden && index.holds(slot)) index.erase(slot);
    }
    for (std::size_t brick = 0; brick < lattice.brick_count(); brick += 5) {
      index.touching(
          brick, lattice.brick_cells(brick), [](Slot) { return true; }, [](Slot) {});
    }
  }
  return allocations - before;
}

/// Allocations of the last lap of several.
std::uint64_t last_lap(const MethodEntry& method, std::string_view scene_name, const std::string& tbv) {
  GenerateOptions options{.count = 100, .frames = 12};
  if (scene_name == "spheres") options.count = 600;
  if (scene_name == "city") options.blocks = 6, options.viewers = 2, options.range = 60.0;
  if (scene_name == "maze") options.count = 12;
  const auto generator = make_generator(scene_name, options);
  const Scene& scene = generator->scene();
  ThereAndBack frames(*generator);
  const auto culler = method.make({scene.dimension, *scene.bounds, *scene.cell, tbv, 1});
  Counted counted_culler(*culler);
  Replay replay(counted_culler, scene, &frames);
  const std::size_t lap = 2 * frames.count() - 2;
  for (std::size_t f = 0; f < 8 * lap; ++f) replay.step();
  counted_culler.in_query = 0;
  for (std::size_t f = 0; f < lap; ++f) replay.step();
  return counted_culler.in_query;
}

}  // namespace

TEST_CASE("indexes of temporal bounding volumes allocate nothing once they have seen their greatest load") {
  const Lattice lattice(3, Bounds{{0, 0, 0}, {40, 40, 20}}, 0.5, std::uint64_t{1} << 30);
  TbvMatrix matrix(lattice);
  TbvOctree octree(lattice);
  TbvVolumeTree tree(lattice);
  CHECK(last_laps(matrix, lattice) == 0);
  CHECK(last_laps(octree, lattice) == 0);
  CHECK(last_laps(tree, lattice) == 0);
}

TEST_CASE("the counter counts") {
  const std::uint64_t before = allocations;
  std::vector<int> v(100);
  CHECK(allocations == before + 1);
}

TEST_CASE("nor where some of what stands still is moved by hand in every frame") {
  GridEngine engine({.dimension = 2, .bounds = {{0, 0, 0}, {600, 600, 0}}, .cell = 2.0});
  const auto place = [](ObjectId id, double aside) {
    return Pose{{15.0 * static_cast<double>(id % 40) + 5.0 + aside, 15.0 * static_cast<double>(id / 40) + 5.0, 0.0}};
  };
  for (ObjectId id = 0; id < 1600; ++id) {
    engine.add({.id = id, .shape = Rectangle{{10, 8}}, .pose = place(id, 0.0), .is_static = true});
  }
  const std::vector<View> views{View{.viewer = 1, .pose = {{300, 297, 0}}}, View{.viewer = 2, .pose = {{12, 12, 0}}}};
  Answers answers;
  std::uint64_t in_query = 0;
  for (int frame = 0; frame < 300; ++frame) {
    for (ObjectId door = 0; door < 1600; door += 40) engine.move(door, place(door, frame % 2 == 0 ? 0.0 : 0.1));
    const std::uint64_t before = allocations;
    engine.query(0.1 * frame, views, answers);
    if (frame >= 100) in_query += allocations - before;
  }
  CHECK(in_query == 0);
}

TEST_CASE("who leaves the lattice while memory is out is seen when there is some again") {
  int failed = 0;
  for (const Hiding hiding : {Hiding::silhouette, Hiding::voxel}) {
    for (long at = 0; at < 4; ++at) {
      GridOptions options{.dimension = 2, .bounds = {{0, 0, 0}, {100, 100, 0}}, .cell = 1.0};
      options.hiding = hiding;
      GridEngine engine(options);
      engine.add({.id = 1, .shape = Disc{1.0}, .pose = {{90, 50, 0}}});
      const std::vector<View> views{View{.viewer = 1, .pose = {{50, 50, 0}}}};
      Answers answers;
      for (int frame = 0; frame < 4; ++frame) engine.query(frame, views, answers);
      engine.move(1, {{130, 50, 0}});
      left = at;
      try {
        engine.query(4.0, views, answers);
      } catch (const std::bad_alloc&) {
        ++failed;
      }
      left = -1;
      engine.query(5.0, views, answers);
      CHECK(answers.views[0].visible == std::vector<ObjectId>{1});
    }
  }
  MESSAGE(failed << " frames ran out of memory");
}

TEST_CASE("a steady frame allocates nothing") {
  int cases = 0;
  for (const std::string_view scene : generated_scenes()) {
    const int dimension = make_generator(scene, {})->scene().dimension;
    for (const MethodEntry& method : method_catalog()) {
      if (method.info.guarantee != Guarantee::conservative) continue;
      if (dimension == 2 ? !method.info.takes_2d : !method.info.takes_3d) continue;
      const bool has_volumes = method.options.find("--tbv") != std::string_view::npos;
      for (const std::string tbv : {"off", "solid", "hollow"}) {
        if (!has_volumes && tbv != "off") continue;
        CAPTURE(scene);
        CAPTURE(method.info.name);
        CAPTURE(tbv);
        CHECK(last_lap(method, scene, tbv) == 0);
        ++cases;
      }
    }
  }
  CHECK(cases > 0);
}
