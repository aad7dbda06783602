// Figure 4 of Hudson et al. 1997: the share of what view-frustum culling lets through that shadow frusta cull, against
// the number of occluders; for each way to rank occluders and without unions of two.
//
//   gridcull_bench_shadow_frusta [FRAMES [RUNS]]        tables for the city and for spheres
//
// Shares and tests do not depend on the machine; times (microseconds a query, the least of RUNS runs' means) do.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "gridcull/methods/frustum.h"
#include "gridcull/methods/shadow_frusta.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"

namespace {

using namespace gridcull;

struct Setting {
  const char* name;
  OccluderWeights weights;
  bool unions = true, exact = false;
};

struct Result {
  double reported = 0.0, plane_tests = 0.0, boxes = 0.0, microseconds = 0.0, queries = 0.0;
};

Result run(Culler& culler, const std::string& scene, const GenerateOptions& options) {
  const auto generator = make_generator(scene, options);
  Replay replay(culler, generator->scene(), generator.get(), Feed::push);
  Result out;
  bool first = true;
  while (replay.step()) {
    for (const Answer& answer : replay.answers().views) {
      out.queries += 1.0;
      out.reported += static_cast<double>(answer.visible.size());
      out.plane_tests += static_cast<double>(answer.work.rasters);
      out.boxes += static_cast<double>(answer.work.cells_visited + answer.work.object_tests);
    }
    if (!first) out.microseconds += replay.answers().stats.total_us;
    first = false;
  }
  for (double* sum : {&out.reported, &out.plane_tests, &out.boxes, &out.microseconds}) *sum /= out.queries;
  return out;
}

void table(const std::string& scene, const GenerateOptions& options, int runs) {
  const Result all = run(*make_frustum_culler(3), scene, options);
  std::printf("\n%s: %.1f objects a frame pass view-frustum culling\n", scene.c_str(), all.reported);
  std::printf("%-28s %9s %9s %12s %9s %9s\n", "ranked by", "occluders", "culled", "plane tests", "boxes", "us");
  for (const Setting& setting :
       {Setting{"area-angle", {1, 0, 0}}, Setting{"sampled", {0, 1, 0}}, Setting{"area-angle, sampled", {1, 1, 0}},
        Setting{"area-angle, recent", {1, 0, 1}}, Setting{"all three", {1, 1, 1}},
        Setting{"all three, without unions", {1, 1, 1}, false}, Setting{"all three, exact", {1, 1, 1}, true, true}}) {
    for (const int count : {1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 24, 32, 48, 64}) {
      Result least;
      least.microseconds = std::numeric_limits<double>::infinity();
      for (int i = 0; i < runs; ++i) {
        const auto culler = make_shadow_frusta({.dimension = 3,
                                                .occluders = count,
                                                .unions = setting.unions,
                                                .exact = setting.exact,
                                                .weights = setting.weights});
        const Result result = run(*culler, scene, options);
        if (result.microseconds < least.microseconds) least = result;
      }
      std::printf("%-28s %9d %8.1f%% %12.0f %9.0f %9.1f\n", setting.name, count,
                  100.0 * (1.0 - least.reported / all.reported), least.plane_tests, least.boxes, least.microseconds);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const auto frames = static_cast<std::uint32_t>(argc > 1 ? std::max(2, std::atoi(argv[1])) : 100);
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 3;
  GenerateOptions city, spheres;
  city.blocks = 20, city.count = 1000, city.frames = frames;
  spheres.count = 5000, spheres.frames = frames;
  table("city", city, runs);
  table("spheres", spheres, runs);
  return 0;
}
