#include "gridcull/service/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <unistd.h>

namespace gridcull {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto patience = std::chrono::milliseconds(500);
constexpr auto interval = std::chrono::milliseconds(100);

}  // namespace

bool Progress::is_seen() { return isatty(STDERR_FILENO) == 1; }

Progress::Progress(std::string what, std::optional<std::uint64_t> total)
    : what_(std::move(what)), total_(total), seen_(is_seen()), start_(Clock::now()), next_(start_ + patience) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::update(std::uint64_t done) {
  if (!seen_) return;
  const auto now = Clock::now();
  if (now < next_) return;
  next_ = now + interval;
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r\033[K%s", progress_text(what_, done, total_, seconds, 40).c_str());
  std::fflush(stderr);
}

std::string progress_text(const std::string& what, std::uint64_t done, std::optional<std::uint64_t> total,
                          double seconds, int width) {
  char rate[48] = "";
  if (seconds > 0.0) std::snprintf(rate, sizeof rate, ", %.0f a second", static_cast<double>(done) / seconds);
  if (!total || *total == 0) return std::to_string(done) + " " + what + rate;
  const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(*total));
  const auto full = static_cast<std::size_t>(part * width);
  return "[" + std::string(full, '#') + std::string(static_cast<std::size_t>(width) - full, '.') + "] " +
         std::to_string(done) + "/" + std::to_string(*total) + " " + what + rate;
}

}  // namespace gridcull
