// `gridcull import`: worlds recorded by others.
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/grid/openvdb_field.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/file_roles.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/import_geojson.h"
#include "gridcull/sim/import_mesh.h"
#include "gridcull/sim/import_petrack.h"
#include "gridcull/sim/import_sumo.h"
#include "gridcull/sim/import_volume.h"
#include "gridcull/sim/scene_json.h"
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

/// How a file's axes lie in the world.
struct PlaceOptions {
  std::vector<double> orientation{}, heading_degrees{}, move{};
};

struct MeshCommand {
  std::string out{};
  std::string split = "parts";
  PlaceOptions place{};
  MeshImportOptions mesh{};
};

struct GeojsonCommand {
  std::string out{};
  std::vector<double> origin{};
  GeojsonOptions geojson{};
};

struct VolumeCommand {
  PlaceOptions place{};
  std::vector<double> below{}, above{};
  VolumeImportOptions volume{};
};

struct PetrackCommand : Shared {
  PetrackOptions petrack{};
};

/// Writes what `import` (options and sink bound) gives.
template <class Import>
int write_import(const std::string& folder, int dimension, const std::vector<NamedFile>& inputs, Import&& import) {
  keep_apart(inputs, std::vector<NamedFile>{{"--out", folder + "/scene.json"}, {"--out", folder + "/frames.jsonl"}});
  WorldFiles files(folder, dimension);
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
  options.sumo.read_field = read_scalar_field;
  options.sumo.viewers = named_as_typed([&] { return parse_viewer_choice(options.viewers); });
  if (const auto& b = options.box; !b.empty()) options.sumo.box = {b[0], b[1], b[2], b[3]};
  if (const auto& size = options.vehicle_size; !size.empty()) options.sumo.vehicle_size = {size[0], size[1]};
  std::vector<NamedFile> inputs{{"--fcd", options.sumo.fcd}};
  if (!options.sumo.buildings.empty()) inputs.push_back({"--buildings", options.sumo.buildings});
  if (!options.sumo.statics.empty()) inputs.push_back({"--static", options.sumo.statics});
  const int dimension = named_as_typed([&] { return sumo_dimension(options.sumo); });
  return write_import(options.out, dimension, inputs,
                      [&](const FrameSink& sink) { return import_sumo(options.sumo, sink); });
}

MeshImportOptions::Split split_of(const std::string& name) {
  if (name == "whole") return MeshImportOptions::Split::whole;
  if (name == "groups") return MeshImportOptions::Split::groups;
  if (name == "parts") return MeshImportOptions::Split::parts;
  throw Error(ErrorCode::usage, "--split: expected parts, groups or whole, found '" + name + "'");
}

/// First the orientation, then the heading, then the move.
Pose pose_of(const PlaceOptions& options) {
  Pose out;
  if (const auto& q = options.orientation; !q.empty()) {
    try {
      out.orientation = normalised({q[0], q[1], q[2], q[3]});
    } catch (const Error&) {
      throw Error(ErrorCode::usage, "--orientation: expected a quaternion W,X,Y,Z that is not 0,0,0,0");
    }
  }
  if (const auto& turn = options.heading_degrees; !turn.empty()) {
    out.orientation = turn_about_z(radians_of(turn[0])) * out.orientation;
  }
  if (const auto& p = options.move; !p.empty()) out.position = {p[0], p[1], p[2]};
  return out;
}

/// A scene without movers, and one frame.
template <class Import>
int write_statics(const std::string& folder, const std::string& file, Import&& import) {
  keep_apart(std::vector<NamedFile>{{"FILE", file}},
             std::vector<NamedFile>{{"--out", folder + "/scene.json"}, {"--out", folder + "/frames.jsonl"}});
  const Imported imported = import();
  WorldFiles files(folder, imported.scene.dimension);
  files.write(Frame{});
  files.commit(imported.scene);
  for (const std::string& note : imported.notes) std::fprintf(stderr, "gridcull: note: %s\n", note.c_str());
  std::printf("%s -> %s\n", counted(imported.scene.objects.size(), "static object").c_str(),
              files.scene_path().c_str());
  return 0;
}

int import_mesh_file(MeshCommand options) {
  options.mesh.split = split_of(options.split);
  options.mesh.pose = pose_of(options.place);
  return write_statics(options.out, options.mesh.file, [&] { return import_mesh(options.mesh); });
}

int import_geojson_file(GeojsonCommand options) {
  if (const auto& p = options.origin; !p.empty()) {
    if (options.geojson.metres) throw Error(ErrorCode::usage, "--origin: metres have one already");
    if (!(std::fabs(p[0]) <= 180.0 && std::fabs(p[1]) <= 89.9)) {
      throw Error(ErrorCode::usage, "--origin: expected degrees of longitude and latitude");
    }
    options.geojson.origin = {p[0], p[1]};
  }
  return write_statics(options.out, options.geojson.file, [&] { return import_geojson(options.geojson); });
}

int import_volume_file(VolumeCommand options) {
  VolumeImportOptions& volume = options.volume;
  if (options.below.empty() == options.above.empty()) {
    throw Error(ErrorCode::usage, std::string("expected either --inside-below or --inside-above, found ") +
                                      (options.below.empty() ? "neither" : "both"));
  }
  volume.inside_below = !options.below.empty();
  volume.iso = volume.inside_below ? options.below[0] : options.above[0];
  volume.pose = pose_of(options.place);
  return write_statics(volume.out, volume.file, [&] { return import_volume(volume, read_scalar_field); });
}

int import_petrack_files(PetrackCommand options) {
  options.petrack.viewers = named_as_typed([&] { return parse_viewer_choice(options.viewers); });
  return write_import(options.out, 2, std::vector<NamedFile>{{"--trajectories", options.petrack.trajectories}},
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
  add_text(command, "--static", sumo.statics, "a file name", "scene whose static objects come first (a 3D one: 3D)")
      .type_name("SCENE");
  add_positive(command, "--height", sumo.height, positive_metres(),
               "makes the world 3D; of buildings whose polygon names no height")
      .type_name("METRES");
  add_positive(command, "--vehicle-height", sumo.vehicle_height, positive_metres(), "in 3D (default 1.5)")
      .type_name("METRES");
  add_positive(command, "--person-height", sumo.person_height, positive_metres(), "in 3D (default 1.75)")
      .type_name("METRES");
  add_positive(command, "--eye-height", sumo.eye_height, positive_metres(), "of drivers, in 3D (default 1.2)")
      .type_name("METRES");
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

void add_place(CLI::App& command, double& scale, PlaceOptions& place) {
  add_positive(command, "--scale", scale, positive_metres(), "metres a unit of the file (default 1)");
  add_numbers(command, "--orientation", place.orientation, 4, "four numbers W,X,Y,Z of magnitude at most 1e9",
              "turns the model's axes: a quaternion (y up: 0.7071,0.7071,0,0)")
      .type_name("W,X,Y,Z");
  add_numbers(command, "--heading-degrees", place.heading_degrees, 1, "a number of magnitude at most 1e9",
              "then turns it about +z, counter-clockwise")
      .type_name("DEGREES");
  add_numbers(command, "--move", place.move, 3, "three numbers X,Y,Z of magnitude at most 1e9", "then moves it, metres")
      .type_name("X,Y,Z");
}

void add_mesh(CLI::App& import, Action& action) {
  const auto options = std::make_shared<MeshCommand>();
  CLI::App& command = *import.add_subcommand("mesh", "A 3D model (OBJ, PLY, STL, glTF, 3DS) as static objects");
  MeshImportOptions& mesh = options->mesh;
  command.add_option("FILE", mesh.file, "the model")->required();
  add_text(command, "--out", options->out, "a folder", "folder for scene.json and frames.jsonl")
      .required()
      ->type_name("DIR");
  add_text(command, "--split", options->split, "parts, groups or whole",
           "an object for: parts that hang together (default), each group of the file, or the whole")
      .type_name("HOW");
  add_place(command, mesh.scale, options->place);
  add_whole(command, "--max-memory", mesh.max_memory, memory_bytes(), "refuse a model that takes more (default 4 GiB)");
  command.footer(
      "Example: a model of a town whose z axis points down\n"
      "  gridcull import mesh town.3ds --orientation 0,1,0,0 --out town");
  command.callback([options, &action] { action = [options] { return import_mesh_file(*options); }; });
}

void add_geojson(CLI::App& import, Action& action) {
  const auto options = std::make_shared<GeojsonCommand>();
  CLI::App& command = *import.add_subcommand("geojson", "Building footprints (GeoJSON) as static objects");
  GeojsonOptions& geojson = options->geojson;
  add_text(command, "FILE", geojson.file, "a file name", "the footprints (.geojson, .gz, or -)").required();
  add_text(command, "--out", options->out, "a folder", "folder for scene.json and frames.jsonl")
      .required()
      ->type_name("DIR");
  add_positive(command, "--height", geojson.height, positive_metres(),
               "a 3D scene; metres of buildings that say nothing of their height (without it a 2D scene)")
      .type_name("METRES");
  add_positive(command, "--level-height", geojson.level_height, positive_metres(),
               "metres a storey, for building:levels (default 3)")
      .type_name("METRES");
  command.add_flag("--metres", geojson.metres, "coordinates are metres already, not longitude and latitude");
  add_numbers(command, "--origin", options->origin, 2, "two numbers LON,LAT",
              "degrees that become (0, 0) (default: the middle of all)")
      .type_name("LON,LAT");
  command.footer(
      "Example: houses from a map, 8 m high where it does not say\n"
      "  gridcull import geojson houses.geojson --height 8 --out town");
  command.callback([options, &action] { action = [options] { return import_geojson_file(*options); }; });
}

void add_volume(CLI::App& import, Action& action) {
  const auto options = std::make_shared<VolumeCommand>();
  CLI::App& command =
      *import.add_subcommand("volume", "A level set or fog volume (.vdb) of any program as a static object");
  VolumeImportOptions& volume = options->volume;
  command.add_option("FILE", volume.file, "the volume")->required();
  add_numbers(command, "--inside-below", options->below, 1, "a number of magnitude at most 1e9",
              "what is less than this is inside (a level set: 0)")
      .type_name("ISO");
  add_numbers(command, "--inside-above", options->above, 1, "a number of magnitude at most 1e9",
              "what is greater than this is inside (a fog volume: 0.5)")
      .type_name("ISO");
  add_text(command, "--grid", volume.grid, "a grid's name", "which grid of the file (default: the first of floats)")
      .type_name("NAME");
  add_text(command, "--out", volume.out, "a folder", "folder for scene.json and frames.jsonl")
      .required()
      ->type_name("DIR");
  add_place(command, volume.scale, options->place);
  add_whole(command, "--max-memory", volume.max_memory, memory_bytes(),
            "refuse a volume that takes more (default 4 GiB)");
  command.footer(
      "The scene names FILE, which must stay where it is.\n\n"
      "Example: a level set, turned so that its y axis points up\n"
      "  gridcull import volume bunny.vdb --inside-below 0 --orientation 0.7071,0.7071,0,0 --out bunny");
  command.callback([options, &action] { action = [options] { return import_volume_file(*options); }; });
}

}  // namespace

void add_import_command(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand(
      "import", "Write a world from the files of SUMO or PeTrack, a 3D model, a volume, or footprints of buildings");
  command.require_subcommand(1);
  command.footer("Example:\n  gridcull import sumo --fcd fcd.xml.gz --buildings town.poly.xml --out town");
  add_sumo(command, action);
  add_petrack(command, action);
  add_mesh(command, action);
  add_geojson(command, action);
  add_volume(command, action);
}

}  // namespace gridcull
