#include "gridcull/service/bench_report.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <string_view>

#include "gridcull/service/build_facts.h"
#include "gridcull/service/run_report.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/stats.h"

namespace gridcull {
namespace {

constexpr std::array columns{"scene",
                             "dimension",
                             "objects",
                             "movers",
                             "viewers",
                             "method",
                             "guarantee",
                             "setting_name",
                             "setting",
                             "is_default",
                             "threads",
                             "frames",
                             "repeats",
                             "queries",
                             "frame_us_min",
                             "frame_us_median",
                             "frame_us_max",
                             "frame_us_median_all",
                             "moves_us_median",
                             "query_us_median",
                             "first_frame_us",
                             "load_us",
                             "over_estimation",
                             "exact_mean",
                             "judged_queries",
                             "misses",
                             "missed_share",
                             "unconfirmed",
                             "pvs_mean",
                             "positions_read_mean",
                             "memory_bytes",
                             "bake_seconds",
                             "bake_threads",
                             "baked_bytes",
                             "cells_visited_mean",
                             "object_tests_mean",
                             "occluders_mean",
                             "rasters_mean",
                             "pvs_hash",
                             "refused"};

std::string number(double value) { return std::isfinite(value) ? number_text(value, 6) : std::string(); }

double missed_share(const BenchRow& row) {
  return row.verdict.exact == 0 ? std::nan("")
                                : static_cast<double>(row.verdict.misses) / static_cast<double>(row.verdict.exact);
}

std::vector<std::string> identity(const BenchSceneResult& result, const BenchRow& row) {
  const Contender& c = row.contender;
  return {result.label,
          std::to_string(result.dimension),
          std::to_string(result.objects),
          std::to_string(result.movers),
          std::to_string(result.viewers),
          std::string(c.method->info.name),
          guarantee_text(c.method->info.guarantee),
          c.setting_name,
          c.setting,
          c.is_default ? "1" : "0",
          std::to_string(c.options.threads)};
}

std::vector<std::string> figures(const BenchRow& row) {
  const TimeSamples::Summary total = row.total.steady();
  const BenchVerdict& v = row.verdict;
  const bool judged = v.queries > 0;
  const BakeCost& bake = row.contender.bake;
  const bool baked = bake.bytes > 0;
  return {std::to_string(row.frames),
          std::to_string(row.repeats),
          std::to_string(row.queries),
          number(total.min),
          number(total.median),
          number(total.max),
          number(total.median_all),
          number(row.moves.steady().median),
          number(row.query.steady().median),
          number(row.total.empty() ? std::nan("") : row.total.least(0)),
          number(row.load_us),
          number(row.over_estimation()),
          judged ? number(static_cast<double>(v.exact) / static_cast<double>(v.queries)) : "",
          judged ? std::to_string(v.queries) : "",
          judged ? std::to_string(v.misses) : "",
          number(missed_share(row)),
          judged ? std::to_string(v.unconfirmed) : "",
          number(row.pvs_mean),
          number(row.positions_read_mean),
          std::to_string(row.memory_bytes),
          baked ? number(bake.seconds) : "",
          baked ? std::to_string(bake.threads) : "",
          baked ? std::to_string(bake.bytes) : "",
          number(row.cells_visited),
          number(row.object_tests),
          number(row.occluders),
          number(row.rasters),
          hash_text(row.hash)};
}

std::string time_text(double us) {
  if (us >= 10000.0) return number_text(us / 1000.0, 4) + " ms";
  return number_text(us, us >= 1000.0 ? 4 : 3) + " us";
}

std::string misses_text(const BenchRow& row) {
  if (row.verdict.queries == 0) return "-";
  std::string text = std::to_string(row.verdict.misses);
  if (row.verdict.misses > 0) text += " (" + number_text(100.0 * missed_share(row), 2) + " %)";
  return text;
}

std::string table_row(const BenchRow& row) {
  char line[240];
  const std::string name = row.contender.label();
  if (!row.refused.empty()) {
    std::snprintf(line, sizeof line, "  %-46s did not run: ", name.c_str());
    return line + row.refused + "\n";
  }
  const TimeSamples::Summary total = row.total.steady();
  const double over = row.over_estimation();
  std::snprintf(line, sizeof line, "  %-46s %10s %10s %10s %8s %14s %9s\n", name.c_str(), time_text(total.min).c_str(),
                time_text(total.median).c_str(), time_text(row.moves.steady().median).c_str(),
                std::isnan(over) ? "-" : number_text(over, 4).c_str(), misses_text(row).c_str(),
                bytes_text(static_cast<double>(row.memory_bytes)).c_str());
  return line;
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string bench_head(const BenchSettings& settings) {
  const BuildFacts facts = build_facts();
  return "# gridcull bench, " + date_text() + "\n# commit: " + facts.commit + "\n# compiler: " + facts.compiler +
         "\n# flags: " + facts.flags + "\n# processor: " + processor_name() +
         "\n# frames: " + std::to_string(settings.frames) + " at most, repeats: " + std::to_string(settings.repeats) +
         ", judged frames: " + std::to_string(settings.judged) +
         ", rays of the 3D reference: " + std::to_string(settings.rays) +
         (settings.pull ? "\n# positions: asked for (pull)" : "") +
         "\n# times: microseconds a frame over all viewers, moves and query; least over repeats of each frame, then "
         "over frames but the first\n";
}

std::string bench_csv(std::span<const BenchSceneResult> results) {
  std::string out;
  for (const char* column : columns) out += std::string(out.empty() ? "" : ",") + column;
  out += "\n";
  for (const BenchSceneResult& result : results) {
    for (const BenchRow& row : result.rows) {
      std::vector<std::string> fields = identity(result, row);
      for (std::string& field : figures(row)) fields.push_back(std::move(field));
      fields.push_back(row.refused);
      for (std::size_t i = 0; i < fields.size(); ++i) out += (i == 0 ? "" : ",") + csv_field(fields[i]);
      out += "\n";
    }
  }
  return out;
}

std::string bench_table(const BenchSceneResult& result) {
  std::string out = result.label + ": " + std::to_string(result.dimension) + "D, " + counted(result.objects, "object") +
                    " (" + std::to_string(result.movers) + " moving), " + counted(result.viewers, "viewer");
  if (std::isfinite(result.exact_mean)) {
    out += std::string(", ") + (result.dimension == 3 ? "at least " : "") + number_text(result.exact_mean, 4) +
           " visible to a viewer";
  }
  char line[200];
  std::snprintf(line, sizeof line, "\n  %-46s %10s %10s %10s %8s %14s %9s\n", "", "frame, min", "median", "its moves",
                "over-est", "misses", "memory");
  out += line;
  for (const BenchRow& row : result.rows) out += table_row(row);
  std::set<std::string_view> told;
  for (const BenchRow& row : result.rows) {
    const BakeCost& bake = row.contender.bake;
    if (bake.bytes == 0 || !told.insert(row.contender.method->info.name).second) continue;
    out += "  " + std::string(row.contender.method->info.name) + " was baked in " + number_text(bake.seconds, 3) +
           " s on " + counted(static_cast<unsigned long long>(bake.threads), "thread") + ": " +
           bytes_text(static_cast<double>(bake.bytes)) + "\n";
  }
  return out;
}

}  // namespace gridcull
