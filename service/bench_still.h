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

}  // namespace gridcull
