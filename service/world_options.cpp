#include "gridcull/service/world_options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/grid/engine.h"
#include "gridcull/grid/openvdb_field.h"
#include "gridcull/grid/static_volume.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/resolution.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

StoreKind store_of(const WorldOptions& options, bool has_volume) {
  if (options.store.empty()) return has_volume ? StoreKind::openvdb : StoreKind::dense;
  for (const StoreKind kind : {StoreKind::dense, StoreKind::openvdb}) {
    if (options.store != name_of(kind)) continue;
    if (has_store(kind)) return kind;
    throw Error(ErrorCode::usage, "--store: this gridcull was built without OpenVDB");
  }
  throw option_error("--store", "dense or openvdb", options.store);
}

void check_options(const WorldOptions& options) {
  if (options.tbv != "off" && options.tbv != "solid" && options.tbv != "hollow" && options.tbv != "auto") {
    throw option_error("--tbv", "off, solid, hollow or auto", options.tbv);
  }
  if (!options.resolution.empty()) (void)parse_resolution(options.resolution);
  if (!options.bounds.empty()) (void)parse_bounds(options.bounds);
  (void)store_of(options, false);
  keep_apart(input_files(options), {});
}

LatticeChoice choose(const Scene& scene, const std::optional<double>& cell, const std::optional<Survey>& survey) {
  if (!survey) return choose_lattice(scene.dimension, {}, scene.bounds, cell);
  return choose_lattice(scene.dimension, survey->objects, scene.bounds, cell, survey->extent);
}

/// Below this the numbers of cells say nothing any more, and no cell size would be found that fits.
void refuse_tiny(double cell, const Bounds& bounds, const std::string& source) {
  if (bounds.empty()) return;
  double far = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    far = std::max({far, std::fabs(bounds.min[axis]), std::fabs(bounds.max[axis])});
  }
  if (cell < 0x1p-40 * far) {
    throw Error(ErrorCode::bad_scene, source + ": expected at least 1e-12 of the bounds' greatest coordinate, " +
                                          number_text(far) + " m, found " + number_text(cell));
  }
}

std::string cell_source(const WorldOptions& options, const Scene& scene) {
  if (options.cell) return "--cell";
  const std::string name = options.scene == "-" ? "standard input" : options.scene;
  return name + (scene.cell ? ": /grid/cell" : ": the cell size derived from it");
}

void check_static_memory(const WorldOptions& options, bool has_volume) {
  if (!options.static_memory) return;
  const std::string_view keeper = grid_engine_info(Hiding::voxel).name;
  if (options.method != keeper) {
    throw Error(ErrorCode::usage, "--static-memory: " + options.method + " keeps no cells of static objects (" +
                                      std::string(keeper) + " does)");
  }
  if (has_volume) return;
  throw Error(ErrorCode::usage,
              "--static-memory: expected a scene with a static_volume, as gridcull bake static writes, " +
                  ("found none in " + options.scene));
}

void give_cells(const WorldOptions& options, const StaticVolume& volume, MethodOptions& method) {
  if (options.static_memory) {
    method.static_tiles = open_static_volume_tiles(volume.path);
    method.static_memory = *options.static_memory;
    return;
  }
  method.static_cells = std::make_shared<const StaticCells>(read_static_volume(volume.path, options.max_memory));
}

}  // namespace

BoundKind parse_bounds(const std::string& name) {
  const std::optional<BoundKind> kind = find_bound_kind(name);
  if (!kind) throw option_error("--bounds", bound_kind_names(), name);
  return *kind;
}

Lattice make_lattice(int dimension, const Bounds& bounds, double cell, std::uint64_t max_memory,
                     const std::string& source, Room room) {
  refuse_tiny(cell, bounds, source);
  try {
    return Lattice(dimension, bounds, cell, max_memory, room);
  } catch (const Error& fault) {
    constexpr std::string_view field = "grid.cell";
    const std::string_view line = fault.what();
    if (!line.starts_with(field)) throw;
    throw Error(fault.code(), source + std::string(line.substr(field.size())));
  }
}

std::vector<NamedFile> input_files(const WorldOptions& options) {
  std::vector<NamedFile> files{{"SCENE", options.scene}};
  if (!options.frames.empty()) files.push_back({"--frames", options.frames});
  if (!options.baked.empty()) files.push_back({"--baked", options.baked});
  return files;
}

void add_scene_options(CLI::App& command, WorldOptions& options) {
  add_text(command, "SCENE", options.scene, "a file name", "scene file (.json, .json.gz, or - for standard input)")
      .required();
  add_text(command, "--frames", options.frames, "a file name",
           "frames file (.jsonl, .jsonl.gz, or -); without it one frame at time 0");
  add_positive(command, "--cell", options.cell, positive_metres(), "cell size in metres; overrides the scene's")
      .type_name("METRES");
  add_whole(command, "--max-memory", options.max_memory, memory_bytes(),
            "refuse grids, masks and maps that would take more than this (default 4 GiB)")
      .type_name("BYTES");
}

void add_method_options(CLI::App& command, WorldOptions& options) {
  add_text(command, "--method", options.method, "a method's name",
           "as listed by gridcull methods (default " + options.method + ")")
      .type_name("NAME");
  add_whole(command, "--threads", options.threads, {1, 256, "1 .. 256"},
            "1 .. 256 (default 1); answers do not depend on it");
  add_text(command, "--tbv", options.tbv, "off, solid, hollow or auto",
           "temporal bounding volumes of hidden movers: off, solid, hollow, or auto (default): solid, but off where "
           "silhouette in 3D is told of every move; silhouette takes hollow as solid")
      .type_name("KIND");
  add_text(command, "--resolution", options.resolution, "R or WxH",
           "silhouette in 3D: R pixels along a cube face's edge, 8 .. 8192, finer is tighter and slower (default "
           "512, 128 to 512 all round with a range, by that); depth-rays: WxH rays, each 1 .. 8192 (default 128x72)")
      .type_name("R|WxH");
  add_text(command, "--baked", options.baked, "a file name",
           "what gridcull bake wrote for this method and scene; without it five-d-tree bakes a little at the first "
           "frame, and extended-projections looks out of cells as viewers come to them")
      .type_name("FILE");
  add_positive(command, "--view-box", options.view_box, {1e9, "0 or more metres, at most 1e9", true},
               "five-d-tree: edge of the box about a viewpoint that its queries take (default 0)")
      .type_name("METRES");
  add_text(command, "--bounds", options.bounds, bound_kind_names(),
           "what objects are tested with: " + bound_kind_names() +
               ", in their own axes (default: silhouette in 3D the convex hull of small shapes and the box of "
               "others, depth-rays the box, frustum and shadow-frusta the shape itself)")
      .type_name("KIND");
  add_text(command, "--store", options.store, "dense or openvdb",
           "where the cells of static objects are kept: an array as big as the grid, or OpenVDB's trees, as big as the "
           "world's surface (default openvdb for a scene with a static volume, else dense)")
      .type_name("KIND");
  add_whole(
      command, "--static-memory", options.static_memory,
      {0, std::numeric_limits<std::uint64_t>::max(), "a whole number of bytes, 0 or more"},
      "voxel, for a scene with a static volume: keep no more than this of its cells, those nearest to the viewers; "
      "static objects whose cells are not kept hide nothing and are reported wherever they are in view")
      .type_name("BYTES");
  add_whole(command, "--occluders", options.occluders, {1, 64, "1 .. 64"},
            "shadow-frusta: used at most for each frame and viewer, 1 .. 64 (default 8)");
  add_text(
      command, "--criteria", options.criteria, "some of area-angle, sampled and recent",
      "shadow-frusta: what occluders are ranked by, some of area-angle (what they cover now), sampled (what they hide "
      "from nearby) and recent (what they hid in the viewer's last frame), with commas between (default all three)")
      .type_name("NAMES");
  add_text(command, "--unions", options.unions, "on or off",
           "shadow-frusta: whether two occluders may hide an object together (default on)");
  add_text(command, "--overlap", options.overlap, "planes or exact",
           "shadow-frusta: how boxes are held against a frustum, plane by plane (default) or exactly: more work, "
           "seldom another answer");
  command.add_flag("--pull", options.pull,
                   "the method asks for the positions that it needs, instead of being told all");
}

PreparedWorld prepare_world(const WorldOptions& options, bool always_survey) {
  check_options(options);
  return prepare_scene(options, read_scene(options.scene, options.max_memory, read_scalar_field), always_survey);
}

PreparedWorld prepare_scene(const WorldOptions& options, Scene scene, bool always_survey) {
  check_options(options);
  const std::optional<double> cell = options.cell ? options.cell : scene.cell;
  auto volume = open_static_volume(scene, options.scene, cell);
  check_static_memory(options, volume.has_value());
  const StoreKind store = store_of(options, volume.has_value());
  const Room room = store == StoreKind::dense ? Room::whole : Room::where_needed;
  std::optional<Survey> survey;
  if (volume) {
    if (always_survey) survey = survey_world(scene, options.frames);
    const Lattice lattice = lattice_of(volume->head, options.max_memory, room);
    LatticeChoice choice{bounds_of(volume->head), lattice.cell(), "those of " + volume->path,
                         "that of " + volume->path};
    return {std::move(scene), std::move(survey), std::move(choice), lattice, std::move(volume), store};
  }
  if (always_survey || !scene.bounds || !cell) survey = survey_world(scene, options.frames);
  if (cell) refuse_tiny(*cell, scene.bounds ? *scene.bounds : survey->extent, cell_source(options, scene));
  LatticeChoice choice = choose(scene, cell, survey);
  const Lattice lattice =
      make_lattice(scene.dimension, choice.bounds, choice.cell, options.max_memory, cell_source(options, scene), room);
  return {std::move(scene), std::move(survey), std::move(choice), lattice, {}, store};
}

MethodOptions method_options(const WorldOptions& options, const PreparedWorld& world) {
  MethodOptions method;
  method.dimension = world.scene.dimension;
  method.bounds = world.choice.bounds;
  method.cell = world.choice.cell;
  method.tbv = options.tbv;
  method.threads = options.threads;
  method.max_memory = options.max_memory;
  method.occluders = options.occluders;
  method.store = world.store;
  method.criteria = options.criteria;
  method.unions = options.unions;
  method.overlap = options.overlap;
  return method;
}

std::unique_ptr<Culler> make_culler(const WorldOptions& options, const PreparedWorld& world) {
  MethodOptions method = method_options(options, world);
  method.baked = options.baked;
  method.view_box = options.view_box;
  if (!options.resolution.empty()) {
    const Resolution resolution = parse_resolution(options.resolution);
    for (const MethodEntry& entry : method_catalog()) {
      if (entry.info.name == options.method) apply_resolution(resolution, entry, method);
    }
  }
  if (!options.bounds.empty()) method.bound = parse_bounds(options.bounds);
  // Only `voxel` asks for cells: the others take the objects themselves.
  if (world.volume && options.method == grid_engine_info(Hiding::voxel).name)
    give_cells(options, *world.volume, method);
  return make_method(options.method, method);
}

std::unique_ptr<FrameReader> open_frames(const WorldOptions& options, const PreparedWorld& world) {
  if (options.frames.empty()) return nullptr;
  return std::make_unique<FrameReader>(options.frames, world.scene.dimension, &stop_if_interrupted);
}

std::optional<std::uint64_t> expected_frames(const WorldOptions& options, const PreparedWorld& world) {
  if (options.frames.empty()) return 1;
  if (!Progress::is_seen() || reads_once(options.frames)) return std::nullopt;
  return world.survey ? world.survey->frames : count_frames(options.frames);
}

std::string lattice_text(const Lattice& lattice) {
  const Cell cells = lattice.cells();
  std::string text = std::to_string(cells.x) + " x " + std::to_string(cells.y);
  if (lattice.dimension() == 3) text += " x " + std::to_string(cells.z);
  return text + " cells of " + number_text(lattice.cell()) + " m";
}

}  // namespace gridcull
