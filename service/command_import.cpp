// `gridcull import`: worlds recorded by others.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "gridcull/service/commands.h"
#include "gridcull/service/file_roles.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
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
int write_import(const std::string& folder, const std::vector<NamedFile>& inputs, Import&& import) {
  keep_apart(inputs, std::vector<NamedFile>{{"--out", folder + "/scene.json"}, {"--out", folder + "/frames.jsonl"}});
  WorldFiles files(folder, 2);
  Imported imported;
  {
    Progress progress("frames", std::nullopt);
    std::uint64_t frames = 0;
    imported = named_as_typed([&] {
      return import([&](const Frame& frame) {
        files.write(frame);
        progress.update(++frames);
        stop_if_interrupted();
      });
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
  options.sumo.viewers = named_as_typed([&] { return parse_viewer_choice(options.viewers); });
  if (const auto& b = options.box; !b.empty()) options.sumo.box = {b[0], b[1], b[2], b[3]};
  if (const auto& size = options.vehicle_size; !size.empty()) options.sumo.vehicle_size = {size[0], size[1]};
  std::vector<NamedFile> inputs{{"--fcd", options.sumo.fcd}};
  if (!options.sumo.buildings.empty()) inputs.push_back({"--buildings", options.sumo.buildings});
  return write_import(options.out, inputs, [&](const FrameSink& sink) { return import_sumo(options.sumo, sink); });
}

int import_petrack_files(PetrackCommand options) {
  options.petrack.viewers = named_as_typed([&] { return parse_viewer_choice(options.viewers); });
  return write_import(options.out, std::vector<NamedFile>{{"--trajectories", options.petrack.trajectories}},
                      [&](const FrameSink& sink) { return import_petrack(options.petrack, sink); });
}

void add_shared(CLI::App& command, Shared& options) {
  add_text(command, "--out", options.out, "a folder", "folder for scene.json and frames.jsonl")
      .required()
      ->type_name("DIR");
  add_text(command, "--viewers", options.viewers, "all, a number or ids with commas",
           "who looks: all (default), a number to keep alive, or ids with commas (one id: with a comma after it)")
      .type_name("WHO");
}

void add_sumo(CLI::App& import, Action& action) {
  const auto options = std::make_shared<SumoCommand>();
  CLI::App& command = *import.add_subcommand("sumo", "SUMO's floating-car data and building polygons");
  SumoOptions& sumo = options->sumo;
  add_text(command, "--fcd", sumo.fcd, "a file name", "floating-car data (.xml, .xml.gz)").required();
  add_text(command, "--buildings", sumo.buildings, "a file name", "polygons (.poly.xml, may be .gz)");
  add_shared(command, *options);
  add_numbers(command, "--box", options->box, 4, "four numbers X0,Y0,X1,Y1 of magnitude at most 1e9",
              "only what lies in this box, metres")
      .type_name("X0,Y0,X1,Y1");
  add_positive(command, "--range", sumo.range, positive_metres(), "how far viewers see (default: no limit)")
      .type_name("METRES");
  add_numbers(command, "--vehicle-size", options->vehicle_size, 2, "two numbers L,W above 0 and at most 1e9",
              "length and width, metres (default 5.0,1.8)")
      .type_name("L,W");
  add_positive(command, "--person-radius", sumo.person_radius, positive_metres(), "metres (default 0.25)")
      .type_name("METRES");
  add_positive(command, "--max-speed", sumo.max_speed, {}, "of vehicles, m/s (default 60)");
  add_whole(command, "--every", sumo.every, {.low = 1, .expected = "a whole number, 1 or more"},
            "keep every Nth step (default 1)");
  command.footer(
      "Example: forty drivers of a simulated town, looking 150 m far\n"
      "  gridcull import sumo --fcd fcd.xml.gz --buildings town.poly.xml --out town --viewers 40 --range 150");
  command.callback([options, &action] { action = [options] { return import_sumo_files(*options); }; });
}

void add_petrack(CLI::App& import, Action& action) {
  const auto options = std::make_shared<PetrackCommand>();
  CLI::App& command = *import.add_subcommand("petrack", "Trajectories of pedestrians as PeTrack writes them");
  PetrackOptions& petrack = options->petrack;
  add_text(command, "--trajectories", petrack.trajectories, "a file name",
           "text file with rows id frame x y z (may be .gz)")
      .required();
  add_shared(command, *options);
  add_positive(command, "--radius", petrack.radius, positive_metres(), "of a person, metres (default 0.25)")
      .type_name("METRES");
  add_positive(command, "--range", petrack.range, positive_metres(), "how far viewers see (default 25)")
      .type_name("METRES");
  add_positive(command, "--fov-degrees", petrack.fov_degrees, {360.0, "degrees above 0 and at most 360"},
               "field of view (default 170)")
      .type_name("DEGREES");
  add_positive(command, "--max-speed", petrack.max_speed, {}, "m/s (default 5)");
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
