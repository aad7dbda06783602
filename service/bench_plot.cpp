#include "gridcull/service/bench_plot.h"

#include <algorithm>
#include <cctype>

#include "gridcull/service/build_facts.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

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

std::string data_of(const PlotCurves& curves) {
  std::string out;
  int number = 0;
  for (const auto& [name, points] : curves) {
    out += "$curve" + std::to_string(number++) + " << EOD\n";
    for (const PlotPoint& p : points) {
      out += number_text(p.x, 8) + " " + number_text(p.y, 8) + " " + quoted(p.text) + (p.missed ? " 6\n" : " 7\n");
    }
    out += "EOD\n";
  }
  return out;
}

std::string plot_of(const PlotCurves& curves, bool labels) {
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

}  // namespace

std::string plot_file_name(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.';
    out += plain ? c : '-';
  }
  return out;
}

std::string plot_script(const PlotAxes& axes, const PlotCurves& curves) {
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

void sort_points(PlotCurves& curves) {
  for (auto& [name, points] : curves) {
    std::sort(points.begin(), points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  }
}

}  // namespace gridcull
