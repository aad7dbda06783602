// Reaches into every installed part, so that each must link with all that it uses inside.
#include <cstdio>

#include <gridcull/core/exact.h>
#include <gridcull/grid/engine.h>
#include <gridcull/methods/catalog.h>
#include <gridcull/sim/generate.h>
#include <gridcull/sim/replay.h>
#include <gridcull/sim/stats.h>

int main() {
  using namespace gridcull;
  const auto town = make_generator("town", {.count = 9, .viewers = 2, .range = 50.0, .frames = 3});
  MethodOptions options;
  options.bounds = town->scene().bounds.value();
  options.cell = town->scene().cell.value();
  const auto culler = make_method(default_method(), options);
  Replay replay(*culler, town->scene(), town.get());
  StatsCollector collector;
  while (replay.step()) collector.add(replay.answers());
  if (ExactRays::available()) ExactRays rays({}, 1);
  std::printf("%llu frames, %llu queries\n", static_cast<unsigned long long>(collector.stats().frames),
              static_cast<unsigned long long>(collector.stats().queries));
}
