// Speed against accuracy: which settings of a method are worth taking.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace gridcull {

/// How one setting did.
struct SpeedAccuracy {
  double time = 0.0;      ///< a frame, in any unit
  double reported = 0.0;  ///< objects, in any unit; fewer are tighter
  bool usable = true;     ///< it ran and missed nobody
};

/// Times that differ by less count as equal: that much is noise.
inline constexpr double same_time = 0.05;

/// `a` beats `b` when it is tighter and not slower, or as tight and faster, where only more than same_time is faster or
/// slower. What beats is tighter or as tight and faster: nothing is beaten by what it beats, and something never is.
bool beats(const SpeedAccuracy& a, const SpeedAccuracy& b);

struct Standing {
  bool on_frontier = false;              ///< usable, and none beats it
  std::optional<std::size_t> beaten_by;  ///< the tightest that does; one on the frontier where there is one
};

/// In the order of the settings. What is not usable neither beats nor is beaten.
std::vector<Standing> find_frontier(std::span<const SpeedAccuracy> settings);

/// Places among the settings, all on the frontier. Of alike ones the first.
struct Picks {
  std::size_t fastest = 0, tightest = 0;
  std::size_t standard = 0;  ///< the fastest that reports at most `looser` more than the tightest
};
inline constexpr double looser = 0.1;

/// Nothing where none is usable.
std::optional<Picks> pick(std::span<const SpeedAccuracy> settings);

}  // namespace gridcull
