// T. Hudson, D. Manocha, J. Cohen, M. Lin, K. Hoff, H. Zhang, "Accelerated occlusion culling using shadow frusta",
// SoCG 1997.
//
// Each frame and viewer the few parts that promise most are chosen (occluder_choice.h), their frusta built
// (shadow_frustum.h), and two box hierarchies, of static and of moving objects, traversed against the view volume and
// all frusta at once (shadow_walk.h). Changed: the paper's occluders are static; here movers occlude too, chosen anew
// in each frame. A candidate that lies wholly in the shadow of one chosen before is passed over.
//
// What hides and why nothing is missed is argued in shadow_frustum.h; choice and coherence only decide which frusta are
// tried. What holds the viewpoint and what the viewer rides on is never chosen; near and far do not matter for
// occluders, since a ray to a point of the view volume stays within the volume's sides.
//
// One thread. Counts: cells_visited are boxes of the hierarchies looked at, cells_hidden those found wholly hidden,
// object_tests objects looked at, occluders the frusta used, rasters tests against a plane.
#include "gridcull/methods/shadow_frusta.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/methods/lap.h"
#include "gridcull/methods/shadow_walk.h"
#include "gridcull/methods/shadow_world.h"
#include "gridcull/methods/world_culler.h"

namespace gridcull {
namespace {

class ShadowFrusta final : public WorldCuller<ShadowWorld> {
 public:
  explicit ShadowFrusta(const ShadowFrustaOptions& options)
      : WorldCuller(options.dimension, options.bound),
        options_(options),
        choice_(static_cast<std::size_t>(options.occluders), options.weights) {}

  const MethodInfo& info() const override { return shadow_frusta_info(); }

  void query(double time, std::span<const View> views, Answers& out) override {
    Lap whole, lap;
    FrameStats stats;
    world_.begin_frame(time, views, stats);
    choice_.begin_frame(world_, views.size());
    stats.discretise_us = lap.next();
    out.views.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) answer(views[i], out.views[i], stats);
    stats.total_us = whole.next();
    out.stats = stats;
  }

 private:
  void answer(const View& view, Answer& answer, FrameStats& stats) {
    Lap lap;
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    const ViewTest test(view, world_.dimension());
    find_holders(view.pose.position);
    const auto frusta = choice_.choose(world_, view, test.volume(), holders_);
    answer.work.occluders = frusta.size();
    stats.occlude_us += lap.next();
    walk_.begin({&world_, holders_, frusta, &test, view.rides, options_.unions, options_.exact}, answer);
    walk_.run(world_.static_tree());
    walk_.run(world_.moving_tree());
    choice_.learn(walk_.hidden_by());
    std::sort(answer.visible.begin(), answer.visible.end());
    stats.traverse_us += lap.next();
  }

  /// By place, of both hierarchies.
  void find_holders(const Vec3& eye) {
    near_.clear();
    holders_.clear();
    world_.static_tree().add_at(eye, near_);
    world_.moving_tree().add_at(eye, near_);
    world_.flat().add_holders(eye, near_, holders_);
  }

  ShadowFrustaOptions options_;
  OccluderChoice choice_;
  ShadowWalk walk_{};
  std::vector<std::uint32_t> near_{}, holders_{};
};

}  // namespace

const MethodInfo& shadow_frusta_info() {
  static constexpr MethodInfo info{"shadow-frusta",
                                   "shadow frusta of a few good occluders, Hudson et al. 1997; one thread",
                                   Guarantee::conservative,
                                   true,
                                   true,
                                   true};
  return info;
}

std::unique_ptr<Culler> make_shadow_frusta(const ShadowFrustaOptions& options) {
  if (options.occluders < 1 || options.occluders > static_cast<int>(most_occluders)) {
    throw Error(ErrorCode::usage, "--occluders: expected 1 .. 64, found " + std::to_string(options.occluders));
  }
  return std::make_unique<ShadowFrusta>(options);
}

}  // namespace gridcull
