#include "gridcull/service/world_options.h"

#include <cmath>
#include <utility>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/resolution.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

BoundKind parse_bounds(const std::string& name) {
  const std::optional<BoundKind> kind = find_bound_kind(name);
  if (!kind) throw option_error("--bounds", bound_kind_names(), name);
  return *kind;
}

void check_options(const WorldOptions& options) {
  if (options.cell && !(*options.cell > 0.0 && std::isfinite(*options.cell))) {
    throw option_error("--cell", "a size above 0", number_text(*options.cell));
  }
  if (options.threads < 1 || options.threads > 256) {
    throw option_error("--threads", "1 .. 256", std::to_string(options.threads));
  }
  if (options.tbv != "off" && options.tbv != "solid" && options.tbv != "hollow") {
    throw option_error("--tbv", "off, solid or hollow", options.tbv);
  }
  if (!options.resolution.empty()) (void)parse_resolution(options.resolution);
  if (!options.bounds.empty()) (void)parse_bounds(options.bounds);
  if (options.occluders < 1 || options.occluders > 64) {
    throw option_error("--occluders", "1 .. 64", std::to_string(options.occluders));
  }
  if (options.scene == "-" && options.frames == "-") {
    throw Error(ErrorCode::usage, "--frames -: standard input is the scene already");
  }
}

LatticeChoice choose(const Scene& scene, const std::optional<double>& cell, const std::optional<Survey>& survey) {
  if (!survey) return choose_lattice(scene.dimension, {}, scene.bounds, cell);
  return choose_lattice(scene.dimension, survey->objects, scene.bounds, cell, survey->extent);
}

}  // namespace

void add_scene_options(CLI::App& command, WorldOptions& options) {
  command.add_option("SCENE", options.scene, "scene file (.json, .json.gz, or - for standard input)")->required();
  command.add_option("--frames", options.frames,
                     "frames file (.jsonl, .jsonl.gz, or -); without it one frame at time 0");
  command.add_option("--cell", options.cell, "cell size in metres; overrides the scene's")->type_name("METRES");
  command.add_option("--max-memory", options.max_memory, "refuse grids larger than this (default 4 GiB)")
      ->type_name("BYTES");
}

void add_method_options(CLI::App& command, WorldOptions& options) {
  command.add_option("--method", options.method, "as listed by gridcull methods (default " + options.method + ")")
      ->type_name("NAME");
  command.add_option("--threads", options.threads, "1 .. 256 (default 1); answers do not depend on it")->type_name("N");
  command
      .add_option("--tbv", options.tbv,
                  "temporal bounding volumes of hidden movers: off, solid or hollow (default solid); silhouette takes "
                  "hollow as solid")
      ->type_name("KIND");
  command
      .add_option(
          "--resolution", options.resolution,
          "silhouette in 3D: R pixels along a cube face's edge, 8 .. 8192, finer is tighter and slower (default "
          "512, 256 all round with a range); depth-rays: WxH rays, each 1 .. 8192 (default 128x72)")
      ->type_name("R|WxH");
  command
      .add_option("--baked", options.baked,
                  "what gridcull bake wrote for this method and scene; without it the method "
                  "bakes a little at the first frame")
      ->type_name("FILE");
  command
      .add_option("--view-box", options.view_box,
                  "five-d-tree: edge of the box about a viewpoint that its queries take (default 0)")
      ->type_name("METRES");
  command
      .add_option("--bounds", options.bounds,
                  "what objects are tested with: " + bound_kind_names() +
                      ", in their own axes (default: silhouette in 3D the convex hull of small shapes and the box of "
                      "others, depth-rays the box, frustum the shape itself)")
      ->type_name("KIND");
  command
      .add_option("--occluders", options.occluders,
                  "shadow-frusta: used at most for each frame and viewer, 1 .. 64 (default 8)")
      ->type_name("N");
  command.add_flag("--pull", options.pull,
                   "the method asks for the positions that it needs, instead of being told all");
}

PreparedWorld prepare_world(const WorldOptions& options, bool always_survey) {
  check_options(options);
  Scene scene = read_scene(options.scene);
  const std::optional<double> cell = options.cell ? options.cell : scene.cell;
  std::optional<Survey> survey;
  if (always_survey || !scene.bounds || !cell) survey = survey_world(scene, options.frames);
  LatticeChoice choice = choose(scene, cell, survey);
  Lattice lattice(scene.dimension, choice.bounds, choice.cell, options.max_memory);
  return {std::move(scene), std::move(survey), std::move(choice), lattice};
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
  return make_method(options.method, method);
}

std::unique_ptr<FrameReader> open_frames(const WorldOptions& options, const PreparedWorld& world) {
  if (options.frames.empty()) return nullptr;
  return std::make_unique<FrameReader>(options.frames, world.scene.dimension, &stop_if_interrupted);
}

std::optional<std::uint64_t> expected_frames(const WorldOptions& options, const PreparedWorld& world) {
  if (options.frames.empty()) return 1;
  if (!Progress::is_seen() || options.frames == "-") return std::nullopt;
  return world.survey ? world.survey->frames : count_frames(options.frames);
}

std::string lattice_text(const Lattice& lattice) {
  const Cell cells = lattice.cells();
  std::string text = std::to_string(cells.x) + " x " + std::to_string(cells.y);
  if (lattice.dimension() == 3) text += " x " + std::to_string(cells.z);
  return text + " cells of " + number_text(lattice.cell()) + " m";
}

}  // namespace gridcull
