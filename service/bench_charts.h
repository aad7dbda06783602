// Charts of a benchmark as gnuplot scripts that hold their data; run by service/gnuplot.h, or by hand later.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gridcull/service/bench_plot.h"
#include "gridcull/service/bench_run.h"

namespace gridcull {

struct Chart {
  std::string name{};    ///< of its files, without ending
  std::string script{};  ///< ARG1 is the SVG to write, ARG2 the PNG
};

/// Speed against accuracy for each scene, time against hidden objects and time against viewers where scenes of a family
/// or several numbers of threads were run.
std::vector<Chart> bench_charts(std::span<const BenchSceneResult> results);

/// Median microseconds a frame against over-estimation on one thread, a curve a method.
PlotCurves accuracy_curves(const BenchSceneResult& result);

}  // namespace gridcull
