// Which people see which people, in a building that a thousand of them walk through: DetourCrowd steers them, gridcull
// says after every step whom each of them may see. See run.sh.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "../live/run.h"
#include "crowd.h"

using namespace gridcull;

int main(int argc, char** argv) {
  CrowdOptions crowd;
  LiveOptions live{.title = "DetourCrowd", .out = "out/crowd"};
  int corridors = 4, rooms = 12;
  CLI::App app{"Who sees whom in a building that a crowd walks through"};
  app.option_defaults()->always_capture_default();
  app.add_option("--people", crowd.people, "in the building")->check(CLI::Range(1, 20000));
  app.add_option("--viewers", crowd.viewers, "of them who look")->check(CLI::Range(0, 20000));
  app.add_option("--fov", crowd.fov, "field of view, degrees")->check(CLI::Range(1.0, 360.0));
  app.add_option("--range", crowd.range, "how far they see, metres")->check(CLI::Range(0.1, 1e6));
  app.add_option("--seconds", crowd.seconds, "simulated")->check(CLI::Range(0.0, 1e6));
  app.add_option("--step", crowd.step, "seconds")->check(CLI::Range(0.001, 1.0));
  app.add_option("--corridors", corridors, "one above the other on the plan")->check(CLI::Range(1, 50));
  app.add_option("--rooms", rooms, "on each side of a corridor")->check(CLI::Range(1, 100));
  app.add_option("--server", live.server, "HOST:PORT of a gridcull serve; without it gridcull works in here");
  app.add_option("--out", live.out, "folder for scene, frames and answers");
  CLI11_PARSE(app, argc, argv);
  try {
    Crowd running(make_floor_plan(corridors, rooms), crowd);
    run_live(live, running.scene(), running, [&](const Frame& frame, const Answers& answers) {
      std::printf("%6.1f s  %zu look", frame.time, answers.views.size());
      if (!answers.views.empty()) {
        const Answer& first = answers.views.front();
        std::printf("; %s may see%s", running.name(first.viewer).c_str(),
                    named(first, running.scene(), [&](ObjectId id) { return running.name(id); }).c_str());
      }
      std::printf("\n");
    });
  } catch (const std::exception& fault) {
    return told_fault("in_the_building", fault);
  }
}
