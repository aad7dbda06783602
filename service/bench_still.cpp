#include "gridcull/service/bench_still.h"

#include <utility>
#include <vector>

namespace gridcull {

void keep_still(Scene& scene, std::uint32_t moving) {
  for (SceneObject& object : scene.objects) {
    if (object.object.id < moving) continue;
    object.object.is_static = true;
    object.object.max_speed.reset();
  }
}

FewMovers::FewMovers(std::unique_ptr<FrameSource> all, std::uint32_t moving) : all_(std::move(all)), moving_(moving) {}

bool FewMovers::next(Frame& out) {
  if (!all_->next(out)) return false;
  std::erase_if(out.set, [&](const ObjectMove& move) { return move.id >= moving_; });
  return true;
}

bool StillFrames::next(Frame& out) {
  if (next_ == frames_) return false;
  out = Frame{};
  out.time = 0.1 * static_cast<double>(next_++);
  return true;
}

}  // namespace gridcull
