// The files of a benchmark in one folder: bench.csv, and each chart as script, SVG and PNG. All or none.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "gridcull/service/bench_charts.h"

namespace gridcull {

class BenchOutput {
 public:
  /// Makes the folder where it is not there and opens bench.csv beside its name: a folder that cannot be written is
  /// refused at once. Throws Error(io).
  explicit BenchOutput(const std::string& folder);
  ~BenchOutput();
  BenchOutput(const BenchOutput&) = delete;
  BenchOutput& operator=(const BenchOutput&) = delete;

  /// Writes everything; without a `gnuplot` the CSV and the scripts only. Throws Error(io), Stopped on Ctrl-C.
  void commit(const std::string& csv, std::span<const Chart> charts, const std::string& gnuplot);

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull
