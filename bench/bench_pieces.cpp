// Time of the object side of `silhouette` for one object and viewer: placing, silhouettes, sections, outer outlines and
// slices of a car-like box, a building, a hull of 12 points and a ball.
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "gridcull/grid/ball_sections.h"
#include "gridcull/grid/occluder_pieces.h"
#include "gridcull/grid/outer_outline.h"
#include "gridcull/grid/piece_sections.h"

namespace {

using namespace gridcull;

struct Placed {
  Pose pose;
  Rotation rotation;
  Vec3 eye;
};

/// Objects turned about z, seen from 3 to 60 m.
std::vector<Placed> places() {
  std::mt19937_64 random(1);
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<Placed> out;
  for (int i = 0; i < 1024; ++i) {
    Placed p;
    p.pose = {{in(0, 300), in(0, 300), 1.0}, turn_about_z(in(-3, 3))};
    p.rotation = rotation_of(p.pose.orientation);
    const double angle = in(-3, 3), far = in(3, 60);
    p.eye = p.pose.position + Vec3(far * std::cos(angle), far * std::sin(angle), in(-0.5, 3));
    out.push_back(p);
  }
  return out;
}

Shape shape_of(std::int64_t kind) {
  if (kind == 0) return Cuboid{{4, 1.6, 1.8}};
  if (kind == 1) return Prism{{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}}, 12.0};
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  Convex convex;
  for (int i = 0; i < 12; ++i)
    convex.vertices.push_back(2.0 * glm::normalize(Vec3(normal(random), normal(random), normal(random))));
  return convex;
}

template <class F>
void run(benchmark::State& state, const F& f) {
  const std::vector<Placed> all = places();
  std::size_t next = 0;
  for (auto _ : state) {
    const Placed& p = all[next++ % all.size()];
    f(p, sight_frame(p.pose, p.rotation, p.eye));
  }
}

void frame(benchmark::State& state) {
  run(state, [](const Placed&, const SightFrame& f) { benchmark::DoNotOptimize(f.apex.x + f.blur); });
}

void silhouettes(benchmark::State& state) {
  const OccluderPieces made = make_occluder_pieces(shape_of(state.range(0)));
  Outline outline;
  run(state, [&](const Placed&, const SightFrame& f) {
    benchmark::DoNotOptimize(silhouette({made.pieces[0], f}, outline));
    benchmark::DoNotOptimize(outline.rays.data());
  });
}

void all_sections(benchmark::State& state) {
  const OccluderPieces made = make_occluder_pieces(shape_of(state.range(0)));
  std::array<Section, max_sections> nested;
  std::int64_t count = 0;
  run(state, [&](const Placed&, const SightFrame& f) { count += sections({made.pieces[0], f}, nested); });
  state.counters["sections"] = benchmark::Counter(static_cast<double>(count), benchmark::Counter::kAvgIterations);
}

void outer_outlines(benchmark::State& state) {
  const ConvexPiece hull = make_outer_hull(shape_of(state.range(0)));
  Outline outline;
  run(state, [&](const Placed&, const SightFrame& f) {
    benchmark::DoNotOptimize(outer_outline({hull, f}, outline));
    benchmark::DoNotOptimize(outline.rays.data());
  });
}

void outer_slices(benchmark::State& state) {
  const ConvexPiece hull = make_outer_hull(shape_of(state.range(0)));
  Outline outline;
  run(state, [&](const Placed& p, const SightFrame& f) {
    const double far = glm::distance(p.pose.position, p.eye);
    benchmark::DoNotOptimize(outer_slice({hull, f}, far - 0.5, far + 0.5, outline));
  });
}

void balls(benchmark::State& state) {
  std::array<BallSection, 3> out;
  run(state, [&](const Placed&, const SightFrame& f) {
    const double far = std::sqrt(glm::dot(f.origin, f.origin));
    benchmark::DoNotOptimize(ball_sections(far, 1.5, ball_fractions, out));
  });
}

BENCHMARK(frame);
BENCHMARK(silhouettes)->DenseRange(0, 2);
BENCHMARK(all_sections)->DenseRange(0, 2);
BENCHMARK(outer_outlines)->DenseRange(0, 2);
BENCHMARK(outer_slices)->DenseRange(0, 2);
BENCHMARK(balls);

}  // namespace

BENCHMARK_MAIN();
