#include "gridcull/service/bench_charts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gridcull/core/culler.h"
#include "gridcull/service/bench_plot.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

double median_us(const BenchRow& row) { return row.total.steady().median; }

std::string method_text(const BenchRow& row) {
  std::string text(row.contender.method->info.name);
  if (row.contender.options.threads > 1) text += ", " + std::to_string(row.contender.options.threads) + " threads";
  return text;
}

/// "pairwise-rays (misses 18 %)", with the worst of its settings.
std::string with_misses(const BenchSceneResult& result, const BenchRow& row) {
  if (row.contender.method->info.guarantee == Guarantee::conservative) return method_text(row);
  double low = 1.0, high = 0.0;
  for (const BenchRow& other : result.rows) {
    if (other.contender.method != row.contender.method || other.verdict.exact == 0) continue;
    const double share = static_cast<double>(other.verdict.misses) / static_cast<double>(other.verdict.exact);
    low = std::min(low, share), high = std::max(high, share);
  }
  if (low > high) return method_text(row);
  std::string text = number_text(100.0 * low, 2);
  if (high > low) text += " .. " + number_text(100.0 * high, 2);
  return method_text(row) + " (misses " + text + " %)";
}

PlotPoint accuracy_point(const BenchRow& row) {
  return {median_us(row), row.over_estimation(), row.contender.setting, row.verdict.misses > 0};
}

/// Along a curve settings go by what they report: times are noisy, and a curve by time would zigzag.
void sort_by_accuracy(PlotCurves& curves) {
  for (auto& [name, points] : curves) {
    std::stable_sort(points.begin(), points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.y > b.y; });
  }
}

bool on_accuracy_chart(const BenchRow& row) {
  return row.refused.empty() && !std::isnan(row.over_estimation()) && row.contender.options.threads == 1;
}

void add_accuracy(const BenchSceneResult& result, std::vector<Chart>& out) {
  PlotCurves curves;
  for (const BenchRow& row : result.rows) {
    if (on_accuracy_chart(row)) curves[with_misses(result, row)].push_back(accuracy_point(row));
  }
  if (curves.empty()) return;
  sort_by_accuracy(curves);
  PlotAxes axes{"Speed against accuracy: " + result.label, "microseconds a frame, moves and query (median)",
                "over-estimation: reported / visible (hollow: misses somebody)"};
  axes.labels = true;
  out.push_back({"accuracy-" + plot_file_name(result.label), plot_script(axes, curves)});
}

/// Scenes of one family, which differ in their objects only.
void add_hidden(std::span<const BenchSceneResult> results, std::vector<Chart>& out) {
  std::map<std::string, PlotCurves> families;
  std::map<std::string, std::set<std::uint64_t>> sizes;
  for (const BenchSceneResult& result : results) {
    if (std::isnan(result.exact_mean)) continue;
    for (const BenchRow& row : result.rows) {
      if (!row.refused.empty() || !row.contender.is_default || row.contender.options.threads != 1) continue;
      const double hidden = std::max(1.0, static_cast<double>(result.objects) - result.exact_mean);
      families[result.family_of_objects][method_text(row)].push_back({hidden, median_us(row), ""});
      sizes[result.family_of_objects].insert(result.objects);
    }
  }
  for (auto& [family, curves] : families) {
    if (sizes[family].size() < 2) continue;
    sort_points(curves);
    const PlotAxes axes{"Time against hidden objects: " + family, "objects hidden from a viewer (mean)",
                        "microseconds a frame, moves and query (median)"};
    out.push_back({"hidden-" + plot_file_name(family), plot_script(axes, curves)});
  }
}

/// Scenes of one family, which differ in their viewers only, and numbers of threads.
void add_viewers(std::span<const BenchSceneResult> results, std::vector<Chart>& out) {
  std::map<std::string, PlotCurves> families;
  std::map<std::string, std::set<std::uint64_t>> sizes;
  for (const BenchSceneResult& result : results) {
    for (const BenchRow& row : result.rows) {
      if (!row.refused.empty() || !row.contender.is_default) continue;
      const auto viewers = static_cast<double>(std::max<std::uint64_t>(1, result.viewers));
      families[result.family_of_viewers][method_text(row)].push_back({viewers, median_us(row), ""});
      sizes[result.family_of_viewers].insert(result.viewers);
    }
  }
  for (auto& [family, curves] : families) {
    if (sizes[family].size() < 2) continue;
    sort_points(curves);
    const PlotAxes axes{"Time against viewers and threads: " + family, "viewers asking in every frame",
                        "microseconds a frame, moves and query (median)"};
    out.push_back({"viewers-" + plot_file_name(family), plot_script(axes, curves)});
  }
}

}  // namespace

PlotCurves accuracy_curves(const BenchSceneResult& result) {
  PlotCurves curves;
  for (const BenchRow& row : result.rows) {
    if (!on_accuracy_chart(row)) continue;
    const bool baked = row.contender.setting == "baked";
    std::string name(row.contender.method->info.name);
    curves[baked ? name + ", baked" : name].push_back(accuracy_point(row));
  }
  sort_by_accuracy(curves);
  return curves;
}

std::vector<Chart> bench_charts(std::span<const BenchSceneResult> results) {
  std::vector<Chart> out;
  for (const BenchSceneResult& result : results) add_accuracy(result, out);
  add_hidden(results, out);
  add_viewers(results, out);
  return out;
}

}  // namespace gridcull
