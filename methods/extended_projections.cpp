// Viewers' cells are looked out of on demand, those of a lattice, and kept while the static world stays as it is:
// a viewer that stays in a cell costs a look-up (section 6.2). What is told:
// - static objects: the cell's potentially visible set, cut to the view volume;
// - moving objects: their current box, tested against the cell's maps. The paper tests fixed regions in advance
//   (roads) because its maps are gone at run time; ours are there, and a car is smaller than its road.
//
// What a view needs beyond its cell (core/culler.h): the object that it rides on, and one whose interior holds it, hide
// nothing from it. Where the cell's maps rest on such an occluder, a cell without it is looked out of; where on two
// or more, the view volume alone answers. Objects that meet the cell, holders among them, are never hidden.
#include "gridcull/methods/extended_projections.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/methods/extended_cache.h"
#include "gridcull/methods/flat_world.h"
#include "gridcull/methods/view_test.h"

namespace gridcull {
namespace {

using Clock = std::chrono::steady_clock;
using extended::CellKey;
using extended::CellView;

double microseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

constexpr int standard_resolution = 256;
constexpr int mover_halvings = 2;

extended::CellSettings settings_of(const ExtendedOptions& o) {
  extended::CellSettings settings;
  settings.resolution = o.resolution > 0 ? o.resolution : standard_resolution;
  return settings;
}

class ExtendedProjections final : public Culler {
 public:
  explicit ExtendedProjections(const ExtendedOptions& o)
      : settings_(settings_of(o)), world_(3), cells_(o.bounds, o.cell, settings_, o.max_memory, o.threads) {}

  const MethodInfo& info() const override { return extended_projections_info(); }
  void add(const Object& object) override { world_.add(object); }
  void remove(ObjectId object) override { world_.remove(object); }
  void move(ObjectId object, const Pose& pose) override { world_.move(object, pose); }
  void set_source(PositionSource* source) override { world_.set_source(source); }
  void announce_jump(ObjectId object) override { world_.announce_jump(object); }

  void query(double time, std::span<const View> views, Answers& out) override {
    const auto start = Clock::now();
    FrameStats stats;
    world_.begin_frame(time, views, stats);
    refresh();
    stats.discretise_us = microseconds_since(start);
    const auto looking = Clock::now();
    find_cells(views);
    stats.occlude_us = microseconds_since(looking);
    const auto collecting = Clock::now();
    out.views.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) answer(views[i], keys_[i], out.views[i]);
    cells_.trim();
    stats.collect_us = microseconds_since(collecting);
    stats.total_us = microseconds_since(start);
    out.stats = stats;
  }

 private:
  /// The static scene and who moves, where something changed.
  void refresh() {
    if (static_version_ != world_.static_version()) {
      std::vector<const Object*> objects;
      for (const FlatObject& flat : world_.objects()) objects.push_back(&flat.object);
      scene_ = extended::make_static_scene(objects, extended::least_angle(settings_.resolution));
      cells_.reset(scene_);
    }
    if (set_version_ != world_.set_version()) {
      movers_.clear();
      for (std::uint32_t i = 0; i < world_.objects().size(); ++i) {
        if (!world_.objects()[i].object.is_static) movers_.push_back(i);
      }
    }
    static_version_ = world_.static_version();
    set_version_ = world_.set_version();
  }

  /// A cell for each view, in keys_; nothing where none will do.
  void find_cells(std::span<const View> views) {
    keys_.clear();
    needed_.clear();
    for (const View& view : views) {
      keys_.push_back(cells_.key_of(view.pose.position));
      if (keys_.back()) needed_.push_back(*keys_.back());
    }
    cells_.need(needed_);
    bool all = true;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (!keys_[i]) continue;
      const ObjectId first = wrong_for(views[i], cells_.at(*keys_[i]));
      if (first == no_id) continue;
      keys_[i]->without = first;
      needed_.push_back(*keys_[i]);
      all = false;
    }
    if (all) return;
    cells_.need(needed_);
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (keys_[i] && wrong_for(views[i], cells_.at(*keys_[i])) != no_id) keys_[i].reset();
    }
  }

  /// An occluder that the cell's maps rest on and that must not hide from this view; no_id: none.
  ObjectId wrong_for(const View& view, const CellView& cell) const {
    if (view.rides != no_id && std::binary_search(cell.used.begin(), cell.used.end(), view.rides)) return view.rides;
    for (const ObjectId id : cell.touching) {
      const Object& object = world_.objects()[world_.find(id)].object;
      if (interior_holds(object.shape, object.pose, view.pose.position)) return id;
    }
    return no_id;
  }

  void answer(const View& view, const std::optional<CellKey>& key, Answer& answer) const {
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    const ViewTest test(view, 3);
    const auto look = [&](const FlatObject& flat) {
      ++answer.work.object_tests;
      return flat.object.id != view.rides &&
             (test.may_touch(flat) || interior_holds(flat.object.shape, flat.object.pose, view.pose.position));
    };
    if (!key) {
      for (const FlatObject& flat : world_.objects()) {
        if (look(flat)) answer.visible.push_back(flat.object.id);
      }
    } else {
      const CellView& cell = cells_.at(*key);
      answer.work.occluders = cell.used.size();
      answer.work.rasters = cell.drawn;
      for (const std::uint32_t i : cell.visible) {
        const FlatObject& flat = world_.objects()[world_.find(scene_.occludees[i].id)];
        if (look(flat)) answer.visible.push_back(flat.object.id);
      }
      for (const std::uint32_t i : movers_) {
        const FlatObject& flat = world_.objects()[i];
        if (!look(flat)) continue;
        const Bounds box = extended::box_in(cell.outlooks.cell, flat.box);
        if (!cell.outlooks.hides(box, mover_halvings, answer.work.cells_visited))
          answer.visible.push_back(flat.object.id);
      }
    }
    std::sort(answer.visible.begin(), answer.visible.end());
  }

  extended::CellSettings settings_;
  FlatWorld world_;
  extended::StaticScene scene_{};
  extended::CellCache cells_;
  std::vector<std::uint32_t> movers_{};  ///< places in world_
  std::vector<std::optional<CellKey>> keys_{};
  std::vector<CellKey> needed_{};
  std::uint64_t static_version_ = 0, set_version_ = 0;
};

}  // namespace

const MethodInfo& extended_projections_info() {
  static constexpr MethodInfo info{"extended-projections",
                                   "from viewing cells, static occluders' views intersected (Durand et al. 2000)",
                                   Guarantee::conservative,
                                   false,
                                   true,
                                   false};
  return info;
}

std::unique_ptr<Culler> make_extended_projections(const ExtendedOptions& options) {
  if (!(options.cell > 0.0)) throw Error(ErrorCode::usage, "cell: expected a size above 0");
  if (options.resolution != 0 && (options.resolution < 8 || options.resolution > 8192)) {
    throw Error(ErrorCode::usage, "--resolution: expected 8 .. 8192, found " + std::to_string(options.resolution));
  }
  if (options.threads < 1 || options.threads > 256) {
    throw Error(ErrorCode::usage, "threads: expected 1 .. 256, found " + std::to_string(options.threads));
  }
  return std::make_unique<ExtendedProjections>(options);
}

}  // namespace gridcull
