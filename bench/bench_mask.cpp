// The coverage mask at 256 x 144 pixels, one thread: preparing it, covering, and testing shapes of about 30 x 30
// pixels. "hidden" tests go to the end: every pixel of the shape is covered, but no block is full; "seen" ones stop at
// once. The argument is the instruction set: 0 scalar, 1 AVX2, 2 AVX-512.
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "gridcull/core/view_volume.h"
#include "gridcull/grid/coverage_mask.h"

namespace {

using namespace gridcull;

constexpr std::size_t shape_count = 512;

struct Shape3 {
  Vec3 centre;
  double radius;
  std::vector<Vec3> rays;
  Vec3 low, high;
};

struct Stage {
  ViewVolume volume;
  CoverageMask mask;
  std::vector<Shape3> shapes;

  Stage(const View& view, InstructionSet set) : volume(view, 3), mask(set) { mask.begin(volume, 256); }

  /// Round things of 30 pixels, clear of the first columns of every block.
  void make_shapes(std::size_t corners) {
    std::mt19937_64 random(1);
    const auto in = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    const MaskFace& f = mask.face(0);
    for (std::size_t i = 0; i < shape_count; ++i) {
      const double x = 64.0 * static_cast<double>(random() % 4) + in(20, 46), y = in(18, f.window.height - 18.0);
      Shape3 s{20.0 * f.direction(x, y), 0, {}, {}, {}};
      s.radius = 15.0 / f.scale_x * 20.0;
      const double turn = in(0, 6);
      for (std::size_t k = 0; k < corners; ++k) {
        const double a = turn + 6.283185 * static_cast<double>(k) / static_cast<double>(corners);
        s.rays.push_back(20.0 * f.direction(x + 15 * std::cos(a), y + 15 * std::sin(a)));
      }
      s.low = s.centre - 0.6 * s.radius, s.high = s.centre + 0.6 * s.radius;
      shapes.push_back(s);
    }
  }

  /// Everything but the first two columns of every block.
  void cover_nearly_all() {
    mask.begin(volume, 256);
    for (int k = 0; k < mask.faces(); ++k) {
      const MaskFace& f = mask.face(k);
      const double h = f.window.height + 0.5;
      for (double x = 1.5; x < f.window.width; x += 64) {
        const Vec3 rays[4] = {f.direction(x, -0.5), f.direction(x + 62.7, -0.5), f.direction(x + 62.7, h),
                              f.direction(x, h)};
        mask.cover_convex(rays, 4);
      }
    }
  }
};

View pyramid() {
  View view;
  view.frustum = Frustum{std::numbers::pi / 3, 16.0 / 9.0};
  return view;
}

bool set_of(benchmark::State& state, InstructionSet& set) {
  set = static_cast<InstructionSet>(state.range(0));
  if (is_supported(set)) return true;
  state.SkipWithError("not on this machine");
  return false;
}

void begin(benchmark::State& state, const View& view) {
  InstructionSet set;
  if (!set_of(state, set)) return;
  Stage s(view, set);
  for (auto _ : state) {
    s.mask.begin(s.volume, 256);
    benchmark::DoNotOptimize(s.mask.full());
  }
}
void begin_pyramid(benchmark::State& state) { begin(state, pyramid()); }
void begin_all_round(benchmark::State& state) { begin(state, View{}); }

template <class Cover>
void cover(benchmark::State& state, std::size_t corners, const Cover& one) {
  InstructionSet set;
  if (!set_of(state, set)) return;
  Stage s(pyramid(), set);
  s.make_shapes(corners);
  std::size_t next = 0;
  for (auto _ : state) {
    if (next % 32 == 0) s.mask.begin(s.volume, 256);  // its time is small against 32 covers
    one(s.mask, s.shapes[next++ % shape_count]);
  }
}
void cover_ball(benchmark::State& state) {
  cover(state, 3, [](CoverageMask& m, const Shape3& s) { m.cover_ball(s.centre, s.radius); });
}
void cover_quad(benchmark::State& state) {
  cover(state, 4, [](CoverageMask& m, const Shape3& s) { m.cover_convex(s.rays.data(), 4); });
}
void cover_hexagon(benchmark::State& state) {
  cover(state, 6, [](CoverageMask& m, const Shape3& s) { m.cover_convex(s.rays.data(), 6); });
}

template <class Test>
void test(benchmark::State& state, bool hidden, std::size_t corners, const Test& one) {
  InstructionSet set;
  if (!set_of(state, set)) return;
  Stage s(pyramid(), set);
  s.make_shapes(corners);
  if (hidden) s.cover_nearly_all();
  std::size_t next = 0, open = 0;
  for (auto _ : state) open += one(s.mask, s.shapes[next++ % shape_count]) ? 1 : 0;
  state.counters["open"] = static_cast<double>(open) / static_cast<double>(state.iterations());
}
bool ball_is_open(const CoverageMask& m, const Shape3& s) { return m.open_ball(s.centre, s.radius); }
bool hexagon_is_open(const CoverageMask& m, const Shape3& s) { return m.open_convex(s.rays.data(), 6); }
bool box_is_open(const CoverageMask& m, const Shape3& s) { return m.open_box(s.low, s.high); }

void ball_hidden(benchmark::State& state) { test(state, true, 3, ball_is_open); }
void ball_seen(benchmark::State& state) { test(state, false, 3, ball_is_open); }
void hexagon_hidden(benchmark::State& state) { test(state, true, 6, hexagon_is_open); }
void hexagon_seen(benchmark::State& state) { test(state, false, 6, hexagon_is_open); }
void box_hidden(benchmark::State& state) { test(state, true, 3, box_is_open); }
void box_seen(benchmark::State& state) { test(state, false, 3, box_is_open); }

/// On the cube map: six faces to choose from.
void cube(benchmark::State& state, bool boxes) {
  InstructionSet set;
  if (!set_of(state, set)) return;
  Stage s(View{}, set);
  s.make_shapes(6);
  s.cover_nearly_all();
  std::size_t next = 0, open = 0;
  for (auto _ : state) {
    const Shape3& one = s.shapes[next++ % shape_count];
    open += boxes ? box_is_open(s.mask, one) : hexagon_is_open(s.mask, one);
  }
  state.counters["open"] = static_cast<double>(open) / static_cast<double>(state.iterations());
}
void cube_hexagon_hidden(benchmark::State& state) { cube(state, false); }
void cube_box_hidden(benchmark::State& state) { cube(state, true); }

}  // namespace

BENCHMARK(begin_pyramid)->DenseRange(0, 2);
BENCHMARK(begin_all_round)->Arg(2);
BENCHMARK(cover_ball)->DenseRange(0, 2);
BENCHMARK(cover_quad)->DenseRange(0, 2);
BENCHMARK(cover_hexagon)->DenseRange(0, 2);
BENCHMARK(ball_hidden)->DenseRange(0, 2);
BENCHMARK(ball_seen)->DenseRange(0, 2);
BENCHMARK(hexagon_hidden)->DenseRange(0, 2);
BENCHMARK(hexagon_seen)->DenseRange(0, 2);
BENCHMARK(box_hidden)->DenseRange(0, 2);
BENCHMARK(box_seen)->DenseRange(0, 2);
BENCHMARK(cube_hexagon_hidden)->DenseRange(0, 2);
BENCHMARK(cube_box_hidden)->DenseRange(0, 2);
BENCHMARK_MAIN();
