// Time of discretising one object (PreparedShape::cover) over shapes and cell sizes, one thread.
// The shapes of DESIGN 9: spheres of radius 0.5 - 3.5 m, discs of 1 - 6 m, cars, buildings.
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "gridcull/grid/cover.h"
#include "gridcull/grid/outline_cells.h"

namespace {

using namespace gridcull;

constexpr std::size_t object_count = 1024;

class Random {
 public:
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_{1};
};

struct Placed {
  PreparedShape shape;
  Pose pose;
};

/// `make(random)` gives shapes; poses lie in the world, turned about z or any way.
template <class Make>
std::vector<Placed> world(const Make& make, bool any_turn) {
  Random random;
  std::vector<Placed> objects;
  for (std::size_t i = 0; i < object_count; ++i) {
    Shape shape = make(random);
    const bool flat = dimension_of(shape) == 2;
    Pose pose{{random.in(4, 96), random.in(4, 96), flat ? 0.0 : random.in(4, 56)}, turn_about_z(random.in(-3, 3))};
    if (any_turn) {
      pose.orientation = normalised({random.in(-1, 1), random.in(-1, 1), random.in(-1, 1), random.in(0.1, 1)});
    }
    objects.push_back({PreparedShape(shape), pose});
  }
  return objects;
}

Lattice lattice_of(int dimension, const benchmark::State& state) {
  const double cell = static_cast<double>(state.range(0)) / 10.0;
  return Lattice(dimension, {{0, 0, 0}, {100, 100, 60}}, cell, std::uint64_t{4} << 30);
}

void run(benchmark::State& state, const Lattice& lattice, const std::vector<Placed>& objects) {
  CoverScratch scratch;
  Cover cover;
  std::size_t next = 0, bricks = 0;
  for (auto _ : state) {
    const Placed& o = objects[next++ % object_count];
    o.shape.cover(lattice, o.pose, scratch, cover);
    bricks += cover.bricks.size();
    benchmark::DoNotOptimize(cover.bricks.data());
  }
  state.counters["bricks"] = static_cast<double>(bricks) / static_cast<double>(state.iterations());
}

void spheres(benchmark::State& state) {
  run(state, lattice_of(3, state), world([](Random& r) { return Shape(Sphere{r.in(0.5, 3.5)}); }, false));
}
void cars_3d(benchmark::State& state) {
  run(state, lattice_of(3, state), world([](Random&) { return Shape(Cuboid{{4, 1.6, 1.8}}); }, false));
}
void boxes_any_turn(benchmark::State& state) {
  const auto make = [](Random& r) { return Shape(Cuboid{{r.in(1, 7), r.in(1, 7), r.in(1, 7)}}); };
  run(state, lattice_of(3, state), world(make, true));
}
void prisms_upright(benchmark::State& state) {
  const auto make = [](Random& r) {
    return Shape(Prism{{{-5, -4}, {5, -4}, {5, 0}, {0, 0}, {0, 4}, {-5, 4}}, r.in(6, 40)});
  };
  run(state, lattice_of(3, state), world(make, false));
}
void hulls(benchmark::State& state) {
  const auto make = [](Random& r) {
    Convex c;
    for (int i = 0; i < 12; ++i) c.vertices.push_back({r.in(-3, 3), r.in(-3, 3), r.in(-3, 3)});
    return Shape(c);
  };
  run(state, lattice_of(3, state), world(make, true));
}
void faces(benchmark::State& state) {
  const auto make = [](Random& r) {
    Faces f;
    for (int i = 0; i < 6; ++i) f.vertices.push_back({r.in(-3, 3), r.in(-3, 3), r.in(-3, 3)});
    f.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 5}};
    return Shape(f);
  };
  run(state, lattice_of(3, state), world(make, true));
}
void discs(benchmark::State& state) {
  run(state, lattice_of(2, state), world([](Random& r) { return Shape(Disc{r.in(1, 6)}); }, false));
}
void cars_2d(benchmark::State& state) {
  run(state, lattice_of(2, state), world([](Random&) { return Shape(Rectangle{{5.0, 1.8}}); }, false));
}
void buildings(benchmark::State& state) {
  const auto make = [](Random&) { return Shape(Polygon{{{-5, -4}, {5, -4}, {5, 0}, {0, 0}, {0, 4}, {-5, 4}}}); };
  run(state, lattice_of(2, state), world(make, false));
}

void circle_outlines(benchmark::State& state) {
  const Lattice lattice = lattice_of(2, state);
  const std::vector<Placed> objects = world([](Random& r) { return Shape(Disc{r.in(1, 4)}); }, false);
  Cover cover;
  std::size_t next = 0;
  for (auto _ : state) {
    const Placed& o = objects[next++ % object_count];
    cover_circle_outline(lattice, o.pose.position, o.shape.reach(), cover);
    benchmark::DoNotOptimize(cover.bricks.data());
  }
}
void cube_outlines(benchmark::State& state) {
  const Lattice lattice = lattice_of(3, state);
  const std::vector<Placed> objects = world([](Random& r) { return Shape(Sphere{r.in(1, 4)}); }, false);
  CubeOutline outline;
  std::size_t next = 0;
  for (auto _ : state) {
    const Placed& o = objects[next++ % object_count];
    cover_cube_outline(lattice, o.pose.position, o.shape.reach(), outline);
    benchmark::DoNotOptimize(outline.plane[0].data());
  }
}

}  // namespace

// The argument is the cell's side in tenths of a metre.
BENCHMARK(spheres)->Arg(20)->Arg(10)->Arg(5);
BENCHMARK(cars_3d)->Arg(20)->Arg(10);
BENCHMARK(boxes_any_turn)->Arg(20)->Arg(10);
BENCHMARK(prisms_upright)->Arg(20)->Arg(10);
BENCHMARK(hulls)->Arg(20)->Arg(10);
BENCHMARK(faces)->Arg(20)->Arg(10);
BENCHMARK(discs)->Arg(20)->Arg(10);
BENCHMARK(cars_2d)->Arg(20)->Arg(10);
BENCHMARK(buildings)->Arg(20)->Arg(10);
BENCHMARK(circle_outlines)->Arg(10);
BENCHMARK(cube_outlines)->Arg(10);
BENCHMARK_MAIN();
