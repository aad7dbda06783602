#include "gridcull/methods/sequential_test.h"

#include <cmath>
#include <limits>

#include <boost/math/special_functions/beta.hpp>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

/// The tables end where an invisible object would take this many times the rays of one that is never hit.
constexpr std::uint32_t table_span = 16;

}  // namespace

// The integrals of t^h (1-t)^(r-h) over [s, 1] and [0, s] share the factor b(h+1, r-h+1), the complete beta function.
double likelihood_ratio(double s_thresh, std::uint32_t hits, std::uint32_t rays) {
  const double z = hits + 1.0, w = static_cast<double>(rays - hits) + 1.0;
  const double below = boost::math::ibeta(z, w, s_thresh);
  return below > 0.0 ? boost::math::ibetac(z, w, s_thresh) / below : std::numeric_limits<double>::infinity();
}

// For a given h the ratio falls with every further miss, so each line of the tables is found by going on from the last.
SequentialTest::SequentialTest(double s_thresh, double a, double b) {
  if (!(s_thresh > 0.0 && s_thresh < 1.0 && b > 0.0 && b <= 1.0 && a >= 1.0)) {
    throw Error(ErrorCode::usage, "sequential test: expected 0 < s-thresh < 1 and 0 < b <= 1 <= a");
  }
  std::uint32_t visible = 0, invisible = 0;
  for (std::uint32_t hits = 0;; ++hits) {
    visible = std::max(visible, hits);
    // No hit yet: with a small s_thresh the prior alone makes the ratio large; a ray must hit all the same.
    while (hits > 0 && likelihood_ratio(s_thresh, hits, visible + 1) > a) ++visible;
    const bool none = hits == 0 || !(likelihood_ratio(s_thresh, hits, hits) > a);
    invisible = std::max(invisible, hits + 1);
    while (!(likelihood_ratio(s_thresh, hits, invisible) < b)) ++invisible;
    if (hits > 0 && invisible > table_span * invisible_from_.front()) return;
    visible_to_.push_back(none ? 0 : visible);
    invisible_from_.push_back(invisible);
  }
}

SequentialTest::Verdict SequentialTest::judge(std::uint32_t hits, std::uint32_t rays) const {
  if (hits >= invisible_from_.size()) return Verdict::visible;
  if (rays >= invisible_from_[hits]) return Verdict::invisible;
  return hits > 0 && rays <= visible_to_[hits] ? Verdict::visible : Verdict::open;
}

}  // namespace gridcull
