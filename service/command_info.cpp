// `gridcull info`: what is in a scene and what the grid makes of it.
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "gridcull/grid/engine.h"
#include "gridcull/grid/static_volume.h"
#include "gridcull/service/advice_run.h"
#include "gridcull/service/advice_text.h"
#include "gridcull/service/cell_less.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/table.h"
#include "gridcull/service/text.h"
#include "gridcull/service/world_options.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

constexpr std::size_t listed = 12;  // names printed of a longer list

struct InfoOptions {
  WorldOptions world{};
  bool advise = false;
  AdviceRequest advice{};
};

std::string contents(const std::vector<Object>& objects) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> shapes;  // static, moving
  std::size_t occluders = 0;
  for (const Object& object : objects) {
    auto& counts = shapes[std::string(name_of(object.shape))];
    ++(object.is_static ? counts.first : counts.second);
    if (object.occluder) ++occluders;
  }
  std::string text =
      row("objects", std::to_string(objects.size()) + " over all frames, " + counted(occluders, "occluder"));
  for (const auto& [name, counts] : shapes) {
    text += row("  " + name, std::to_string(counts.first) + " static, " + std::to_string(counts.second) + " moving");
  }
  return text;
}

std::string frames_text(const WorldOptions& options, const Survey& survey) {
  if (options.frames.empty()) return "no file: one at time 0";
  if (reads_once(options.frames)) return "standard input or a pipe: not looked at";
  return std::to_string(survey.frames) + ", time " + number_text(survey.first_time) + " .. " +
         number_text(survey.last_time) + " s, " + counted(survey.moves, "move") + ", " +
         counted(survey.removals, "removal");
}

/// Occluders that hide nothing from `voxel` on this grid.
std::string cell_less(const PreparedWorld& world) {
  const CellLess found = find_cell_less({&world.lattice, 1}, world.survey->objects);
  const std::vector<ObjectId>& without = found.without[0];
  std::string text = counted(without.size(), "occluder holds", "occluders hold") + " no whole cell";
  if (!without.empty()) text += ": " + ids_text(without, world.scene, listed);
  if (!found.thin.empty()) {
    text += "; " + std::to_string(found.thin.size()) + " without an interior never " +
            (found.thin.size() == 1 ? "does: " : "do: ") + ids_text(found.thin, world.scene, listed);
  }
  return text;
}

std::string memory_text(const GridEngine& engine, std::size_t objects) {
  const MemoryUse use = engine.memory();
  const auto cells = static_cast<double>(engine.lattice().cell_count());
  std::string text = row("memory", bytes_text(static_cast<double>(use.total())) + " after frame 0, method " +
                                       std::string(engine.info().name));
  text += row("  matrices", bytes_text(static_cast<double>(use.matrices)) + ", " +
                                number_text(static_cast<double>(use.matrices) / cells, 3) + " bytes a cell");
  text += row("  viewers", bytes_text(static_cast<double>(use.viewers)));
  text += row("  entries", bytes_text(static_cast<double>(use.entries)));
  text +=
      row("  objects",
          bytes_text(static_cast<double>(use.objects)) +
              (objects == 0 ? ""
                            : ", " + number_text(static_cast<double>(use.objects) / static_cast<double>(objects), 3) +
                                  " bytes an object"));
  return text;
}

/// The engine's memory once the first frame is answered.
std::string first_frame(const WorldOptions& options, const PreparedWorld& world, Hiding hiding) {
  GridOptions grid;
  grid.hiding = hiding;
  grid.dimension = world.scene.dimension;
  grid.bounds = world.choice.bounds;
  grid.cell = world.choice.cell;
  grid.max_memory = options.max_memory;
  grid.store = world.store;
  if (world.volume && hiding == Hiding::voxel) {
    grid.static_cells = std::make_shared<const StaticCells>(read_static_volume(world.volume->path, options.max_memory));
  }
  GridEngine engine(grid);
  const auto frames = open_frames(options, world);
  Replay replay(engine, world.scene, frames.get());
  replay.step();
  return memory_text(engine, replay.world().objects().size());
}

/// What a baked file holds; one of another scene is refused.
std::string baked_text(const std::string& path, const Scene& scene, std::uint64_t max_memory) {
  BakedHead head = read_baked_head(path);
  const MethodEntry& method = find_method(head.method, path);
  if (method.baking.bake == nullptr)
    throw Error(ErrorCode::bad_scene, path + ": of " + head.method + ", which does not bake");
  std::vector<Object> objects;
  for (const SceneObject& object : scene.objects) objects.push_back(object.object);
  head.version = method.baking.version;
  head.world = static_world_hash(objects);
  return row("baked", path + ", for " + head.method) + method.baking.describe(read_baked(path, head, max_memory));
}

std::string info_text(const WorldOptions& options, const PreparedWorld& world) {
  const int dimension = world.scene.dimension;
  std::string text = row("scene", options.scene + ", " + std::to_string(dimension) + "D");
  text += row("frames", frames_text(options, *world.survey));
  text += row("viewers", std::to_string(world.scene.viewers.size()) + " in the scene");
  text += contents(world.survey->objects);
  text += row("extent", bounds_text(world.survey->extent, dimension));
  text += row("bounds", bounds_text(world.choice.bounds, dimension) + ": " + world.choice.bounds_reason);
  text += row("cell", number_text(world.choice.cell) + " m: " + world.choice.cell_reason);
  text += row("grid", lattice_text(world.lattice) + ", " + std::to_string(world.lattice.cell_count()) + " in all");
  text += row("cell-less", cell_less(world));
  if (!reads_once(options.frames)) text += first_frame(options, world, Hiding::voxel);
  text += first_frame(options, world, Hiding::silhouette);
  if (!options.baked.empty()) text += baked_text(options.baked, world.scene, options.max_memory);
  return text;
}

std::string measure(const AdvicePlan& plan, const PreparedWorld& world) {
  std::uint64_t done = 0;
  Progress progress("frames, all settings",
                    plan.contenders.size() * plan.frames * static_cast<std::uint64_t>(plan.settings.repeats));
  return advice_text(plan, world, run_advice(plan, world, [&] { progress.update(++done); }));
}

int info(const InfoOptions& options) {
  const PreparedWorld world = prepare_world(options.world, true);
  std::optional<AdvicePlan> plan;  // what cannot be measured is refused before anything is said
  if (options.advise) plan = plan_advice(options.world, world, options.advice);
  std::fputs(info_text(options.world, world).c_str(), stdout);
  std::fflush(stdout);
  if (plan) std::fputs(measure(*plan, world).c_str(), stdout);
  return 0;
}

void add_advice_options(CLI::App& command, InfoOptions& options) {
  CLI::Option* const advise =
      command.add_flag("--advise", options.advise,
                       "measure a few cell sizes of voxel and mask resolutions of silhouette with the scene's own "
                       "viewers, and say which to take and which occluders no cell catches");
  add_whole(command, "--every", options.advice.every, {.low = 1, .expected = "a whole number, 1 or more"},
            "--advise: measure frames 0, N, 2N ... (default: as many as make 40 at most)")
      .needs(advise);
  add_whole(command, "--threads", options.advice.threads, {1, 256, "1 .. 256"}, "--advise: 1 .. 256 (default 1)")
      .needs(advise);
}

}  // namespace

void add_info_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App& command = *app.add_subcommand("info", "What is in a scene, the grid it gets and why, its memory");
  add_scene_options(command, options->world);
  command.add_option("--baked", options->world.baked, "say also what this file of gridcull bake holds")
      ->type_name("FILE");
  add_advice_options(command, *options);
  command.footer(
      "Example: a town, and which cell and method to take for it\n"
      "  gridcull make town --out town --viewers 10 --range 100\n"
      "  gridcull info town/scene.json --frames town/frames.jsonl --advise");
  command.callback([options, &action] { action = [options] { return info(*options); }; });
}

}  // namespace gridcull
