// Static worlds: how fast a viewer's window is copied out of the stores, and what an edit costs against building the
// world again. Needs OpenVDB for its part, and NanoVDB for the comparison of accessors.
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "gridcull/grid/cover.h"
#include "gridcull/grid/engine.h"
#include "gridcull/grid/identifier_matrix.h"
#include "window_readers.h"

namespace {

using namespace gridcull;

constexpr double pitch = 20.0;

/// A town of houses of 10 x 8 m, `side` x `side` of them, up to 30 m high.
std::vector<Object> town(int side) {
  std::mt19937_64 random(10);
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<Object> houses;
  for (int i = 0; i < side * side; ++i) {
    const double height = in(4, 30);
    Object house;
    house.id = static_cast<ObjectId>(i);
    house.shape = Cuboid{{10, 8, height}};
    house.is_static = true;
    house.pose.position = {(i % side + 0.5) * pitch + in(-2, 2), (i / side + 0.5) * pitch + in(-2, 2), 0.5 * height};
    house.pose.orientation = turn_about_z(in(-0.3, 0.3));
    houses.push_back(house);
  }
  return houses;
}

Bounds bounds_of(int side) { return {{0, 0, -31.0 / 32.0}, {pitch * side, pitch * side, 63}}; }

constexpr std::uint64_t plenty = std::uint64_t{16} << 30;

/// The town's O_s in a store.
std::unique_ptr<StaticStore> filled(StoreKind kind, const Lattice& lattice, int side) {
  auto store = make_static_store(kind, lattice);
  CoverScratch scratch;
  Cover cover;
  for (const Object& house : town(side)) {
    PreparedShape(house.shape).cover(lattice, house.pose, scratch, cover);
    for (const BrickCover& brick : cover.bricks) {
      if (brick.opaque != 0) store->set_opaque(brick.brick, store->opaque(brick.brick) | brick.opaque);
    }
  }
  return store;
}

/// Copies of O_s about viewers in the town: 400 x 400 x 64 m.
void window(benchmark::State& state, const WindowReader& reader, const Lattice& lattice) {
  std::mt19937_64 random(3);
  const Cell bricks = lattice.bricks();
  const std::int64_t edge = 100;
  std::vector<std::uint64_t> row(edge);
  std::uint64_t sum = 0;
  for (auto _ : state) {
    const auto x = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(bricks.x - edge));
    const auto y = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(bricks.y - edge));
    for (std::int64_t z = 0; z < bricks.z; ++z) {
      for (std::int64_t dy = 0; dy < edge; ++dy) {
        std::fill(row.begin(), row.end(), 0);
        reader.add_row({x, y + dy, z}, row);
        for (const std::uint64_t word : row) sum += word;
      }
    }
  }
  benchmark::DoNotOptimize(sum);
  state.counters["bricks"] = static_cast<double>(edge * edge * bricks.z);
  state.counters["sum"] = static_cast<double>(sum % 1000);
}

void windows(benchmark::State& state, std::unique_ptr<WindowReader> (*make)(const Lattice&, const StaticStore&),
             StoreKind kind) {
  constexpr int side = 60;
  const Lattice lattice(3, bounds_of(side), 1.0, plenty);
  const auto store = filled(kind, lattice, side);
  const auto reader = make(lattice, *store);
  window(state, *reader, lattice);
}

GridOptions options(Hiding hiding, StoreKind store, int side) {
  GridOptions o;
  o.dimension = 3;
  o.bounds = bounds_of(side);
  o.hiding = hiding;
  o.store = store;
  o.max_memory = plenty;
  return o;
}

View nobody_near(double) {
  View view;
  view.viewer = 1;
  view.pose.position = {1, 1, 60};
  view.range = 2;
  return view;
}

/// A house is moved, taken away and put back, a frame each.
void edits(benchmark::State& state, Hiding hiding, StoreKind store) {
  const auto side = static_cast<int>(state.range(0));
  GridEngine engine(options(hiding, store, side));
  const std::vector<Object> houses = town(side);
  for (const Object& house : houses) engine.add(house);
  Answers answers;
  double time = 0;
  const std::vector<View> views{nobody_near(0)};
  engine.query(time, views, answers);
  std::size_t next = 0;
  for (auto _ : state) {
    const Object& house = houses[(next += 7919) % houses.size()];
    Pose other = house.pose;
    other.position.x += 1.5;
    engine.move(house.id, other);
    engine.query(++time, views, answers);
    engine.remove(house.id);
    engine.query(++time, views, answers);
    engine.add(house);
    engine.query(++time, views, answers);
  }
  state.counters["houses"] = static_cast<double>(houses.size());
}

/// The whole town, first frame included: what an edit would cost if the world were built again.
void rebuild(benchmark::State& state, Hiding hiding, StoreKind store) {
  const auto side = static_cast<int>(state.range(0));
  const std::vector<Object> houses = town(side);
  Answers answers;
  const std::vector<View> views{nobody_near(0)};
  for (auto _ : state) {
    GridEngine engine(options(hiding, store, side));
    for (const Object& house : houses) engine.add(house);
    engine.query(0, views, answers);
  }
  state.counters["houses"] = static_cast<double>(houses.size());
}

void name_all() {
  for (const StoreKind kind : {StoreKind::dense, StoreKind::openvdb}) {
    if (!has_store(kind)) continue;
    const std::string store(name_of(kind));
    benchmark::RegisterBenchmark(("window/" + store).c_str(), windows, make_store_reader, kind)
        ->Unit(benchmark::kMicrosecond);
    for (const auto& [hiding, name] :
         {std::pair(Hiding::voxel, "voxel"), std::pair(Hiding::silhouette, "silhouette")}) {
      if (hiding == Hiding::silhouette && kind != StoreKind::dense) continue;
      const std::string tail = std::string("/") + name + (hiding == Hiding::voxel ? "/" + store : "");
      for (const int side : {30, 100, 224}) {
        benchmark::RegisterBenchmark(("three_edits" + tail).c_str(), edits, hiding, kind)
            ->Arg(side)
            ->Unit(benchmark::kMicrosecond);
        benchmark::RegisterBenchmark(("rebuild" + tail).c_str(), rebuild, hiding, kind)
            ->Arg(side)
            ->Unit(benchmark::kMicrosecond);
      }
    }
  }
  for (const NamedReader& reader : tree_readers()) {
    benchmark::RegisterBenchmark((std::string("window/") + reader.name).c_str(), windows, reader.make,
                                 StoreKind::openvdb)
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  name_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
