// Holds answers against the exact reference (core/exact.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/core/exact.h"
#include "gridcull/sim/replay.h"

namespace gridcull {

/// An object that is visible and was not reported.
struct Miss {
  std::uint64_t frame = 0;
  ViewerId viewer = no_id;
  ObjectId object = no_id;
  Vec3 direction{0.0};  ///< unit, in which the viewer sees it; zero: it holds the viewer
};

/// What one view's judgement adds to a verdict.
struct Judgement {
  std::size_t exact = 0;
  std::vector<Miss> misses{};
  std::uint64_t unconfirmed = 0;
};

/// Holds one answer against the exact one. `rays` confirms 3D misses in doubles; nullptr in 2D.
Judgement judge_answer(const ExactAnswer& exact, const Answer& answer, const View& view, const ExactRays* rays,
                       std::uint64_t frame);

struct Verdict {
  std::uint64_t frames = 0;  ///< judged
  std::uint64_t queries = 0;
  std::uint64_t exact = 0;     ///< visible objects, over all queries; in 3D a lower bound
  std::uint64_t reported = 0;  ///< objects in the PVSs
  std::vector<Miss> misses{};
  /// 3D: what a ray in floats saw, the PVS does not hold, and doubles did not confirm. No misses.
  std::uint64_t unconfirmed = 0;

  double exact_mean() const;
  double reported_mean() const;
  /// reported / exact; NaN when nothing is visible.
  double over_estimation() const;
};

class Judge {
 public:
  /// `rays`: see ExactRays; counts in 3D only. Throws Error(usage) where the reference is not there.
  Judge(int dimension, int rays);

  /// Judges the replay's last step. Views are judged in parallel; the verdict does not depend on that.
  /// Throws Stopped on Ctrl-C.
  void judge(const Replay& replay);

  const Verdict& verdict() const { return verdict_; }

 private:
  int dimension_;
  int rays_;
  Verdict verdict_{};
};

}  // namespace gridcull
