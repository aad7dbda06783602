// The exact sets of some frames and viewers, found once and held against every contender.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "gridcull/core/exact.h"
#include "gridcull/service/judge.h"
#include "gridcull/sim/world.h"

namespace gridcull {

/// Sums over what was judged of one contender.
struct BenchVerdict {
  std::uint64_t queries = 0, exact = 0, reported = 0, misses = 0, unconfirmed = 0;
};

class BenchReferee {
 public:
  /// Judges `frames` of `all` frames, evenly spread (the first and the last among them when there are two or more), and
  /// in each at most ten of its views; with `rays` along an edge in 3D. 0 frames: none.
  BenchReferee(int dimension, std::uint64_t frames, std::uint64_t all, int rays);

  bool judges(std::uint64_t frame) const;
  /// Finds the exact sets; `world` is how it stands in this frame. Throws Stopped on Ctrl-C.
  void prepare(std::uint64_t frame, const World& world, std::span<const View> views);
  /// Adds a contender's answers to its verdict. Nothing where the frame was not prepared.
  void judge(std::uint64_t frame, const Answers& answers, BenchVerdict& verdict) const;
  /// Of each frame that was prepared with all its views: how many objects they see together.
  std::vector<std::pair<std::uint64_t, double>> exact() const;

 private:
  struct Prepared {
    std::vector<std::size_t> chosen;  ///< places in the views
    bool all = false;                 ///< all of them
    std::vector<View> views;
    std::vector<ExactAnswer> exact;
    std::unique_ptr<ExactRays> rays;  ///< 3D
  };
  int dimension_;
  int rays_;
  std::vector<std::uint64_t> frames_{};
  std::map<std::uint64_t, Prepared> prepared_{};
};

}  // namespace gridcull
