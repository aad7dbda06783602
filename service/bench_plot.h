// Plots as gnuplot scripts that hold their data.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace gridcull {

/// A point of a curve.
struct PlotPoint {
  double x = 0.0, y = 0.0;
  std::string text{};
  bool missed = false;  ///< somebody was: a hollow mark
};
using PlotCurves = std::map<std::string, std::vector<PlotPoint>>;  // by name

struct PlotAxes {
  std::string title, x, y;
  bool log_x = true;
  bool labels = false;  ///< points carry their setting
};

/// Letters, digits and the like; everything else becomes "-".
std::string plot_file_name(const std::string& text);

/// Along x.
void sort_points(PlotCurves& curves);

/// ARG1 is the SVG to write, ARG2 the PNG.
std::string plot_script(const PlotAxes& axes, const PlotCurves& curves);

/// One picture of several plots, each with a title of its own, and a key for all: a curve's name has the same colour
/// everywhere. Of `axes` the labels are not drawn.
struct PlotPanel {
  std::string title{};
  PlotCurves curves{};
};
std::string panels_script(const PlotAxes& axes, const std::vector<PlotPanel>& panels);

}  // namespace gridcull
