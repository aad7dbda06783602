#include "gridcull/service/bench_figure.h"

#include "gridcull/core/error.h"
#include "gridcull/service/bench_plot.h"

namespace gridcull {
namespace {

constexpr const char* walkthrough = "spheres:5000:moving=200";

std::string curve_name(const BenchRow& row) {
  std::string text(row.contender.method->info.name);
  if (row.contender.setting_name == "cell") text += ", " + row.contender.setting;
  return text;
}

/// One default setting a method but for the cells of `voxel`, which are both of the paper's.
bool wanted(const BenchRow& row) {
  return row.refused.empty() && (row.contender.is_default || row.contender.setting_name == "cell");
}

Chart time_of_frames(const BenchSceneResult& result) {
  PlotCurves curves;
  for (const BenchRow& row : result.rows) {
    if (!wanted(row)) continue;
    for (std::size_t f = 1; f < row.total.frames(); ++f) {
      curves[curve_name(row)].push_back({static_cast<double>(f), row.total.least(f), ""});
    }
  }
  PlotAxes axes{"Walkthrough: 200 moving, 4,800 static spheres", "frame", "microseconds, moves and query"};
  axes.log_x = false;
  return {"walkthrough-time", plot_script(axes, curves)};
}

Chart objects_of_frames(const BenchSceneResult& result) {
  PlotCurves curves;
  for (const BenchRow& row : result.rows) {
    if (!wanted(row)) continue;
    for (std::size_t f = 0; f < row.reported.size(); ++f) {
      curves[curve_name(row)].push_back({static_cast<double>(f), row.reported[f], ""});
    }
  }
  for (const auto& [frame, visible] : result.exact) {
    curves["visible (by rays: at least)"].push_back({static_cast<double>(frame), visible, ""});
  }
  PlotAxes axes{"Walkthrough: objects reported", "frame", "objects"};
  axes.log_x = false;
  return {"walkthrough-objects", plot_script(axes, curves)};
}

Chart all_scenes(std::span<const BenchSceneResult> results) {
  std::vector<PlotPanel> panels;
  for (const BenchSceneResult& result : results) panels.push_back({result.label, accuracy_curves(result)});
  const PlotAxes axes{"Speed against accuracy: every method, a curve over its setting", "microseconds a frame (median)",
                      "reported / visible"};
  return {"speed-accuracy", panels_script(axes, panels)};
}

}  // namespace

FigurePlan figure_plan(const std::string& name) {
  if (name == "speed-accuracy") {
    return {.scenes = {"spheres:5000", "city:10:500", "discs:300", "maze:20", "town:400:viewers=10:range=150"},
            .frames = 30,
            .judged = 5,
            .bake = true,
            .more_scenes = true};
  }
  if (name != "batagelo-5") {
    throw Error(ErrorCode::usage, "--figure: expected batagelo-5, speed-accuracy or tbv-upkeep, found " + name);
  }
  return {{"spheres:5000:hidden=0", "spheres:5000:hidden=5000", "spheres:5000:hidden=20000",
           "spheres:5000:hidden=80000", walkthrough},
          {"voxel", "silhouette", "frustum"},
          {2.0, 1.0},
          140,
          28,
          false,
          false};
}

std::vector<Chart> figure_charts(const std::string& name, std::span<const BenchSceneResult> results) {
  (void)figure_plan(name);
  std::vector<Chart> out;
  if (name == "speed-accuracy") out.push_back(all_scenes(results));
  for (const BenchSceneResult& result : results) {
    if (result.label != walkthrough) continue;
    out.push_back(time_of_frames(result));
    out.push_back(objects_of_frames(result));
  }
  return out;
}

}  // namespace gridcull
