// Which cars see which cars and people, in a simulation that runs: SUMO moves them, gridcull says who is in line of
// sight of every equipped vehicle, after every step. See run.sh.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "../live/run.h"
#include "traffic.h"

using namespace gridcull;

namespace {

/// Who is in line of sight of the first equipped vehicle.
void tell(const Traffic& traffic, const Frame& frame, const Answers& answers) {
  std::printf("%7.1f s  %zu vehicles, %zu people, %zu look", frame.time, traffic.vehicles(), traffic.people(),
              answers.views.size());
  if (!answers.views.empty()) {
    const Answer& first = answers.views.front();
    std::printf("; in line of sight of %s:%s", traffic.name(first.viewer).c_str(),
                named(first, traffic.scene(), [&](ObjectId id) { return traffic.name(id); }).c_str());
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  TrafficOptions traffic;
  LiveOptions live{.title = "SUMO and TraCI", .out = "out/sumo"};
  CLI::App app{"Who is in line of sight of whom in a running SUMO simulation"};
  app.option_defaults()->always_capture_default();
  app.add_option("--config", traffic.config, "the .sumocfg")->required()->check(CLI::ExistingFile);
  app.add_option("--begin", traffic.begin, "let SUMO run so far first, seconds")->check(CLI::Range(0.0, 1e6));
  app.add_option("--end", traffic.end, "seconds")->check(CLI::Range(0.0, 1e6));
  app.add_option("--step", traffic.step, "seconds")->check(CLI::Range(0.001, 10.0));
  app.add_option("--equipped", traffic.equipped, "vehicles that look")->check(CLI::Range(0, 1000000));
  app.add_option("--range", traffic.range, "how far, metres")->check(CLI::Range(0.1, 1e6));
  app.add_option("--server", live.server, "HOST:PORT of a gridcull serve; without it gridcull works in here");
  app.add_option("--out", live.out, "folder for scene, frames and answers");
  CLI11_PARSE(app, argc, argv);
  try {
    Traffic running(traffic);
    run_live(live, running.scene(), running,
             [&](const Frame& frame, const Answers& answers) { tell(running, frame, answers); });
  } catch (const std::exception& fault) {
    return told_fault("in_sight", fault);
  }
}
