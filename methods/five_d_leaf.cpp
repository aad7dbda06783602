// One sequential test for each member and each eighth of a turn in which it may lie; a ray counts for the eighth that
// it runs in. A box test rules eighths out without a ray.
//
// Changed: what a ray hit is visible at once, whatever the share of its surface (`significant` turns that off). An
// eighth in which few lines of sight run at the object may stay undecided for long; then the object is visible there
// when it was hit in any eighth, and invisible where none of the lines drawn ran there at all.
#include "gridcull/methods/five_d_leaf.h"

#include <algorithm>
#include <cmath>

namespace gridcull {
namespace {

using Verdict = SequentialTest::Verdict;

/// The tests of one member.
class MemberTests {
 public:
  MemberTests(const SequentialTest& test, bool significant, unsigned open)
      : test_(test), significant_(significant), open_(open) {}

  bool open(int eighth) const { return (open_ >> eighth & 1) != 0; }
  bool any_open() const { return open_ != 0; }
  void count(int eighth, bool hit) {
    const auto k = static_cast<std::size_t>(eighth);
    ++rays_[k];
    if (hit) ++hits_[k], hit_ = true;
    Verdict verdict = test_.judge(hits_[k], rays_[k]);
    if (!significant_ && hits_[k] > 0) verdict = Verdict::visible;
    if (verdict == Verdict::open) return;
    open_ &= ~(1u << k);
    if (verdict == Verdict::visible) visible_ |= 1u << k;
  }
  /// The eighths in which it is visible, those that stayed open included.
  unsigned visible() const {
    unsigned out = visible_;
    for (std::size_t k = 0; k < rays_.size(); ++k) {
      if (hit_ && rays_[k] > 0) out |= open_ & 1u << k;
    }
    return out;
  }

 private:
  const SequentialTest& test_;
  bool significant_;
  unsigned open_, visible_ = 0;
  bool hit_ = false;
  std::array<std::uint32_t, 8> hits_{}, rays_{};
};

int eighth_of(double turn, bool intervals) {
  return intervals ? static_cast<int>(std::clamp(std::floor(turn), 0.0, 7.0)) : 0;
}

/// The eighths that the cell has.
LeafSets empty_sets(const FiveDScene& scene, const FiveDOptions& options, const ViewCell& cell) {
  LeafSets sets;
  if (options.intervals > 1) {
    sets.first = static_cast<int>(std::floor(cell.low[turn_axis]));
    sets.count = static_cast<int>(std::ceil(cell.high[turn_axis])) - sets.first;
  }
  sets.words.assign(static_cast<std::size_t>(sets.count) * scene.space().words(), 0);
  return sets;
}

}  // namespace

LeafSets judge_leaf(const FiveDScene& scene, const FiveDOptions& options, const SequentialTest& test,
                    const CellWork& work, FiveDScene::Scratch& scratch, std::uint64_t& cast) {
  const bool intervals = options.intervals > 1;
  LeafSets sets = empty_sets(scene, options, work.cell);
  constexpr std::uint64_t other_numbers = 0x5851'F42D'4C95'7F2Dull;  // than the estimate's
  CellRays rays(scene, work.cell, work.seed ^ other_numbers, scratch);
  if (rays.solid()) return sets;
  const std::size_t words = scene.space().words();
  std::size_t next = 0;
  for (std::uint32_t member = 0; member < scene.members(); ++member) {
    const unsigned touched = rays.eighths(member);
    MemberTests tests(test, options.significant, intervals ? touched : (touched != 0 ? 1u : 0u));
    for (; next < work.rays.size() && work.rays[next].member == member; ++next) {
      const int eighth = eighth_of(static_cast<double>(work.rays[next].at[turn_axis]), intervals);
      if (tests.open(eighth)) tests.count(eighth, work.rays[next].hit);
    }
    KeptRay ray{};
    for (std::uint32_t aims = 6 * test.rays_without_hit(); aims > 0 && tests.any_open(); --aims) {
      if (!rays.aim(member, ray)) continue;
      const int eighth = eighth_of(static_cast<double>(ray.at[turn_axis]), intervals);
      if (!tests.open(eighth)) continue;
      rays.cast(ray);
      tests.count(eighth, ray.hit);
    }
    const unsigned visible = tests.visible();
    for (int k = 0; k < sets.count; ++k) {
      if ((visible >> (intervals ? sets.first + k : 0) & 1) == 0) continue;
      sets.words[static_cast<std::size_t>(k) * words + member / 64] |= std::uint64_t{1} << (member % 64);
    }
  }
  cast += rays.cast_count();
  return sets;
}

}  // namespace gridcull
