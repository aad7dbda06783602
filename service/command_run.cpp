// `gridcull run`: replays a world and writes or sums up the answers.
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "gridcull/service/commands.h"
#include "gridcull/service/file_roles.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/picture_request.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/run_report.h"
#include "gridcull/service/world_options.h"
#include "gridcull/sim/in_view.h"
#include "gridcull/sim/pvs.h"
#include "gridcull/sim/stats.h"

namespace gridcull {
namespace {

struct RunOptions {
  WorldOptions world{};
  std::string out{};
  std::string stats{};
  std::vector<std::string> pictures{};
};

Stats complete(Stats stats, const WorldOptions& options, const PreparedWorld& world) {
  const Cell cells = world.lattice.cells();
  stats.method = options.method;
  stats.threads = options.threads;
  stats.cell = world.lattice.cell();
  stats.cells = {cells.x, cells.y};
  if (world.scene.dimension == 3) stats.cells.push_back(cells.z);
  stats.peak_memory_bytes = peak_memory_bytes();
  return stats;
}

std::vector<NamedFile> output_files(const RunOptions& options) {
  std::vector<NamedFile> files;
  if (!options.out.empty()) files.push_back({"--out", options.out});
  if (!options.stats.empty()) files.push_back({"--stats", options.stats});
  for (const std::string& text : options.pictures) files.push_back({"--picture", parse_picture_request(text).file});
  return files;
}

int run(const RunOptions& options) {
  keep_apart(input_files(options.world), output_files(options));
  const PreparedWorld world = prepare_world(options.world);
  const auto culler = make_culler(options.world, world);
  // Outputs are opened before the work: one that cannot be written is refused at once.
  std::optional<PvsWriter> out;
  if (!options.out.empty()) out.emplace(options.out, options.world.method, options.world.scene);
  Pictures pictures(options.pictures, options.world.scene);
  std::optional<TextWriter> stats_file;
  if (!options.stats.empty()) stats_file.emplace(options.stats);

  const auto start = std::chrono::steady_clock::now();
  const auto frames = open_frames(options.world, world);
  Replay replay(*culler, world.scene, frames.get(), feed_of(options.world));
  StatsCollector collector;
  {
    Progress progress("frames", expected_frames(options.world, world));
    while (pictures.step(replay, *culler, world.lattice)) {
      // Counted only where it is written: it tests every object for every viewer.
      collector.add(replay.answers(), stats_file ? count_in_view(replay.world(), replay.views()) : 0);
      if (out) out->write(replay.frame(), replay.time(), replay.answers());
      progress.update(replay.next_frame());
      stop_if_interrupted();
    }
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  pictures.check();
  const Stats stats = complete(collector.stats(), options.world, world);
  if (stats_file) stats_file->write(stats_text(stats));
  if (out) out->commit();
  if (stats_file) stats_file->commit();
  pictures.commit();
  if (!out && options.stats != "-") {
    std::fputs(run_table(options.world, world, culler->info(), stats, seconds).c_str(), stdout);
  }
  return 0;
}

}  // namespace

void add_run_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App& command = *app.add_subcommand("run", "Replay a world: who may be seen by whom, frame by frame");
  add_scene_options(command, options->world);
  add_method_options(command, options->world);
  add_text(command, "--out", options->out, "a file name",
           "write the answers (.jsonl, .jsonl.gz, or -); without it a short table is printed");
  add_text(command, "--stats", options->stats, "a file name", "write times and counts as JSON");
  command
      .add_option("--picture", options->pictures,
                  "draw what one viewer met in one frame, 2D with silhouette: exactly what it sees; may be repeated")
      ->type_name("FRAME:VIEWER:FILE.svg")
      ->allow_extra_args(false);
  command.footer(
      "Example: a town, replayed, with a picture of what viewer 400 sees in frame 50\n"
      "  gridcull make town --out town --viewers 10 --range 100\n"
      "  gridcull run town/scene.json --frames town/frames.jsonl --out pvs.jsonl --picture 50:400:view.svg");
  command.callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace gridcull
