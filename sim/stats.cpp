#include "gridcull/sim/stats.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

#include "gridcull/sim/json_text.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

double mean_of(std::uint64_t sum, std::uint64_t count) {
  return count == 0 ? 0.0 : static_cast<double>(sum) / static_cast<double>(count);
}

void append_value(std::string& out, std::string_view key, double value) {
  append_key(out, key);
  append_number(out, value);
}

void append_count(std::string& out, std::string_view key, std::uint64_t value) {
  append_key(out, key);
  append_integer(out, value);
}

void append_tbv(std::string& out, const Stats& stats) {
  append_key(out, "tbv");
  out += '{';
  append_value(out, "active_mean", stats.tbv_active_mean);
  append_count(out, "revealed", stats.tbv_revealed);
  append_count(out, "expired", stats.tbv_expired);
  append_count(out, "jumps", stats.jumps);
  out += '}';
}

void append_spread(std::string& out, std::string_view key, const Spread& spread) {
  append_key(out, key);
  out += '{';
  append_value(out, "median", spread.median);
  append_value(out, "mean", spread.mean);
  append_value(out, "p99", spread.p99);
  append_value(out, "max", spread.max);
  out += '}';
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  double sum = 0.0;
  for (const double value : values) sum += value;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const std::size_t rank = (99 * n + 99) / 100;  // ceil(0.99 n), from 1
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), sum / static_cast<double>(n), values[rank - 1], values.back()};
}

void StatsCollector::add(const Answers& answers, std::uint64_t in_view) {
  in_view_ += in_view;
  const FrameStats& frame = answers.stats;
  const std::array<double, 5> times{frame.discretise_us, frame.traverse_us, frame.occlude_us, frame.collect_us,
                                    frame.total_us};
  for (std::size_t i = 0; i < times.size(); ++i) times_[i].push_back(times[i]);
  positions_ += frame.positions_read;
  tbv_active_ += frame.tbv_active;
  tbv_revealed_ += frame.tbv_revealed;
  tbv_expired_ += frame.tbv_expired;
  jumps_ += frame.jumps;
  queries_ += answers.views.size();
  for (const Answer& answer : answers.views) {
    visible_ += answer.visible.size();
    cells_ += answer.work.cells_visited;
    hash_.add(answer);
  }
}

Stats StatsCollector::stats() const {
  Stats out;
  out.frames = times_[0].size();
  out.queries = queries_;
  out.discretise_us = spread_of(times_[0]);
  out.traverse_us = spread_of(times_[1]);
  out.occlude_us = spread_of(times_[2]);
  out.collect_us = spread_of(times_[3]);
  out.total_us = spread_of(times_[4]);
  out.pvs_mean = mean_of(visible_, queries_);
  out.in_view_mean = mean_of(in_view_, queries_);
  out.positions_read_mean = mean_of(positions_, out.frames);
  out.tbv_active_mean = mean_of(tbv_active_, out.frames);
  out.tbv_revealed = tbv_revealed_;
  out.tbv_expired = tbv_expired_;
  out.jumps = jumps_;
  out.cells_visited_mean = mean_of(cells_, queries_);
  out.pvs_hash = hash_.value();
  return out;
}

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;  // Linux counts in KiB
}

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::string hash_text(std::uint64_t hash) {
  std::array<char, 16> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), hash, 16).ptr;
  const std::string text(digits.data(), end);
  return std::string(16 - text.size(), '0') + text;
}

std::string stats_text(const Stats& stats) {
  std::string out = "{\"format\": \"gridcull.stats/1\"";
  append_key(out, "method");
  append_string(out, stats.method);
  append_count(out, "threads", static_cast<std::uint64_t>(stats.threads));
  append_count(out, "frames", stats.frames);
  append_count(out, "queries", stats.queries);
  append_value(out, "cell", stats.cell);
  append_key(out, "cells");
  out += '[';
  for (const std::int64_t cells : stats.cells) {
    append_comma(out);
    append_integer(out, static_cast<std::uint64_t>(cells));
  }
  out += "],\n  \"time_us\": {";
  append_spread(out, "discretise", stats.discretise_us);
  append_spread(out, "traverse", stats.traverse_us);
  append_spread(out, "occlude", stats.occlude_us);
  append_spread(out, "collect", stats.collect_us);
  append_spread(out, "total", stats.total_us);
  out += "},\n  \"pvs_mean\": ";
  append_number(out, stats.pvs_mean);
  append_value(out, "in_view_mean", stats.in_view_mean);
  append_value(out, "positions_read_mean", stats.positions_read_mean);
  append_tbv(out, stats);
  append_value(out, "cells_visited_mean", stats.cells_visited_mean);
  append_count(out, "peak_memory_bytes", stats.peak_memory_bytes);
  append_key(out, "pvs_hash");
  append_string(out, hash_text(stats.pvs_hash));
  return out + "}\n";
}

void write_stats(const std::string& path, const Stats& stats) { write_text(path, stats_text(stats)); }

}  // namespace gridcull
