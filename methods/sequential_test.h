// Sequential probability ratio test: how many rays until it is clear whether an object is visible from a cell?
#pragma once

#include <cstdint>
#include <vector>

namespace gridcull {

/// Gotsman, Sudarsky, Fayman 1999, section 5 (after Wald, "Sequential Analysis", 1947): a share s of an object's
/// surface is visible, s uniform in [0, 1] beforehand; r rays were cast and h of them hit. Likelihoods of s >= s_thresh
/// and s <= s_thresh are incomplete beta functions; rays are cast while b <= ratio <= a.
///
/// Tabulated by h, as the paper suggests: whole numbers of rays, so that nothing but the table's making rests on the
/// C library's last bits.
class SequentialTest {
 public:
  enum class Verdict { open, visible, invisible };

  /// 0 < s_thresh < 1, 0 < b <= 1 <= a.
  SequentialTest(double s_thresh, double a, double b);

  /// 0 <= hits <= rays.
  Verdict judge(std::uint32_t hits, std::uint32_t rays) const;
  /// Rays after which an object that none of them hit is invisible.
  std::uint32_t rays_without_hit() const { return invisible_from_.front(); }

 private:
  // By number of hits: visible at this many rays or fewer, invisible at this many or more. More hits than the
  // tables have lines: visible.
  std::vector<std::uint32_t> visible_to_{}, invisible_from_{};
};

/// Likelihood of "visible" over that of "invisible".
double likelihood_ratio(double s_thresh, std::uint32_t hits, std::uint32_t rays);

}  // namespace gridcull
