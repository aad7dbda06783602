#include "gridcull/service/bench_output.h"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/service/gnuplot.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {

namespace fs = std::filesystem;

struct BenchOutput::Detail {
  fs::path folder;
  bool made = false, committed = false;
  std::optional<TextWriter> csv{};
  std::vector<std::pair<fs::path, fs::path>> parts{};  ///< drawn beside its name, name

  explicit Detail(fs::path path) : folder(std::move(path)) {}
  Detail(const Detail&) = delete;
  Detail& operator=(const Detail&) = delete;
  ~Detail() {
    std::error_code none;
    for (const auto& [part, name] : parts) fs::remove(part, none);
    csv.reset();
    if (made && !committed) fs::remove(folder, none);  // only when empty
  }

  std::string part_of(const std::string& name) {
    parts.emplace_back(folder / ("." + name + ".part"), folder / name);
    return parts.back().first.string();
  }
};

BenchOutput::BenchOutput(const std::string& folder) : detail_(std::make_unique<Detail>(folder)) {
  Detail& d = *detail_;
  std::error_code fault;
  d.made = fs::create_directories(d.folder, fault);
  if (fault || !fs::is_directory(d.folder)) {
    throw Error(ErrorCode::io, folder + ": cannot be made a folder: " + (fault ? fault.message() : "it is a file"));
  }
  d.csv.emplace((d.folder / "bench.csv").string());
}
BenchOutput::~BenchOutput() = default;

void BenchOutput::commit(const std::string& csv, std::span<const Chart> charts, const std::string& gnuplot) {
  Detail& d = *detail_;
  d.csv->write(csv);
  for (const Chart& chart : charts) {
    stop_if_interrupted();
    const std::string script = d.part_of(chart.name + ".gp");
    write_text(script, chart.script);
    if (gnuplot.empty()) continue;
    const std::string svg = d.part_of(chart.name + ".svg"), png = d.part_of(chart.name + ".png");
    run_gnuplot(gnuplot, script, svg, png);
  }
  stop_if_interrupted();
  // The one step that may find the disk full comes first: then there is nothing.
  d.csv->commit();
  d.committed = true;
  for (const auto& [part, name] : d.parts) {
    std::error_code fault;
    fs::rename(part, name, fault);
    if (fault) throw Error(ErrorCode::io, name.string() + ": cannot be written: " + fault.message());
  }
  d.parts.clear();
}

}  // namespace gridcull
