#include <gridcull/methods/catalog.h>
#include <gridcull/sim/replay.h>

#include "sight.h"

using namespace gridcull;

namespace {

/// Hands on the frame that it is given.
class OneFrame final : public FrameSource {
 public:
  bool next(Frame& out) override {
    out = *frame_;
    return true;
  }
  void give(const Frame& frame) { frame_ = &frame; }

 private:
  const Frame* frame_ = nullptr;
};

class EmbeddedSight final : public Sight {
 public:
  explicit EmbeddedSight(const Scene& scene)
      : culler_(make_method(default_method(), options_for(scene))), replay_(*culler_, scene, &frames_) {}

  const Answers& see(const Frame& frame) override {
    frames_.give(frame);
    replay_.step();
    return replay_.answers();
  }

 private:
  static MethodOptions options_for(const Scene& scene) {
    MethodOptions out;
    out.dimension = scene.dimension;
    out.bounds = scene.bounds.value();
    out.cell = scene.cell.value();
    return out;
  }

  OneFrame frames_;
  std::unique_ptr<Culler> culler_;
  Replay replay_;
};

}  // namespace

std::unique_ptr<Sight> make_embedded_sight(const Scene& scene) { return std::make_unique<EmbeddedSight>(scene); }
