#include "gridcull/service/bench_charts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "gridcull/core/culler.h"
#include "gridcull/service/build_facts.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

/// A point of a curve.
struct Point {
  double x = 0.0, y = 0.0;
  std::string text{};
  bool missed = false;  ///< somebody was: a hollow mark
};
using Curves = std::map<std::string, std::vector<Point>>;  // by name

double median_us(const BenchRow& row) { return row.total.summary(row.total.frames() > 1 ? 1 : 0).median; }

std::string file_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
    out += plain ? c : '-';
  }
  return out;
}

/// In gnuplot's double quotes.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n') {
      out += "\\n";
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string method_text(const BenchRow& row) {
  std::string text(row.contender.method->info.name);
  if (row.contender.options.threads > 1) text += ", " + std::to_string(row.contender.options.threads) + " threads";
  return text;
}

struct Axes {
  std::string title, x, y;
  bool log_x = true;
  bool labels = false;  ///< points carry their setting
};

std::string data_of(const Curves& curves) {
  std::string out;
  int number = 0;
  for (const auto& [name, points] : curves) {
    out += "$curve" + std::to_string(number++) + " << EOD\n";
    for (const Point& p : points) {
      out += number_text(p.x, 8) + " " + number_text(p.y, 8) + " " + quoted(p.text) + (p.missed ? " 6\n" : " 7\n");
    }
    out += "EOD\n";
  }
  return out;
}

std::string plot_of(const Curves& curves, bool labels) {
  // Where reported and visible are the same.
  std::string out = labels ? "plot 1 lc \"gray\" notitle, " : "plot ";
  int number = 0;
  for (const auto& [name, points] : curves) {
    const std::string data = "$curve" + std::to_string(number), style = std::to_string(number + 1);
    if (number++ > 0) out += ", ";
    out += data + " using 1:2 with lines lt " + style + " title " + quoted(name) + ", " + data +
           " using 1:2:4 with points lt " + style + " pt variable ps 0.8 notitle";
    if (labels) out += ", " + data + " using 1:2:3 with labels offset 0,0.7 tc lt " + style + " notitle";
  }
  return out + "\n";
}

std::string script_of(const Axes& axes, const Curves& curves) {
  const BuildFacts facts = build_facts();
  std::string out = "# gnuplot -c THIS chart.svg chart.png\n" + data_of(curves);
  out += "set title " + quoted(axes.title + "\ncommit " + facts.commit + ", " + processor_name() + ", " + date_text()) +
         "\n";
  out += "set xlabel " + quoted(axes.x) + "\nset ylabel " + quoted(axes.y) + "\n";
  out += axes.log_x ? "set logscale xy\n" : "set logscale y\n";
  out +=
      "set key outside right top\nset grid\nset autoscale xfix\nset autoscale yfix\nset offsets graph 0.05, graph "
      "0.05, graph 0.1, graph 0.05\n";
  const std::string plot = plot_of(curves, axes.labels);
  out += "set terminal svg size 1000,560 noenhanced font \"sans,13\" background \"white\"\nset output ARG1\n" + plot;
  out += "set terminal pngcairo size 1000,560 noenhanced font \"sans,11\"\nset output ARG2\n" + plot + "set output\n";
  return out;
}

void sort_points(Curves& curves) {
  for (auto& [name, points] : curves) {
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  }
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

void add_accuracy(const BenchSceneResult& result, std::vector<Chart>& out) {
  Curves curves;
  for (const BenchRow& row : result.rows) {
    if (!row.refused.empty() || std::isnan(row.over_estimation()) || row.contender.options.threads != 1) continue;
    curves[with_misses(result, row)].push_back(
        {median_us(row), row.over_estimation(), row.contender.setting, row.verdict.misses > 0});
  }
  if (curves.empty()) return;
  // Along a curve the settings go by their time.
  sort_points(curves);
  Axes axes{"Speed against accuracy: " + result.label, "microseconds a frame, moves and query (median)",
            "over-estimation: reported / visible (hollow: misses somebody)"};
  axes.labels = true;
  out.push_back({"accuracy-" + file_name(result.label), script_of(axes, curves)});
}

/// Scenes of one family, which differ in their objects only.
void add_hidden(std::span<const BenchSceneResult> results, std::vector<Chart>& out) {
  std::map<std::string, Curves> families;
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
    const Axes axes{"Time against hidden objects: " + family, "objects hidden from a viewer (mean)",
                    "microseconds a frame, moves and query (median)"};
    out.push_back({"hidden-" + file_name(family), script_of(axes, curves)});
  }
}

/// Scenes of one family, which differ in their viewers only, and numbers of threads.
void add_viewers(std::span<const BenchSceneResult> results, std::vector<Chart>& out) {
  std::map<std::string, Curves> families;
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
    const Axes axes{"Time against viewers and threads: " + family, "viewers asking in every frame",
                    "microseconds a frame, moves and query (median)"};
    out.push_back({"viewers-" + file_name(family), script_of(axes, curves)});
  }
}

}  // namespace

std::vector<Chart> bench_charts(std::span<const BenchSceneResult> results) {
  std::vector<Chart> out;
  for (const BenchSceneResult& result : results) add_accuracy(result, out);
  add_hidden(results, out);
  add_viewers(results, out);
  return out;
}

}  // namespace gridcull
