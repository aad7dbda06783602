// `gridcull import`: worlds recorded by others.
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/import_petrack.h"
#include "gridcull/sim/import_sumo.h"
#include "gridcull/sim/world_files.h"

namespace gridcull {
namespace {

struct Shared {
  std::string out{};
  std::string viewers = "all";
};

struct SumoCommand : Shared {
  SumoOptions sumo{};
  std::vector<double> box{};
  std::vector<double> vehicle_size{};
};

struct PetrackCommand : Shared {
  PetrackOptions petrack{};
};

/// Writes what `import` (options and sink bound) gives.
template <class Import>
int write_import(const std::string& folder, Import&& import) {
  WorldFiles files(folder, 2);
  Imported imported;
  {
    Progress progress("frames", std::nullopt);
    std::uint64_t frames = 0;
    imported = import([&](const Frame& frame) {
      files.write(frame);
      progress.update(++frames);
      stop_if_interrupted();
    });
  }
  files.commit(imported.scene);
  for (const std::string& note : imported.notes) std::fprintf(stderr, "gridcull: note: %s\n", note.c_str());
  std::printf("%s, %s, %s -> %s, %s\n", counted(imported.scene.objects.size(), "static object").c_str(),
              counted(imported.movers, "mover").c_str(), counted(imported.frames, "frame").c_str(),
              files.scene_path().c_str(), files.frames_path().c_str());
  return 0;
}

int import_sumo_files(SumoCommand options) {
  options.sumo.viewers = parse_viewer_choice(options.viewers);
  if (!options.box.empty()) {
    if (options.box.size() != 4) throw option_error("--box", "x0,y0,x1,y1", counted(options.box.size(), "number"));
    options.sumo.box = {options.box[0], options.box[1], options.box[2], options.box[3]};
  }
  if (!options.vehicle_size.empty()) {
    if (options.vehicle_size.size() != 2) {
      throw option_error("--vehicle-size", "LENGTH,WIDTH", counted(options.vehicle_size.size(), "number"));
    }
    options.sumo.vehicle_size = {options.vehicle_size[0], options.vehicle_size[1]};
  }
  return write_import(options.out, [&](const FrameSink& sink) { return import_sumo(options.sumo, sink); });
}

int import_petrack_files(PetrackCommand options) {
  options.petrack.viewers = parse_viewer_choice(options.viewers);
  return write_import(options.out, [&](const FrameSink& sink) { return import_petrack(options.petrack, sink); });
}

void add_shared(CLI::App& command, Shared& options) {
  command.add_option("--out", options.out, "folder for scene.json and frames.jsonl")->required()->type_name("DIR");
  command
      .add_option(
          "--viewers", options.viewers,
          "who looks: all (default), a number to keep alive, or ids with commas (one id: with a comma after it)")
      ->type_name("WHO");
}

void add_sumo(CLI::App& import, Action& action) {
  const auto options = std::make_shared<SumoCommand>();
  CLI::App& command = *import.add_subcommand("sumo", "SUMO's floating-car data and building polygons");
  SumoOptions& sumo = options->sumo;
  command.add_option("--fcd", sumo.fcd, "floating-car data (.xml, .xml.gz)")->required();
  command.add_option("--buildings", sumo.buildings, "polygons (.poly.xml, may be .gz)");
  add_shared(command, *options);
  command.add_option("--box", options->box, "only what lies in this box, metres")
      ->delimiter(',')
      ->type_name("X0,Y0,X1,Y1");
  command.add_option("--range", sumo.range, "how far viewers see (default: no limit)")->type_name("METRES");
  command.add_option("--vehicle-size", options->vehicle_size, "length and width, metres (default 5.0,1.8)")
      ->delimiter(',')
      ->type_name("L,W");
  command.add_option("--person-radius", sumo.person_radius, "metres (default 0.25)");
  command.add_option("--max-speed", sumo.max_speed, "of vehicles, m/s (default 60)");
  command.add_option("--every", sumo.every, "keep every Nth step (default 1)")->type_name("N");
  command.footer(
      "Example: forty drivers of a simulated town, looking 150 m far\n"
      "  gridcull import sumo --fcd fcd.xml.gz --buildings town.poly.xml --out town --viewers 40 --range 150");
  command.callback([options, &action] { action = [options] { return import_sumo_files(*options); }; });
}

void add_petrack(CLI::App& import, Action& action) {
  const auto options = std::make_shared<PetrackCommand>();
  CLI::App& command = *import.add_subcommand("petrack", "Trajectories of pedestrians as PeTrack writes them");
  PetrackOptions& petrack = options->petrack;
  command.add_option("--trajectories", petrack.trajectories, "text file with rows id frame x y z (may be .gz)")
      ->required();
  add_shared(command, *options);
  command.add_option("--radius", petrack.radius, "of a person, metres (default 0.25)");
  command.add_option("--range", petrack.range, "how far viewers see (default 25)")->type_name("METRES");
  command.add_option("--fov-degrees", petrack.fov_degrees, "field of view (default 170)")->type_name("DEGREES");
  command.add_option("--max-speed", petrack.max_speed, "m/s (default 5)");
  command.footer(
      "Example: ten people in a bottleneck\n"
      "  gridcull import petrack --trajectories 040_c_56_h.txt --out bottleneck --viewers 10");
  command.callback([options, &action] { action = [options] { return import_petrack_files(*options); }; });
}

}  // namespace

void add_import_command(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("import", "Write a world from the files of SUMO or PeTrack");
  command.require_subcommand(1);
  command.footer("Example:\n  gridcull import sumo --fcd fcd.xml.gz --buildings town.poly.xml --out town");
  add_sumo(command, action);
  add_petrack(command, action);
}

}  // namespace gridcull
