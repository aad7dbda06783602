// A progress bar on standard error: only when that is a terminal, and only for work that takes a while.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace gridcull {

class Progress {
 public:
  /// `what`: the unit, as in "frames". Without `total` it counts instead of filling a bar.
  Progress(std::string what, std::optional<std::uint64_t> total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::uint64_t done);

  /// Whether anybody would see it: counting a total beforehand is worth while only then.
  static bool is_seen();

 private:
  std::string what_;
  std::optional<std::uint64_t> total_;
  bool seen_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_, next_;
};

/// The bar's text, `width` characters between the brackets.
std::string progress_text(const std::string& what, std::uint64_t done, std::optional<std::uint64_t> total,
                          double seconds, int width);

}  // namespace gridcull
