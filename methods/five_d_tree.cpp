// C. Gotsman, O. Sudarsky, J. Fayman, "Optimized occlusion culling using five-dimensional subdivision", Computers &
// Graphics 23(5), 1999. A k-D tree over all lines of sight (position and direction, methods/five_d_space.h); each leaf
// lists the objects that some line of sight in it meets first. Partitions: section 4 (five_d_split.cpp); number of
// rays: section 5 (sequential_test.h, five_d_leaf.cpp); codings: section 6 (five_d_code.cpp); queries: section 7
// (five_d_query.cpp); eight angular intervals last: section 8.
//
// Sampled: what no ray met and the sequential test gave up on is missed.
//
// What the paper leaves open, or is changed:
// - Moving objects (the paper is about static scenes): the space in which something moves is divided into *motion
//   boxes*, which are members of the leaves' lists like objects, with rays cast at points anywhere within them. A
//   moving object is reported when it touches a listed motion box, or leaves the boxes' region. It never occludes.
// - Viewpoints: those in the open only. A viewer inside a static occluder, riding on one, or outside the tree's space
// is
//   told everything in its view volume; so is everybody once a static object was added, moved or removed.
// - A leaf of a cell in which no free point was found lists nobody. A query that finds nobody reports everything in the
//   view volume: where something static is seen at all, the list is not empty.
// - Rays are accelerated by uniform buckets (methods/bucket_grid.h), not an octree.
// - What is listed is tested against the view volume once more, object by object.
//
// Without a file the tree is baked at the first query, with few cells and rays. Times: that is `discretise`; queries
// are `traverse`, tests against the view volume `collect`. Counts: cells_visited are the tree's nodes.
#include "gridcull/methods/five_d_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/methods/five_d_bake.h"
#include "gridcull/methods/five_d_query.h"
#include "gridcull/methods/flat_world.h"
#include "gridcull/methods/lap.h"
#include "gridcull/methods/view_test.h"
#include "gridcull/methods/world_culler.h"

namespace gridcull {
namespace {

/// For a bake that somebody waits for: about a second where there are hundreds of objects, a few milliseconds for ten.
FiveDOptions small_bake(std::uint64_t statics, int threads) {
  FiveDOptions options;
  options.threads = threads;
  options.s_thresh = 0.05;
  options.estimate_rays = 8;
  options.boxes = static_cast<int>(std::clamp<std::uint64_t>(2 * statics, 16, 192));
  options.cells = static_cast<int>(std::clamp<std::uint64_t>(2 * statics, 16, 256));
  return options;
}

class FiveDTreeCuller final : public WorldCuller<FlatWorld> {
 public:
  explicit FiveDTreeCuller(const FiveDTreeOptions& options) : WorldCuller(options.dimension), options_(options) {}

  const MethodInfo& info() const override { return five_d_tree_info(); }

  void query(double time, std::span<const View> views, Answers& out) override {
    Lap whole, lap;
    FrameStats stats;
    load();
    world_.begin_frame(time, views, stats);
    bake();
    index();
    stats.discretise_us = lap.next();
    out.views.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) answer(views[i], out.views[i], stats);
    stats.total_us = whole.next();
    out.stats = stats;
  }

 private:
  struct Contents {
    std::vector<Object> objects{};
    std::uint64_t statics = 0;
    bool occludes = false;
  };
  Contents contents() const {
    Contents out;
    for (const FlatObject& flat : world_.objects()) {
      out.objects.push_back(flat.object);
      if (!flat.object.is_static) continue;
      ++out.statics;
      out.occludes = out.occludes || flat.object.occluder;
    }
    return out;
  }

  /// The tree from its file, before the first query changes anything: it may be refused.
  void load() {
    if (is_ready_ || options_.baked.empty()) return;
    const Contents now = contents();
    const BakedHead head{std::string(five_d_tree_info().name), five_d_version, static_world_hash(now.objects)};
    FiveDBaked baked = read_five_d_payload(read_baked(options_.baked, head, options_.max_memory), options_.baked);
    if (baked.space.dimension != options_.dimension || baked.space.statics != now.statics) {
      throw Error(ErrorCode::bad_scene, options_.baked + ": altered: its members are not the scene's");
    }
    baked_ = std::move(baked);
    use_tree(now.occludes);
  }

  /// Without a file, once the first query's poses are known, pushed or pulled: they tell where something moves.
  void bake() {
    if (is_ready_) return;
    const Contents now = contents();
    if (now.occludes) {
      const FiveDOptions options = small_bake(now.statics, options_.threads);
      baked_ = *bake_five_d(now.objects, options_.dimension, options_.bounds, options, {}, nullptr);
    }
    use_tree(now.occludes);
  }

  void use_tree(bool occludes) {
    has_tree_ = occludes;
    static_version_ = world_.static_version();
    members_.resize(baked_.space.words());
    is_ready_ = true;
  }

  /// Places of the members and of the movers in world_.objects(), anew when these have changed.
  void index() {
    if (set_version_ == world_.set_version()) return;
    set_version_ = world_.set_version();
    statics_.clear();
    movers_.clear();
    const auto objects = world_.objects();
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
      (objects[i].object.is_static ? statics_ : movers_).push_back(i);
    }
    std::sort(statics_.begin(), statics_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return objects[a].object.id < objects[b].object.id; });
  }

  void answer(const View& view, Answer& answer, FrameStats& stats) {
    Lap lap;
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    const ViewTest test(view, options_.dimension);
    find_holders(view.pose.position);
    const bool listed = look_up(view, test.volume(), answer.work);
    stats.traverse_us += lap.next();
    collect(view, test, listed, answer);
    stats.collect_us += lap.next();
  }

  /// Fills members_; false where the tree knows nothing.
  bool look_up(const View& view, const ViewVolume& volume, WorkCounts& work) {
    if (!has_tree_ || static_version_ != world_.static_version()) return false;
    const Vec3& at = view.pose.position;
    for (int k = 0; k < options_.dimension; ++k) {
      if (at[k] < baked_.space.positions.min[k] || at[k] > baked_.space.positions.max[k]) return false;
    }
    const auto objects = world_.objects();
    const auto hides = [&](std::uint32_t i) { return objects[i].object.is_static && objects[i].object.occluder; };
    if (std::any_of(holders_.begin(), holders_.end(), hides)) return false;
    const std::uint32_t ridden = world_.find(view.rides);
    if (ridden != FlatWorld::nowhere && hides(ridden)) return false;
    const ViewRange range(view, volume, options_.dimension, 0.5 * options_.view_box);
    find_members(baked_.tree, baked_.space, range, members_, stack_, work.cells_visited);
    return std::any_of(members_.begin(), members_.end(), [](std::uint64_t word) { return word != 0; });
  }

  bool has(std::uint32_t member) const { return (members_[member / 64] >> (member % 64) & 1) != 0; }

  /// Whether a moving object may touch a motion box that is listed.
  bool may_show(const FlatObject& flat) const {
    const FiveDSpace& space = baked_.space;
    std::array<std::uint32_t, 3> low{}, high{};
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double begin = space.region.min[k], end = space.region.max[k];
      if (k == 2 && options_.dimension == 2) continue;
      // Also where there are no boxes at all.
      if (space.boxes[i] == 0 || flat.box.min[k] < begin || flat.box.max[k] > end) return true;
      const double scale = end > begin ? space.boxes[i] / (end - begin) : 0.0;
      // A box's border counts for both sides, with a margin far above the roundings.
      const double most = space.boxes[i] - 1.0;
      low[i] = static_cast<std::uint32_t>(std::clamp((flat.box.min[k] - begin) * scale - 1e-6, 0.0, most));
      high[i] = static_cast<std::uint32_t>(std::clamp((flat.box.max[k] - begin) * scale + 1e-6, 0.0, most));
    }
    for (std::uint32_t z = low[2]; z <= high[2]; ++z) {
      for (std::uint32_t y = low[1]; y <= high[1]; ++y) {
        for (std::uint32_t x = low[0]; x <= high[0]; ++x) {
          if (has(space.statics + (z * space.boxes[1] + y) * space.boxes[0] + x)) return true;
        }
      }
    }
    return false;
  }

  void collect(const View& view, const ViewTest& test, bool listed, Answer& answer) const {
    const auto objects = world_.objects();
    const auto look = [&](std::uint32_t i) {
      const FlatObject& flat = objects[i];
      ++answer.work.object_tests;
      const bool holds = std::find(holders_.begin(), holders_.end(), i) != holders_.end();
      if (flat.object.id != view.rides && !holds && test.may_touch(flat)) answer.visible.push_back(flat.object.id);
    };
    for (std::uint32_t member = 0; member < statics_.size(); ++member) {
      if (!listed || has(member)) look(statics_[member]);
    }
    for (const std::uint32_t i : movers_) {
      if (!listed || may_show(objects[i])) look(i);
    }
    for (const std::uint32_t i : holders_) {
      if (objects[i].object.id != view.rides) answer.visible.push_back(objects[i].object.id);
    }
    std::sort(answer.visible.begin(), answer.visible.end());
  }

  void find_holders(const Vec3& point) {
    if (all_.size() != world_.objects().size()) {
      all_.resize(world_.objects().size());
      for (std::uint32_t i = 0; i < all_.size(); ++i) all_[i] = i;
    }
    holders_.clear();
    world_.add_holders(point, all_, holders_);
  }

  FiveDTreeOptions options_;
  FiveDBaked baked_{};
  bool is_ready_ = false, has_tree_ = false;
  std::uint64_t static_version_ = 0, set_version_ = 0;
  std::vector<std::uint32_t> statics_{}, movers_{}, all_{}, holders_{}, stack_{};
  std::vector<std::uint64_t> members_{};
};

}  // namespace

const MethodInfo& five_d_tree_info() {
  static constexpr MethodInfo info{"five-d-tree",
                                   "tree over positions and directions, baked by rays, after Gotsman, Sudarsky, "
                                   "Fayman 1999 (sections 3-8)",
                                   Guarantee::sampled,
                                   true,
                                   true,
                                   false};
  return info;
}

std::unique_ptr<Culler> make_five_d_tree(const FiveDTreeOptions& options) {
  if (options.threads < 1 || options.threads > 256) {
    throw Error(ErrorCode::usage, "threads: expected 1 .. 256, found " + std::to_string(options.threads));
  }
  if (!(options.view_box >= 0.0 && std::isfinite(options.view_box))) {
    throw Error(ErrorCode::usage, "--view-box: expected 0 or more metres, found " + std::to_string(options.view_box));
  }
  return std::make_unique<FiveDTreeCuller>(options);
}

}  // namespace gridcull
