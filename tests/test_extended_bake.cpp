// What a bake of extended projections promises: sets that no method of its own on demand contradicts, the same bytes at
// any number of threads and after a break, and files of another world refused. Whether baked answers miss anybody is
// asked of the exact reference in a small city.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/methods/baking.h"
#include "gridcull/methods/bytes.h"
#include "gridcull/methods/extended_bake.h"
#include "gridcull/methods/extended_baked.h"
#include "gridcull/methods/extended_projections.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

namespace fs = std::filesystem;

/// Four blocks about a crossing, and things that move between them.
struct Town {
  std::vector<Object> objects{};
  Bounds bounds{{0, 0, 0}, {48, 48, 12}};
  double heading = 0.0;  ///< of its streets, degrees

  explicit Town(double degrees = 0.0) : heading(degrees) {
    for (int i = 0; i < 9; ++i) {
      add(Cuboid{{10, 10, 10}}, {8.0 + 16 * (i % 3), 8.0 + 16 * (i / 3), 5}, true);
    }
    for (int i = 0; i < 9; ++i) add(Cuboid{{1, 1, 1}}, {0.5 + 15.9 * (i % 3), 0.5 + 15.9 * (i / 3), 0.5}, true);
    for (int i = 0; i < 14; ++i) add(Cuboid{{3, 1.5, 1.5}}, {3.4 * i, 16.0 * (i % 4) + 0.9, 0.8}, false);
    if (heading == 0.0) return;
    const Pose turn{{0, 0, 0}, turn_about_z(heading * std::numbers::pi / 180.0)};
    for (Object& o : objects) o.pose = compose(turn, o.pose);
    bounds = {{-24, 0, 0}, {42, 66, 12}};
  }
  void add(Shape shape, const Vec3& at, bool still) {
    Object o;
    o.id = 3 + 2 * static_cast<ObjectId>(objects.size());
    o.shape = std::move(shape);
    o.pose.position = at;
    o.is_static = still;
    objects.push_back(std::move(o));
  }
  ExtendedBakeOptions options(int threads) const {
    return {bounds,
            2.0,
            threads,
            {{"largest-cell", 4.0},
             {"halvings", 2.0},
             {"budget", 10.0},
             {"map", 64.0},
             {"gain", 1.0},
             {"heading", heading}}};
  }
};

class Quiet : public BakeListener {
 public:
  bool progress(double) override { return true; }
  void checkpoint(std::span<const std::byte>) override { FAIL("nobody stopped it"); }
};

/// Stops at the first moment after `steps`.
class Breaks final : public BakeListener {
 public:
  explicit Breaks(int steps) : steps_(steps) {}
  bool progress(double share) override {
    CHECK(share >= last_);
    last_ = share;
    return steps_-- > 0;
  }
  void checkpoint(std::span<const std::byte> state) override { state_.assign(state.begin(), state.end()); }
  const std::vector<std::byte>& state() const { return state_; }

 private:
  int steps_;
  double last_ = 0.0;
  std::vector<std::byte> state_{};
};

std::vector<std::byte> bake(const Town& town, int threads) {
  Quiet quiet;
  return bake_extended_projections(town.objects, town.options(threads), {}, quiet).value();
}

/// A file that goes away.
struct Baked {
  std::string path = (fs::temp_directory_path() / ("gridcull_extended_" + std::to_string(::getpid()))).string();
  explicit Baked(const Town& town) {
    write_baked(path, {"extended-projections", extended_baked_version, static_world_hash(town.objects)}, bake(town, 2));
  }
  ~Baked() { fs::remove(path); }
};

std::unique_ptr<Culler> make(const Town& town, const std::string& file) {
  auto culler = make_extended_projections({.bounds = town.bounds, .cell = 2.0, .resolution = 64, .baked = file});
  for (const Object& object : town.objects) culler->add(object);
  return culler;
}

View view_from(ViewerId viewer, const Vec3& eye) {
  View view;
  view.viewer = viewer;
  view.pose.position = eye;
  return view;
}

std::vector<View> random_views(const Town& town, int count) {
  Random random(5);
  std::vector<View> views;
  for (int i = 0; i < count; ++i) {
    Vec3 eye;
    for (int k = 0; k < 3; ++k) {
      eye[k] = random.uniform(town.bounds.min[k], town.bounds.max[k]);
      if (random.below(4) == 0) eye[k] = std::round(eye[k]);  // on cells' sides, walls and corners
    }
    if (random.below(2) == 0) eye.z = 1.0;
    views.push_back(view_from(static_cast<ViewerId>(i), eye));
  }
  return views;
}

/// How many objects of the town's queries were told, of how many; each that the exact reference sees must be.
std::array<std::size_t, 2> check_baked_answers(Town town) {
  const Baked baked(town);
  const auto culler = make(town, baked.path);
  const std::vector<View> views = random_views(town, 60);
  Answers answers;
  std::size_t told = 0, asked = 0;
  for (int frame = 0; frame < 3; ++frame) {
    for (Object& o : town.objects) {  // movers leave their regions, and some the world
      if (o.is_static || frame == 0) continue;
      o.pose.position.x += o.id % 3 == 0 ? 11.7 : -4.3;
      culler->move(o.id, o.pose);
    }
    culler->query(frame, views, answers);
    const ExactRays exact(town.objects, 64);
    for (std::size_t i = 0; i < views.size(); ++i) {
      const std::vector<ObjectId>& ids = answers.views[i].visible;
      told += ids.size();
      asked += town.objects.size();
      const ExactAnswer truth = exact.visible(views[i]);
      for (std::size_t k = 0; k < truth.visible.size(); ++k) {
        if (std::binary_search(ids.begin(), ids.end(), truth.visible[k])) continue;
        CAPTURE(frame);
        CAPTURE(i);
        CAPTURE(truth.visible[k]);
        CHECK(!exact.confirm(views[i], truth.visible[k], truth.witness[k]));
      }
    }
  }
  return {told, asked};
}

}  // namespace

TEST_CASE("a bake is the same at any number of threads, and after a break") {
  const Town town;
  const std::vector<std::byte> whole = bake(town, 1);
  CHECK(bake(town, 2) == whole);
  Breaks breaks(2);
  CHECK(!bake_extended_projections(town.objects, town.options(1), {}, breaks));
  REQUIRE(!breaks.state().empty());
  Quiet quiet;
  const auto gone_on = bake_extended_projections(town.objects, town.options(2), breaks.state(), quiet);
  REQUIRE(gone_on);
  CHECK(*gone_on == whole);
  Town other;
  other.objects.back().pose.position.z = 7.0;
  CHECK_THROWS_AS(bake_extended_projections(other.objects, other.options(1), breaks.state(), quiet), Error);
}

TEST_CASE("baked sets: written, read, described, and refused when altered") {
  const Town town;
  const std::vector<std::byte> payload = bake(town, 2);
  ByteReader in(payload, "test");
  const extended::BakedCells cells(in);
  in.finish();
  CHECK(cells.objects() == 18);
  ByteWriter again;
  cells.write(again);
  CHECK(std::equal(payload.begin(), payload.end(), again.span().begin(), again.span().end()));
  const extended::SetSizes sizes = cells.sizes();
  CHECK(sizes.leaves > 100);
  CHECK(sizes.delta < sizes.plain);
  CHECK(sizes.entries < sizes.leaves * (cells.objects() + cells.regions().size()) * 9 / 10);
  CHECK(describe_extended_projections(payload).find("viewing cells") != std::string::npos);
  for (std::size_t cut = 0; cut < payload.size(); cut += 97) {
    CHECK_THROWS_AS(describe_extended_projections(std::span(payload).first(cut)), Error);
  }
}

TEST_CASE("sets that nobody baked are refused, whatever their checksum") {
  const auto read = [](const extended::RootCells& root) {
    extended::CellLattice lattice;
    lattice.count = {1, 1, 1};
    extended::MotionRegions regions;
    regions.count = {2, 1, 1};
    ByteWriter out;
    extended::BakedCells(lattice, regions, 3, std::span(&root, 1)).write(out);
    const std::vector<std::byte> bytes = out.take();
    ByteReader in(bytes, "test");
    const extended::BakedCells cells(in);
    extended::LeafSet set;
    cells.decode(0, set);
    return set.visible;
  };
  extended::RootCells root{{extended::NodeKind::leaf}, {{{0, 2, 4}, {1, 2}}}};
  CHECK(read(root) == std::vector<std::uint32_t>{0, 2, 4});
  root.leaves[0].touching = {3};  // a region, which no viewer is inside of
  CHECK_THROWS_WITH_AS(read(root), doctest::Contains("more than the world"), Error);
  root.leaves[0] = {{0, 5}, {}};
  CHECK_THROWS_AS(read(root), Error);
}

TEST_CASE("baked answers hold whom the exact reference sees, and hide somebody") {
  if (!ExactRays::available()) {
    MESSAGE("skipped: built without Embree");
    return;
  }
  const auto [told, asked] = check_baked_answers(Town());
  MESSAGE("told " << told << " of " << asked);
  CHECK(4 * told < 3 * asked);
}

TEST_CASE("baked answers from cells that lie along streets aslant") {
  if (!ExactRays::available()) {
    MESSAGE("skipped: built without Embree");
    return;
  }
  const auto [told, asked] = check_baked_answers(Town(30.0));
  MESSAGE("told " << told << " of " << asked);
  CHECK(4 * told < 3 * asked);
}

TEST_CASE("baked: riders of static objects, viewers outside, and a world that changes") {
  Town town;
  const Baked baked(town);
  const auto culler = make(town, baked.path);
  Answers answers;
  View rider = view_from(1, {16, 8, 5});
  rider.rides = town.objects[1].id;  // the block beside it, static
  const std::vector<View> views{rider, view_from(2, {-500, 0, 1}), view_from(3, {16, 8, 5})};
  culler->query(0, views, answers);
  CHECK(answers.views[0].visible.size() == town.objects.size() - 1);
  CHECK(answers.views[1].visible.size() == town.objects.size());
  CHECK(answers.views[2].visible.size() < town.objects.size());
  // Without the blocks nothing hides anything.
  for (int i = 0; i < 9; ++i) culler->remove(town.objects[static_cast<std::size_t>(i)].id);
  culler->query(1, views, answers);
  CHECK(answers.views[2].visible.size() > town.objects.size() - 9 - 9);
  const std::size_t before = answers.views[2].visible.size();
  const auto fresh = make_extended_projections({.bounds = town.bounds, .cell = 2.0, .resolution = 64});
  for (std::size_t i = 9; i < town.objects.size(); ++i) fresh->add(town.objects[i]);
  fresh->query(0, views, answers);
  CHECK(answers.views[2].visible.size() == before);
}

TEST_CASE("a baked file of another world is refused, and nothing changes") {
  Town town;
  const Baked baked(town);
  town.objects[4].pose.position.x += 1e-9;
  const auto culler = make(town, baked.path);
  Answers answers;
  const std::vector<View> views{view_from(1, {16, 8, 5})};
  CHECK_THROWS_AS(culler->query(0, views, answers), Error);
  CHECK_THROWS_AS(culler->query(0, views, answers), Error);
}

}  // namespace gridcull::test
