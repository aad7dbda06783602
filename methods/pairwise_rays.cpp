// For each viewer and each object in its view volume one ray, from the viewpoint to the middle of the object's box
// (in its own axes); the object is reported when no other occluder blocks that segment. What Veins' obstacle shadowing
// (Sommer et al., "A computationally inexpensive empirical model of IEEE 802.11p radio shadowing in urban
// environments", WONS 2011) and most crowd and sensor models do.
//
// Sampled: an object whose middle is hidden and whose rim is not is missed. Never too many: whatever is reported is
// seen, but for objects that touch the view volume with another part than their middle.
//
// Changed, to be a fair peer: buckets over the boxes, apart for static and moving objects, so that a ray looks only at
// what lies along it, and a viewer with a range only at what lies about it; viewers in parallel.
#include "gridcull/methods/pairwise_rays.h"

#include <algorithm>
#include <string>
#include <vector>

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "gridcull/core/error.h"
#include "gridcull/methods/bucket_grid.h"
#include "gridcull/methods/flat_world.h"
#include "gridcull/methods/lap.h"
#include "gridcull/methods/parallel.h"
#include "gridcull/methods/view_test.h"
#include "gridcull/methods/world_culler.h"

namespace gridcull {
namespace {

/// What one thread needs for one viewer; storage is reused.
struct Scratch {
  std::vector<std::uint32_t> near{};     ///< places in objects() at the viewpoint
  std::vector<std::uint32_t> holders{};  ///< those that hold it
  std::vector<std::uint64_t> stamps{};   ///< by place: the query that met it last
  std::uint64_t stamp = 0;
  std::vector<double> cuts{};
  double us = 0.0;
};

class PairwiseRays final : public WorldCuller<FlatWorld> {
 public:
  explicit PairwiseRays(const PairwiseOptions& options)
      : WorldCuller(options.dimension),
        options_(options),
        arena_(std::min(options.threads, tbb::info::default_concurrency())),
        scratches_(static_cast<std::size_t>(arena_.max_concurrency())) {}

  const MethodInfo& info() const override { return pairwise_rays_info(); }

  void query(double time, std::span<const View> views, Answers& out) override {
    Lap whole, lap;
    FrameStats stats;
    world_.begin_frame(time, views, stats);
    index();
    stats.discretise_us = lap.next();
    out.views.resize(views.size());
    for (Scratch& scratch : scratches_) scratch.us = 0.0;
    if (scratches_.size() == 1 || views.size() < 2) {
      for (std::size_t i = 0; i < views.size(); ++i) answer(views[i], scratches_[0], out.views[i]);
    } else {
      for_each_on(arena_, 0, views.size(),
                  [&](std::size_t i, std::size_t worker) { answer(views[i], scratches_[worker], out.views[i]); });
    }
    for (const Scratch& scratch : scratches_) stats.traverse_us += scratch.us;
    stats.total_us = whole.next();
    out.stats = stats;
  }

 private:
  /// Sorts what changed into its buckets.
  void index() {
    if (static_version_ != world_.static_version() || set_version_ != world_.set_version()) build(true);
    if (moving_version_ != world_.moving_version() || set_version_ != world_.set_version()) build(false);
    static_version_ = world_.static_version();
    moving_version_ = world_.moving_version();
    set_version_ = world_.set_version();
  }

  void build(bool statics) {
    items_.clear();
    const auto objects = world_.objects();
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
      if (objects[i].object.is_static == statics) items_.push_back({objects[i].box, i});
    }
    (statics ? static_ : moving_).build(items_, options_.bounds, options_.dimension);
  }

  void answer(const View& view, Scratch& scratch, Answer& answer) const {
    Lap lap;
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    const ViewTest test(view, options_.dimension);
    find_holders(test.volume().apex(), scratch);
    const auto objects = world_.objects();
    if (is_near(test.volume())) {
      look_near(view, test, scratch, answer);
    } else {
      for (std::uint32_t i = 0; i < objects.size(); ++i) look(view, test, i, scratch, answer);
    }
    for (const std::uint32_t i : scratch.holders) {
      if (objects[i].object.id != view.rides) answer.visible.push_back(objects[i].object.id);
    }
    std::sort(answer.visible.begin(), answer.visible.end());
    scratch.us += lap.next();
  }

  /// Whether the buckets about the viewer are fewer than the objects.
  bool is_near(const ViewVolume& volume) const {
    if (!std::isfinite(volume.range())) return false;
    const Bounds box = box_about(volume);
    return static_.buckets_in(box) + moving_.buckets_in(box) < 0.25 * static_cast<double>(world_.objects().size());
  }
  Bounds box_about(const ViewVolume& volume) const {
    Bounds box;
    box.add_ball(volume.apex(), volume.range() * (1.0 + 1e-9));
    if (options_.dimension == 2) box.min.z = box.max.z = 0.0;
    return box;
  }

  void look_near(const View& view, const ViewTest& test, Scratch& scratch, Answer& answer) const {
    if (scratch.stamps.size() < world_.objects().size()) scratch.stamps.resize(world_.objects().size(), 0);
    ++scratch.stamp;
    const auto once = [&](std::uint32_t i) {
      if (scratch.stamps[i] == scratch.stamp) return;
      scratch.stamps[i] = scratch.stamp;
      look(view, test, i, scratch, answer);
    };
    const Bounds box = box_about(test.volume());
    static_.near(box, once);
    moving_.near(box, once);
  }

  void find_holders(const Vec3& point, Scratch& scratch) const {
    scratch.near.clear();
    scratch.holders.clear();
    const auto gather = [&scratch](std::uint32_t i) { scratch.near.push_back(i); };
    static_.near({point, point}, gather);
    moving_.near({point, point}, gather);
    // An item apart, or in one bucket twice: once is enough.
    std::sort(scratch.near.begin(), scratch.near.end());
    scratch.near.erase(std::unique(scratch.near.begin(), scratch.near.end()), scratch.near.end());
    world_.add_holders(point, scratch.near, scratch.holders);
  }
  static bool is_holder(const Scratch& scratch, std::uint32_t i) {
    return std::find(scratch.holders.begin(), scratch.holders.end(), i) != scratch.holders.end();
  }

  /// One pair.
  void look(const View& view, const ViewTest& test, std::uint32_t target, Scratch& scratch, Answer& answer) const {
    const FlatObject& flat = world_.objects()[target];
    if (flat.object.id == view.rides || is_holder(scratch, target)) return;
    ++answer.work.object_tests;
    if (!test.may_touch(flat)) return;
    const Vec3 from = test.volume().apex(), along = flat.centre - from;
    const auto blocks = [&](std::uint32_t i) {
      const FlatObject& other = world_.objects()[i];
      if (!other.object.occluder || i == target) return false;
      ++answer.work.occluders;
      if (!ball_near(other, from, along) || other.object.id == view.rides || is_holder(scratch, i)) return false;
      const Vec3 d = from - other.object.pose.position;
      if (other.local.kind == LocalShape::Kind::ball) return blocks_segment(other.local, d, along, scratch.cuts);
      return blocks_segment(other.local, other.rotation.inverse(d), other.rotation.inverse(along), scratch.cuts);
    };
    if (static_.walk(from, along, answer.work.cells_visited, blocks)) return;
    if (moving_.walk(from, along, answer.work.cells_visited, blocks)) return;
    answer.visible.push_back(flat.object.id);
  }

  /// Whether the segment comes near enough to the object's ball for a closer look.
  static bool ball_near(const FlatObject& flat, const Vec3& from, const Vec3& along) {
    const Vec3 d = flat.centre - from;
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? std::clamp(glm::dot(d, along) / square, 0.0, 1.0) : 0.0;
    const Vec3 off = d - t * along;
    return glm::dot(off, off) <= flat.radius * flat.radius;
  }

  PairwiseOptions options_;
  BucketGrid static_{}, moving_{};
  std::vector<BucketGrid::Item> items_{};
  std::uint64_t static_version_ = 0, moving_version_ = 0, set_version_ = 0;
  tbb::task_arena arena_;
  std::vector<Scratch> scratches_;
};

}  // namespace

const MethodInfo& pairwise_rays_info() {
  static constexpr MethodInfo info{"pairwise-rays",
                                   "one ray from centre to centre for each pair, as traffic simulators do today",
                                   Guarantee::sampled,
                                   true,
                                   true,
                                   true};
  return info;
}

std::unique_ptr<Culler> make_pairwise_rays(const PairwiseOptions& options) {
  if (options.threads < 1 || options.threads > 256) {
    throw Error(ErrorCode::usage, "threads: expected 1 .. 256, found " + std::to_string(options.threads));
  }
  return std::make_unique<PairwiseRays>(options);
}

}  // namespace gridcull
