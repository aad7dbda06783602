#include "gridcull/service/bench_plot.h"

#include <algorithm>
#include <array>
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

/// In blocks $curve<first>, $curve<first + 1> ...
std::string data_of(const PlotCurves& curves, int first = 0) {
  std::string out;
  int number = first;
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

/// Colours that can be told apart on white, by people who see few colours, too; gnuplot's own have a pale yellow.
std::string palette() {
  constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8c6d00",
                               "#56b4e9", "#000000", "#e69f00", "#7b3294", "#6b8e23"};
  std::string out;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    out += "set linetype " + std::to_string(i + 1) + " lc rgb \"" + colours[i] + "\" lw 1.5\n";
  }
  return out + "set linetype cycle " + std::to_string(colours.size()) + "\n";
}

std::string title_of(const PlotAxes& axes) {
  return quoted(axes.title + "\ncommit " + build_facts().commit + ", " + processor_name() + ", " + date_text());
}

constexpr int panels_across = 3;

/// 1, 2, 5, 10 ... for narrow axes, which would have no number otherwise.
std::string tics() {
  std::string list;
  for (int exponent = -3; exponent <= 7; ++exponent) {
    for (const int digit : {1, 2, 5}) {
      list += (list.empty() ? "" : ",") + std::to_string(digit) + "e" + std::to_string(exponent);
    }
  }
  return "set xtics (" + list + ")\nset ytics (" + list + ")\n";
}

/// The panel's curves, colours by `styles`.
std::string panel_of(const PlotPanel& panel, int first, const std::map<std::string, int>& styles) {
  std::string out = "set title " + quoted(panel.title) + "\nplot 1 lc \"gray\" notitle";
  int number = first;
  for (const auto& [name, points] : panel.curves) {
    const std::string data = "$curve" + std::to_string(number++), style = std::to_string(styles.at(name));
    out += ", " + data + " using 1:2 with lines lt " + style + " notitle, " + data + " using 1:2:4 with points lt " +
           style + " pt variable ps 0.8 notitle";
  }
  return out + "\n";
}

/// An empty panel with all names.
std::string key_of(const std::map<std::string, int>& styles) {
  std::string out =
      "set title \"\"\nunset logscale\nunset tics\nunset border\nunset grid\nunset xlabel\nunset ylabel\n"
      "set key at graph 0.05, graph 0.98 left top reverse Left\nplot [0:1] [0:1] ";
  bool is_first = true;
  for (const auto& [name, style] : styles) {
    out += std::string(is_first ? "" : ", ") + "NaN with linespoints lt " + std::to_string(style) + " pt 7 title " +
           quoted(name);
    is_first = false;
  }
  return out + ", NaN with points lc \"black\" pt 6 title \"hollow: misses somebody\"\n";
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
  std::string out = "# gnuplot -c THIS chart.svg chart.png\n" + palette() + data_of(curves);
  out += "set title " + title_of(axes) + "\n";
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

std::string panels_script(const PlotAxes& axes, const std::vector<PlotPanel>& panels) {
  std::map<std::string, int> styles;
  std::string out = "# gnuplot -c THIS chart.svg chart.png\n" + palette(), plots;
  for (const PlotPanel& panel : panels) {
    for (const auto& [name, points] : panel.curves) styles.try_emplace(name, 0);
  }
  int style = 0, first = 0;
  for (auto& [name, number] : styles) number = ++style;
  for (const PlotPanel& panel : panels) {
    out += data_of(panel.curves, first);
    plots += panel_of(panel, first, styles);
    first += static_cast<int>(panel.curves.size());
  }
  const int cells = static_cast<int>(panels.size()) + 1, down = (cells + panels_across - 1) / panels_across;
  const std::string before = "set multiplot layout " + std::to_string(down) + ", " + std::to_string(panels_across) +
                             " title " + title_of(axes) + "\nset xlabel " + quoted(axes.x) + "\nset ylabel " +
                             quoted(axes.y) + "\nset logscale " + (axes.log_x ? "xy" : "y") + "\nset grid\n" + tics() +
                             "set border\nset autoscale xfix\nset autoscale yfix\nset offsets graph "
                             "0.05, graph 0.05, graph 0.1, graph 0.05\nunset key\n";
  const std::string size = "size 1200," + std::to_string(340 * down + 60);
  out += "set terminal svg " + size + " noenhanced font \"sans,12\" background \"white\"\nset output ARG1\n" + before +
         plots + key_of(styles) + "unset multiplot\n";
  out += "set terminal pngcairo " + size + " noenhanced font \"sans,10\"\nset output ARG2\n" + before + plots +
         key_of(styles) + "unset multiplot\nset output\n";
  return out;
}

void sort_points(PlotCurves& curves) {
  for (auto& [name, points] : curves) {
    std::sort(points.begin(), points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  }
}

}  // namespace gridcull
