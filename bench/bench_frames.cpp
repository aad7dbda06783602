// Whole frames of the engine on one thread. Counters are means over frames; the time is one pass over all
// frames of the scene divided by their number.
#include <benchmark/benchmark.h>

#include "gridcull/bench/hidden_movers.h"
#include "gridcull/grid/engine.h"
#include "gridcull/sim/replay.h"

namespace gridcull {
namespace {

GridOptions grid_of(const Scene& scene, TbvMode tbv, Hiding hiding = Hiding::voxel) {
  GridOptions options;
  options.hiding = hiding;
  options.dimension = scene.dimension;
  options.bounds = *scene.bounds;
  options.cell = *scene.cell;
  options.tbv = tbv;
  return options;
}

struct Sums {
  double total = 0, discretise = 0, traverse = 0, read = 0, pvs = 0, visited = 0, tbv_tests = 0, revealed = 0;
  double worst = 0;  // the dearest frame, microseconds
  int frames = 0;

  void add(const Answers& a) {
    total += a.stats.total_us;
    worst = std::max(worst, a.stats.total_us);
    discretise += a.stats.discretise_us;
    traverse += a.stats.traverse_us;
    read += static_cast<double>(a.stats.positions_read);
    for (const Answer& view : a.views) {
      pvs += static_cast<double>(view.visible.size());
      visited += static_cast<double>(view.work.cells_visited);
      tbv_tests += static_cast<double>(view.work.tbv_tests);
      revealed += static_cast<double>(view.work.tbv_revealed);
    }
    ++frames;
  }
  void report(benchmark::State& state) const {
    const auto mean = [&](double sum) { return sum / std::max(frames, 1); };
    state.counters["frame_us"] = mean(total);
    state.counters["discretise_us"] = mean(discretise);
    state.counters["traverse_us"] = mean(traverse);
    state.counters["read"] = mean(read);
    state.counters["pvs"] = mean(pvs);
    state.counters["visited"] = mean(visited);
    state.counters["tbv_tests"] = mean(tbv_tests);
    state.counters["revealed"] = mean(revealed);
    state.counters["worst_us"] = worst;
  }
};

/// 5,000 moving spheres, 60 degrees (DESIGN section 9, scene A). Arguments: cell in centimetres, TBV mode.
void spheres(benchmark::State& state) {
  Sums sums;
  for (auto _ : state) {
    GenerateOptions options;
    options.cell = static_cast<double>(state.range(0)) / 100.0;
    const auto generator = make_generator("spheres", options);
    GridEngine engine(grid_of(generator->scene(), static_cast<TbvMode>(state.range(1))));
    Replay replay(engine, generator->scene(), generator.get());
    double seconds = 0;
    // The first frame discretises everything: not a steady frame.
    for (bool first = true; replay.step(); first = false) {
      if (first) continue;
      sums.add(replay.answers());
      seconds += replay.answers().stats.total_us * 1e-6;
    }
    state.SetIterationTime(seconds);
  }
  sums.report(state);
}
BENCHMARK(spheres)
    ->ArgNames({"cell_cm", "tbv"})
    ->Args({200, static_cast<int>(TbvMode::solid)})
    ->Args({100, static_cast<int>(TbvMode::solid)})
    ->Args({200, static_cast<int>(TbvMode::off)})
    ->Args({100, static_cast<int>(TbvMode::off)})
    ->Args({200, static_cast<int>(TbvMode::hollow)})
    ->Args({100, static_cast<int>(TbvMode::hollow)})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

/// The same around a large box, with movers inside it (pull mode). Arguments: movers, cell in centimetres, method (0:
/// voxel, 1: silhouette).
void hidden_movers(benchmark::State& state) {
  Sums sums;
  for (auto _ : state) {
    HiddenMovers world(5000, static_cast<std::uint32_t>(state.range(0)), static_cast<double>(state.range(1)) / 100.0);
    GridEngine engine(grid_of(world.scene(), TbvMode::solid, static_cast<Hiding>(state.range(2))));
    world.fill(engine);
    engine.set_source(&world);
    std::vector<View> views;
    Answers answers;
    double time = 0, seconds = 0;
    for (bool first = true; world.step(views, time); first = false) {
      engine.query(time, views, answers);
      if (first) continue;
      sums.add(answers);
      seconds += answers.stats.total_us * 1e-6;
    }
    state.SetIterationTime(seconds);
  }
  sums.report(state);
}
BENCHMARK(hidden_movers)
    ->ArgNames({"movers", "cell_cm", "method"})
    ->ArgsProduct({{0, 100'000}, {200, 100}, {static_cast<int>(Hiding::voxel), static_cast<int>(Hiding::silhouette)}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gridcull

BENCHMARK_MAIN();
