#include "gridcull/service/advice_run.h"

#include <algorithm>
#include <charconv>
#include <functional>
#include <limits>
#include <optional>

#include "gridcull/core/error.h"
#include "gridcull/grid/engine.h"
#include "gridcull/service/bench_course.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

constexpr std::uint64_t most_frames = 40;  // unless the user says which
constexpr std::uint64_t still_frames = 10;
constexpr std::uint64_t judged_frames = 5;
constexpr double seconds = 5.0;  // a setting that has used more is stopped
constexpr int repeats = 5;
constexpr std::size_t run = 5;  // frames in a row: so many at least, however slow
const std::vector<Resolution> resolutions{
    {}, {.edge = 64}, {.edge = 128}, {.edge = 256}, {.edge = 512}, {.edge = 1024}};

/// The number that somebody gets who types what is printed.
double as_typed(double value) {
  const std::string text = number_text(value);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

BenchScene scene_of(const WorldOptions& options, const PreparedWorld& world) {
  BenchScene scene;
  scene.label = options.scene;
  scene.name.scene_path = options.scene;
  scene.name.frames_path = options.frames;
  scene.scene = world.scene;
  scene.choice = world.choice;
  scene.default_cell = world.choice.cell;
  if (options.frames.empty()) scene.still = still_frames;
  return scene;
}

BenchSettings settings_of(const AdvicePlan& plan, const AdviceRequest& request) {
  BenchSettings settings;
  settings.frames = request.every > 0 ? std::numeric_limits<std::uint64_t>::max() : most_frames;
  settings.every = request.every > 0 ? request.every
                                     : std::max<std::uint64_t>(1, (plan.file_frames + most_frames - 1) / most_frames);
  settings.judged = plan.file_frames == 0 ? 1 : judged_frames;
  settings.repeats = repeats;
  settings.seconds = seconds;
  settings.run = run;
  return settings;
}

/// How many frames there are to measure, and who looks in them.
void look_ahead(AdvicePlan& plan) {
  Course course(plan.scene, plan.settings.frames, plan.settings.every);
  for (CourseFrame frame; course.next(frame); ++plan.frames) {
    plan.viewers = std::max<std::uint64_t>(plan.viewers, frame.views.size());
    stop_if_interrupted();
  }
  if (plan.viewers == 0) {
    throw Error(ErrorCode::usage, "--advise: expected viewers, whose questions are measured, found none in " +
                                      plan.scene.label +
                                      (plan.file_frames > 0 ? " and the frames that would be measured" : ""));
  }
}

/// The bounds that `--cell` would lead to.
Bounds bounds_for(const PreparedWorld& world, double cell) {
  if (world.volume && !world.scene.bounds) return world.lattice.box();
  return choose_lattice(world.scene.dimension, world.survey->objects, world.scene.bounds, cell, world.survey->extent)
      .bounds;
}

/// Settings run side by side and share the memory allowed. "" where this one fits: then its lattice is the plan's.
std::string take_memory(const Contender& contender, AdvicePlan& plan, std::uint64_t& left) {
  const MethodOptions& o = contender.options;
  const bool dense = o.store == StoreKind::dense;
  try {
    const Lattice lattice(o.dimension, o.bounds, o.cell, o.max_memory, dense ? Room::whole : Room::where_needed);
    const std::uint64_t need = dense ? Lattice::bytes_for(o.dimension, lattice.cells()) : 0;
    if (need > left) {
      return "cells of " + number_text(o.cell) + " m need " + bytes_text(static_cast<double>(need)) +
             ", more than the " + bytes_text(static_cast<double>(left)) +
             " that the settings beside it leave of --max-memory";
    }
    left -= need;
    plan.lattices.push_back(lattice);
    return {};
  } catch (const Error& refusal) {
    const std::string line = refusal.what();
    return line.starts_with("grid.cell: ") ? line.substr(11) : line;
  }
}

void add_voxel(const PreparedWorld& world, const BenchChoice& choice, AdvicePlan& plan) {
  std::uint64_t left = choice.max_memory;
  for (Contender& contender : choose_contenders(plan.scene, choice)) {
    contender.options.bounds = bounds_for(world, contender.options.cell);
    contender.options.store = world.store;
    std::string why = take_memory(contender, plan, left);
    if (why.empty()) {
      plan.contenders.push_back(std::move(contender));
    } else {
      plan.refused.push_back({std::move(contender), std::move(why)});
    }
  }
}

/// What the row reports for one object that `longest` does, in the frames that both ran.
double looseness(const BenchRow& row, const BenchRow& longest) {
  double own = 0.0, others = 0.0;
  for (std::size_t frame = 0; frame < row.reported.size(); ++frame) {
    own += row.reported[frame];
    others += longest.reported[frame];
  }
  return others > 0.0 ? own / others : 1.0 + own;  // nothing against nothing is 1, as equals are
}

}  // namespace

std::vector<double> cells_about(double derived, double own) {
  std::vector<double> cells{own};
  for (const double factor : {4.0, 2.0, 1.0, 0.7, 0.5}) {
    const double cell = as_typed(factor * derived);
    if (cell != as_typed(own)) cells.push_back(cell);
  }
  std::sort(cells.begin(), cells.end(), std::greater<>());
  return cells;
}

AdvicePlan plan_advice(const WorldOptions& options, const PreparedWorld& world, const AdviceRequest& request) {
  if (reads_once(options.frames)) {
    throw Error(ErrorCode::usage,
                "--advise: expected a frames file, which is read several times, found standard input or a pipe");
  }
  AdvicePlan plan;
  plan.scene = scene_of(options, world);
  plan.baked = world.volume.has_value();
  if (!options.frames.empty()) plan.file_frames = world.survey->frames;
  plan.settings = settings_of(plan, request);
  look_ahead(plan);
  BenchChoice choice;
  choice.methods = {std::string(grid_engine_info(Hiding::silhouette).name)};
  choice.threads = {request.threads};
  choice.resolutions = resolutions;
  choice.max_memory = options.max_memory;
  plan.contenders = choose_contenders(plan.scene, choice);
  choice.methods = {std::string(grid_engine_info(Hiding::voxel).name)};
  const Survey& survey = *world.survey;
  const double derived =
      choose_lattice(world.scene.dimension, survey.objects, world.scene.bounds, std::nullopt, survey.extent).cell;
  choice.cells = cells_about(derived, world.choice.cell);
  add_voxel(world, choice, plan);
  return plan;
}

std::optional<std::size_t> twin_of(const std::vector<BenchRow>& rows, std::size_t place) {
  const BenchRow& row = rows[place];
  for (std::size_t i = 0; i < place; ++i) {
    const BenchRow& other = rows[i];
    const bool comparable = row.refused.empty() && other.refused.empty() && row.frames == other.frames &&
                            row.contender.method == other.contender.method &&
                            row.contender.setting_name == "resolution" && other.contender.setting_name == "resolution";
    if (comparable && row.hash == other.hash && row.held_bytes == other.held_bytes) return i;
  }
  return std::nullopt;
}

std::vector<SpeedAccuracy> compare_rows(const std::vector<BenchRow>& rows) {
  const BenchRow* longest = nullptr;
  for (const BenchRow& row : rows) {
    if (row.refused.empty() && (longest == nullptr || row.reported.size() > longest->reported.size())) longest = &row;
  }
  std::vector<SpeedAccuracy> out;
  for (const BenchRow& row : rows) {
    SpeedAccuracy& one = out.emplace_back();
    one.usable = row.refused.empty() && row.verdict.misses == 0;
    if (!row.refused.empty()) continue;
    one.time = row.total.steady().median;
    one.reported = looseness(row, *longest);
    const std::optional<std::size_t> twin = twin_of(rows, out.size() - 1);
    if (!twin) continue;
    one.usable = false;
    out[*twin].time = std::min(out[*twin].time, one.time);
  }
  return out;
}

Advice run_advice(const AdvicePlan& plan, const PreparedWorld& world, const std::function<void()>& tick) {
  Advice advice;
  advice.cell_less = find_cell_less(plan.lattices, world.survey->objects);
  advice.measured = run_bench_scene(plan.scene, plan.contenders, plan.settings, tick);
  advice.settings = compare_rows(advice.measured.rows);
  return advice;
}

}  // namespace gridcull
