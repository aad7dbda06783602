// Statistics of a run, as files of the format `gridcull.stats/1`.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/core/hash.h"

namespace gridcull {

/// Of one quantity over frames.
struct Spread {
  double median = 0.0;  ///< of an even number: the mean of the middle two
  double mean = 0.0;
  double p99 = 0.0;  ///< nearest rank: the smallest value that at least 99 % do not exceed
  double max = 0.0;
};

Spread spread_of(std::vector<double> values);

/// What a run cost and gave. Means of counts are per query, those of positions_read and tbv per frame.
struct Stats {
  std::string method{};
  int threads = 1;
  std::uint64_t frames = 0;
  std::uint64_t queries = 0;
  double cell = 0.0;                                                              ///< metres
  std::vector<std::int64_t> cells{};                                              ///< along each axis
  Spread discretise_us{}, traverse_us{}, occlude_us{}, collect_us{}, total_us{};  ///< per frame, all viewers
  double pvs_mean = 0.0;
  double in_view_mean = 0.0;
  double positions_read_mean = 0.0;
  double tbv_active_mean = 0.0;
  std::uint64_t tbv_revealed = 0;
  std::uint64_t tbv_expired = 0;
  std::uint64_t jumps = 0;
  double cells_visited_mean = 0.0;
  std::uint64_t peak_memory_bytes = 0;
  std::uint64_t pvs_hash = 0;  ///< core/hash.h over all answers; 16 hexadecimal digits in the file
};

/// Collects a run, frame by frame.
class StatsCollector {
 public:
  /// `in_view`: count_in_view() of the frame, where it was counted.
  void add(const Answers& answers, std::uint64_t in_view = 0);
  /// All that answers tell; method, threads, cell, cells and peak_memory_bytes are the caller's.
  Stats stats() const;

 private:
  std::array<std::vector<double>, 5> times_{};
  std::uint64_t queries_ = 0, visible_ = 0, in_view_ = 0, positions_ = 0, cells_ = 0;
  std::uint64_t tbv_active_ = 0, tbv_revealed_ = 0, tbv_expired_ = 0, jumps_ = 0;
  StableHash hash_{};
};

/// Greatest resident memory of this process so far, bytes.
std::uint64_t peak_memory_bytes();
/// Resident memory of this process now, bytes; 0 where the system does not say.
std::uint64_t resident_bytes();

/// A hash as it stands in files: 16 hexadecimal digits.
std::string hash_text(std::uint64_t hash);

std::string stats_text(const Stats& stats);
/// "-" is standard output. The file appears whole or not at all. Throws Error(io).
void write_stats(const std::string& path, const Stats& stats);

}  // namespace gridcull
