// Worlds that stand still, in part or as a whole.
//
// Walkthroughs of mostly static worlds (Batagelo and Wu 2002, section 6, second test): of a made scene only the first
// few objects move.
#pragma once

#include <cstdint>
#include <memory>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// Objects from id `moving` on become static.
void keep_still(Scene& scene, std::uint32_t moving);

/// The frames of `all` without the moves of those.
class FewMovers final : public FrameSource {
 public:
  FewMovers(std::unique_ptr<FrameSource> all, std::uint32_t moving);
  bool next(Frame& out) override;

 private:
  std::unique_ptr<FrameSource> all_;
  std::uint32_t moving_;
};

/// So many frames a tenth of a second apart in which nothing happens: what a scene without frames costs once it is
/// built.
class StillFrames final : public FrameSource {
 public:
  explicit StillFrames(std::uint64_t frames) : frames_(frames) {}
  bool next(Frame& out) override;

 private:
  std::uint64_t next_ = 0, frames_;
};

}  // namespace gridcull
