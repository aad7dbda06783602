// `gridcull bench`: methods against methods, speed against accuracy, in one run.
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/bench_charts.h"
#include "gridcull/service/bench_figure.h"
#include "gridcull/service/bench_output.h"
#include "gridcull/service/bench_report.h"
#include "gridcull/service/bench_run.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/gnuplot.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/progress.h"
#include "gridcull/service/stability.h"
#include "gridcull/service/tbv_bench.h"
#include "gridcull/service/text.h"
#include "gridcull/service/world_options.h"

#ifdef GRIDCULL_WITH_SERVER
#include "gridcull/service/server/load_bench.h"
#include "gridcull/service/server/service_bench.h"
#endif

namespace gridcull {
namespace {

/// Ten thousand movers and a hundred viewers: people in the plane, drivers in a town, riders in a city.
constexpr std::array service_scenes{"discs:10000:viewers=100:range=25", "town:40000:viewers=100:range=150",
                                    "city:50:10000:viewers=100:range=100"};

/// 3D reference of the stability suite: its worlds are small and every frame is judged.
constexpr int stability_rays = 128;

/// A minute or two on two cores. Three sizes of spheres for the chart of hidden objects, three numbers of viewers.
constexpr std::array standard_scenes{"spheres:1000",
                                     "spheres:5000",
                                     "spheres:20000",
                                     "city:20:1000",
                                     "discs:300",
                                     "town:400:viewers=1:range=150",
                                     "town:400:viewers=10:range=150",
                                     "town:400:viewers=100:range=150"};

struct BenchOptions {
  std::vector<std::string> scenes{};                 ///< empty: standard_scenes, or the figure's
  std::vector<std::string> resolutions{}, bounds{};  ///< as typed
  BenchChoice choice{};
  BenchSettings settings{};
  std::string out{};
  bool stability = false;
  bool service = false;
  double load = 0.0;  ///< seconds; 0: not asked for
  std::string figure{};
  std::vector<const CLI::Option*> settings_of_runs{};  ///< what not every kind of bench has a use for
};

/// Options that would be ignored are mistakes. `used`: those that are not.
void refuse_others(const BenchOptions& o, const std::string& kind, const std::set<std::string>& used) {
  for (const CLI::Option* option : o.settings_of_runs) {
    const std::string name = option->get_name();
    if (option->count() > 0 && !used.contains(name)) throw Error(ErrorCode::usage, kind + " has no use for " + name);
  }
}

void refuse_scenes(const BenchOptions& o) {
  if (!o.scenes.empty()) throw Error(ErrorCode::usage, "--figure: " + o.figure + " excludes --scenes, it has its own");
}

/// A figure says what runs, how long and how much is judged; repeats and the like stay the user's.
void take_figure(BenchOptions& o) {
  if (o.figure.empty()) {
    if (o.scenes.empty()) o.scenes.assign(standard_scenes.begin(), standard_scenes.end());
    return;
  }
  const FigurePlan plan = figure_plan(o.figure);
  if (!plan.more_scenes) refuse_scenes(o);
  std::set<std::string> used{"--threads", "--resolutions", "--occluders", "--bounds", "--rays",
                             "--seconds", "--max-memory",  "--repeats",   "--pull"};
  if (plan.methods.empty()) used.insert("--methods");
  if (plan.cells.empty()) used.insert("--cells");
  if (plan.more_scenes) used.insert({"--baked", "--bake"});
  refuse_others(o, "--figure " + o.figure, used);
  o.scenes.insert(o.scenes.begin(), plan.scenes.begin(), plan.scenes.end());
  if (!plan.methods.empty()) o.choice.methods = plan.methods;
  if (!plan.cells.empty()) o.choice.cells = plan.cells;
  o.choice.bake = o.choice.bake || plan.bake;
  o.settings.frames = plan.frames;
  o.settings.judged = plan.judged;
}

void check_choice(BenchOptions& options) {
  for (const std::string& method : options.choice.methods) (void)find_method(method, "--methods");
  for (const std::string& text : options.resolutions) {
    options.choice.resolutions.push_back(parse_resolution(text, "--resolutions"));
  }
  for (const std::string& name : options.bounds) options.choice.bounds.push_back(parse_bounds(name));
  std::set<std::string> names;
  for (const std::string& scene : options.scenes) {
    (void)parse_bench_scene(scene);
    if (!names.insert(scene).second) throw Error(ErrorCode::usage, "--scenes: " + scene + " stands there twice");
  }
}

/// A scene and who runs on it.
struct Match {
  std::string scene;
  std::vector<Contender> contenders;
};

/// A baked file for none of those who run is a mistake.
void check_baked(const BenchOptions& options, const std::vector<Match>& matches) {
  for (const std::string& file : options.choice.baked) {
    bool used = false;
    for (const Match& match : matches) {
      for (const Contender& c : match.contenders) used = used || c.options.baked == file;
    }
    if (!used) throw Error(ErrorCode::usage, "--baked: " + file + " is for none of the scenes and methods");
  }
}

/// Opens every scene once, so that a bad one is refused before the work.
std::vector<Match> plan(const BenchOptions& options) {
  std::vector<Match> matches;
  for (const std::string& name : options.scenes) {
    stop_if_interrupted();
    matches.push_back({name, choose_contenders(open_bench_scene(name), options.choice)});
    if (matches.back().contenders.empty()) {
      throw Error(ErrorCode::usage, "--methods: none of them takes " + name);
    }
  }
  return matches;
}

/// A scene on which nothing ran, because it asks for too much memory, say, is bad input.
void expect_somebody_ran(const BenchSceneResult& result) {
  std::string why;
  for (const BenchRow& row : result.rows) {
    if (row.refused.empty()) return;
    why = row.refused;
  }
  throw Error(ErrorCode::usage, result.label + ": no method ran: " + why);
}

/// Each method once, on as many threads as it may have: the file does not depend on them.
void bake_all(const BenchScene& scene, const std::string& folder, std::vector<Contender>& contenders) {
  std::map<const MethodEntry*, std::pair<std::string, BakeCost>> done;
  for (Contender& contender : contenders) {
    if (!contender.to_bake) continue;
    const auto [at, is_new] = done.try_emplace(contender.method);
    auto& [file, cost] = at->second;
    if (is_new) {
      file = folder + "/" + std::string(contender.method->info.name) + ".baked";
      MethodOptions options = contender.options;
      options.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 256u));
      cost = bake_for_bench(scene, *contender.method, options, file);
    }
    contender.options.baked = file;
    contender.bake = cost;
  }
}

std::vector<BenchSceneResult> run_all(const BenchOptions& options, const std::vector<Match>& matches) {
  std::uint64_t total = 0, done = 0;
  for (const Match& match : matches) {
    total += match.contenders.size() * options.settings.frames * static_cast<std::uint64_t>(options.settings.repeats);
  }
  std::vector<BenchSceneResult> results;
  for (const Match& match : matches) {
    {
      const BenchScene scene = open_bench_scene(match.scene);
      const BakeFolder folder;
      std::vector<Contender> contenders = match.contenders;
      bake_all(scene, folder.path(), contenders);
      Progress progress("frames, " + match.scene, total);
      results.push_back(run_bench_scene(scene, contenders, options.settings, [&] { progress.update(++done); }));
    }
    expect_somebody_ran(results.back());
    std::fputs(("\n" + bench_table(results.back())).c_str(), stdout);
    std::fflush(stdout);
  }
  return results;
}

/// Writes the files of a run, if any are wanted, and says so.
void write_out(std::optional<BenchOutput>& output, const std::string& folder, const std::string& csv,
               const std::vector<Chart>& charts) {
  if (!output) return;
  const std::string gnuplot = find_gnuplot();
  output->commit(csv, charts, gnuplot);
  std::printf("\n%s/bench.csv%s\n", folder.c_str(),
              gnuplot.empty()
                  ? ", and charts as scripts: gnuplot was not found, so none was drawn (Debian: gnuplot-nox)"
                  : (", " + counted(charts.size(), "chart") + " as .svg, .png and .gp").c_str());
}

/// The figure that compares indexes, not methods.
int bench_tbv(const BenchOptions& options) {
  TbvSettings settings;
  settings.repeats = options.settings.repeats;
  std::optional<BenchOutput> output;
  if (!options.out.empty()) output.emplace(options.out);
  std::fputs(tbv_head(settings).c_str(), stdout);
  std::uint64_t done = 0;
  std::vector<TbvResult> results;
  for (const std::string& scene : settings.scenes) {
    {
      Progress progress("frames, " + scene, tbv_ticks(settings));
      results.push_back(run_tbv_scene(scene, settings, [&] { progress.update(++done); }));
    }
    std::fputs(("\n" + tbv_table(results.back())).c_str(), stdout);
    std::fflush(stdout);
  }
  write_out(output, options.out, tbv_head(settings) + tbv_csv(results), tbv_charts(results));
  return 0;
}

#ifdef GRIDCULL_WITH_SERVER
int bench_wire(BenchOptions options) {
  refuse_others(options, "--service", {"--repeats", "--frames"});
  if (options.scenes.empty()) options.scenes.assign(service_scenes.begin(), service_scenes.end());
  check_choice(options);
  std::fputs(bench_head(options.settings).c_str(), stdout);
  std::uint64_t done = 0;
  std::vector<ServiceBenchResult> results;
  for (const std::string& scene : options.scenes) {
    Progress progress("frames, " + scene,
                      options.settings.frames * static_cast<std::uint64_t>(options.settings.repeats));
    results.push_back(bench_service(scene, options.settings.frames, options.settings.repeats, [&] {
      progress.update(++done);
      stop_if_interrupted();
    }));
    done = 0;
  }
  std::fputs(("\n" + service_bench_table(results)).c_str(), stdout);
  return std::all_of(results.begin(), results.end(), [](const auto& r) { return r.same_answers; }) ? 0 : 1;
}
#endif

#ifdef GRIDCULL_WITH_SERVER
int bench_server_load(const BenchOptions& options) {
  refuse_others(options, "--service-load", {});
  LoadSettings settings;
  settings.seconds = options.load;
  std::fputs(bench_head(options.settings).c_str(), stdout);
  const LoadResult result = bench_load(settings, [] { stop_if_interrupted(); });
  std::fputs(load_text(settings, result).c_str(), stdout);
  return result.asked == result.answered ? 0 : 1;
}
#endif

int bench(BenchOptions options) {
#ifdef GRIDCULL_WITH_SERVER
  if (options.service) return bench_wire(std::move(options));
  if (options.load > 0.0) return bench_server_load(options);
#endif
  if (options.figure == tbv_figure) {
    refuse_scenes(options);
    refuse_others(options, "--figure " + options.figure, {"--repeats"});
    return bench_tbv(options);
  }
  take_figure(options);
  check_choice(options);
  if (options.stability) {
    refuse_others(options, "--stability", {"--methods", "--repeats"});
    return run_stability_bench(options.choice.methods, {options.settings.repeats, stability_rays}, options.out);
  }
  std::optional<BenchOutput> output;
  if (!options.out.empty()) output.emplace(options.out);
  const std::vector<Match> matches = plan(options);
  check_baked(options, matches);
  std::fputs(bench_head(options.settings).c_str(), stdout);
  const std::vector<BenchSceneResult> results = run_all(options, matches);
  std::vector<Chart> charts = bench_charts(results);
  if (!options.figure.empty()) {
    for (Chart& chart : figure_charts(options.figure, results)) charts.push_back(std::move(chart));
  }
  write_out(output, options.out, bench_head(options.settings) + bench_csv(results), charts);
  return 0;
}

void add_options(CLI::App& command, BenchOptions& o) {
  CLI::Option* const scenes =
      command
          .add_option(
              "--scenes", o.scenes,
              "spheres:COUNT, discs:COUNT, town:BUILDINGS, maze:SIDE or city:BLOCKS:CARS, each with :viewers=V, "
              ":range=M, :cell=M, :seed=S (spheres: :hidden=N, :moving=M) behind; a folder, a scene file, or "
              "SCENE@FRAMES")
          ->delimiter(',')
          ->type_name("S,S...");
  command.add_option("--methods", o.choice.methods, "as listed by gridcull methods (default: all that take the scene)")
      ->delimiter(',')
      ->type_name("M,M...");
  add_wholes(command, "--threads", o.choice.threads, {1, 256, "1 .. 256"},
             "1 .. 256 each (default 1; 1 and 2 for scenes of ten viewers or more)");
  command
      .add_option("--resolutions", o.resolutions,
                  "R for methods that take R, 8 .. 8192; WxH for those that take WxH, 1 .. 8192 each")
      ->delimiter(',')
      ->type_name("R|WxH,...");
  add_positives(command, "--cells", o.choice.cells, {1e9, "sizes above 0, metres"},
                "metres, for methods whose setting it is (default 2, 1 and 1/2 x the scene's)")
      .type_name("M,M...");
  add_wholes(command, "--occluders", o.choice.occluders, {1, 64, "1 .. 64"},
             "1 .. 64 each, for methods whose setting it is (default 1,2,4,8,16,32)");
  command
      .add_option("--bounds", o.bounds,
                  "each of these for methods that test objects with one: " + bound_kind_names() +
                      " (default: the method's own choice)")
      ->delimiter(',')
      ->type_name("KIND,...");
  add_whole(command, "--repeats", o.settings.repeats, {1, 1000, "1 .. 1000"}, "times over (default 3)");
  command.add_flag("--pull", o.settings.pull,
                   "methods ask for the positions of movers that they need, instead of being told of every move");
  add_whole(command, "--frames", o.settings.frames, {.low = 1, .expected = "a whole number, 1 or more"},
            "of each scene, at most (default 40)");
  add_whole(command, "--judge", o.settings.judged, {.expected = "a whole number, 0 or more"},
            "frames held against the exact sets (default 3, 0: none)");
  add_whole(command, "--rays", o.settings.rays, {1, 16384, "1 .. 16384"},
            "3D reference: along a frustum's height or a cube face's edge (default 256)")
      .type_name("R");
  add_positive(command, "--seconds", o.settings.seconds, {1e9, "seconds above 0"},
               "a contender that has used more on a scene is stopped (default 20)")
      .type_name("S");
  add_whole(command, "--max-memory", o.choice.max_memory, memory_bytes(),
            "refuse grids, masks and maps that would take more than this (default 4 GiB)")
      .type_name("BYTES");
  CLI::Option* const stability = command.add_flag(
      "--stability", o.stability,
      "instead of scenes: small worlds that go to a limit (thin walls, far origins, fast movers ...), every "
      "answer judged; a table a method");
  stability->excludes(scenes);
#ifdef GRIDCULL_WITH_SERVER
  command
      .add_flag("--service", o.service,
                "the same frames in this process and over loopback through a server, in turn (default scenes: 10,000 "
                "movers and 100 viewers)")
      ->excludes(stability);
  add_positive(command, "--service-load", o.load, {1e6, "seconds above 0"},
               "so long, 100 sessions of 500 objects at 10 frames a second: frames lost, latencies, memory")
      .type_name("SECONDS")
      ->excludes(stability)
      ->excludes(scenes);
#endif
  CLI::Option* const figure =
      command
          .add_option("--figure", o.figure,
                      "batagelo-5: the paper's figure 5 made again; tbv-upkeep: what that paper leaves open; "
                      "speed-accuracy: every method and setting on every kind of scene, and on --scenes besides")
          ->type_name("NAME");
  figure->excludes(stability);
  command.add_option("--baked", o.choice.baked, "files that gridcull bake wrote, each for its own method and scene")
      ->delimiter(',')
      ->type_name("FILE,...");
  command.add_flag("--bake", o.choice.bake,
                   "first bake what methods work out in advance, on all cores; seconds and bytes go into the table");
  for (const char* name :
       {"--methods", "--threads", "--resolutions", "--cells", "--occluders", "--bounds", "--repeats", "--frames",
        "--judge", "--rays", "--seconds", "--max-memory", "--baked", "--bake", "--pull"}) {
    o.settings_of_runs.push_back(command.get_option(name));
  }
  add_text(command, "--out", o.out, "a folder", "folder for bench.csv and the charts; without it only the tables")
      .type_name("DIR");
}

}  // namespace

void add_bench_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<BenchOptions>();
  CLI::App& command = *app.add_subcommand("bench", "Methods against methods: time, over-estimation, misses, memory");
  add_options(command, *options);
  command.footer(
      "Example: two methods on spheres, with charts\n"
      "  gridcull bench --scenes spheres:1000 --methods frustum,pairwise-rays --frames 10 --out bench");
  command.callback([options, &action] { action = [options] { return bench(*options); }; });
}

}  // namespace gridcull
