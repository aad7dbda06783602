// Without a baked file viewers' cells are looked out of on demand, those of a lattice, and kept while the static world
// stays as it is: a viewer that stays in a cell costs a look-up (section 6.2). What is told:
// - static objects: the cell's potentially visible set, cut to the view volume;
// - moving objects: their current box, tested against the cell's maps, or, baked, the motion regions that it touches.
//   The paper tests fixed regions in advance (roads) because its maps are gone at run time; on demand ours are there,
//   and a car is smaller than its road.
//
// What a view needs beyond its cell (core/culler.h): the object that it rides on, and one whose interior holds it, hide
// nothing from it. Where the cell's maps rest on such an occluder, a cell without it is looked out of; where on two
// or more, or where the cell is a baked one, the view volume alone answers. Objects that meet the cell, holders among
// them, are never hidden. A viewer outside all baked cells gets the view volume's answer. Once a static object is
// added, removed or moved after the first frame the baked sets are out of date, and cells are looked out of on demand.
#include "gridcull/methods/extended_projections.h"

#include <algorithm>
#include <string>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/core/world_points.h"
#include "gridcull/methods/baking.h"
#include "gridcull/methods/bytes.h"
#include "gridcull/methods/extended_bake.h"
#include "gridcull/methods/extended_baked.h"
#include "gridcull/methods/extended_cache.h"
#include "gridcull/methods/flat_world.h"
#include "gridcull/methods/lap.h"
#include "gridcull/methods/view_test.h"
#include "gridcull/methods/world_culler.h"

namespace gridcull {
namespace {

using extended::CellKey;
using extended::CellView;

constexpr int standard_resolution = 256;
constexpr int mover_halvings = 2;

extended::CellSettings settings_of(const ExtendedOptions& o) {
  extended::CellSettings settings;
  settings.resolution = o.resolution > 0 ? o.resolution : standard_resolution;
  return settings;
}

class ExtendedProjections final : public WorldCuller<FlatWorld> {
 public:
  explicit ExtendedProjections(const ExtendedOptions& o)
      : WorldCuller(3),
        settings_(settings_of(o)),
        cells_(o.bounds, o.cell, settings_, o.max_memory, o.threads),
        baked_file_(o.baked),
        max_memory_(o.max_memory) {}

  const MethodInfo& info() const override { return extended_projections_info(); }

  void query(double time, std::span<const View> views, Answers& out) override {
    Lap whole, lap;
    FrameStats stats;
    refresh();  // first: a baked file that is refused leaves the frame unanswered and everything as it was
    world_.begin_frame(time, views, stats);
    stats.discretise_us = lap.next();
    out.views.resize(views.size());
    // As many views at once as their cells' maps have room for; a baked file holds no maps.
    const std::size_t at_once = baked_ ? std::max<std::size_t>(1, views.size()) : cells_.views_at_once();
    for (std::size_t first = 0; first < views.size(); first += at_once) {
      const auto some = views.subspan(first, std::min(at_once, views.size() - first));
      baked_ ? find_leaves(some) : find_cells(some);
      stats.occlude_us += lap.next();
      for (std::size_t i = 0; i < some.size(); ++i) answer(some[i], i, out.views[first + i]);
      cells_.trim();
      stats.collect_us += lap.next();
    }
    stats.total_us = whole.next();
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
      baked_.reset();
      if (static_version_ == 0 && !baked_file_.empty()) load();
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

  void load() {
    std::vector<Object> objects;
    for (const FlatObject& flat : world_.objects()) objects.push_back(flat.object);
    const BakedHead head{std::string(info().name), extended_baked_version, static_world_hash(objects)};
    const std::vector<std::byte> payload = read_baked(baked_file_, head, max_memory_);
    ByteReader in(payload, baked_file_);
    auto baked = std::make_unique<extended::BakedCells>(in);
    in.finish();
    if (baked->objects() != scene_.occludees.size()) in.refuse("altered: baked from another number of objects");
    baked_ = std::move(baked);
    leaves_.clear();
  }

  /// A leaf for each view, in leaves_; views keep their places from frame to frame, mostly, and so do decoded sets.
  void find_leaves(std::span<const View> views) {
    if (leaves_.size() < views.size()) leaves_.resize(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
      Leaf& leaf = leaves_[i];
      const auto found = baked_->find(views[i].pose.position);
      leaf.good = found && views[i].pose.position.z >= scene_.floor.height;
      if (!found) continue;
      if (leaf.name != *found) baked_->decode(*found, leaf.set);
      leaf.name = *found;
      const std::uint32_t ridden = views[i].rides == no_id ? FlatWorld::nowhere : world_.find(views[i].rides);
      if (ridden != FlatWorld::nowhere && world_.objects()[ridden].object.is_static) leaf.good = false;
      for (const std::uint32_t place : leaf.set.touching) {
        const Object& object = world_.objects()[world_.find(scene_.occludees[place].id)].object;
        if (interior_holds(object.shape, object.pose, views[i].pose.position)) leaf.good = false;
      }
    }
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

  void answer(const View& view, std::size_t place, Answer& answer) const {
    answer.viewer = view.viewer;
    answer.visible.clear();
    answer.work = {};
    const ViewTest test(view, 3);
    if (baked_ ? !leaves_[place].good : !keys_[place]) {
      for (const FlatObject& flat : world_.objects()) tell(view, test, flat, answer);
    } else if (baked_) {
      tell_leaf(view, test, leaves_[place].set, answer);
    } else {
      tell_cell(view, test, cells_.at(*keys_[place]), answer);
    }
    std::sort(answer.visible.begin(), answer.visible.end());
  }

  bool in_view(const View& view, const ViewTest& test, const FlatObject& flat, Answer& answer) const {
    ++answer.work.object_tests;
    return flat.object.id != view.rides &&
           (test.may_touch(flat) || interior_holds(flat.object.shape, flat.object.pose, view.pose.position));
  }
  void tell(const View& view, const ViewTest& test, const FlatObject& flat, Answer& answer) const {
    if (in_view(view, test, flat, answer)) answer.visible.push_back(flat.object.id);
  }
  const FlatObject& static_object(std::uint32_t place) const {
    return world_.objects()[world_.find(scene_.occludees[place].id)];
  }

  /// Not grown as FlatObject's: whether it stands on the floor is judged to the last bit.
  static Bounds world_box(const FlatObject& flat) {
    Bounds box;
    if (const auto* sphere = std::get_if<Sphere>(&flat.object.shape)) {
      box.add_ball(flat.object.pose.position, sphere->radius);
    } else {
      for_each_world_point(flat.object.shape, flat.object.pose, [&box](const Vec3& p) { box.add(p); });
    }
    return box;
  }

  void tell_cell(const View& view, const ViewTest& test, const CellView& cell, Answer& answer) const {
    answer.work.occluders = cell.used.size();
    answer.work.rasters = cell.drawn;
    for (const std::uint32_t i : cell.visible) tell(view, test, static_object(i), answer);
    for (const std::uint32_t i : movers_) {
      const FlatObject& flat = world_.objects()[i];
      if (!in_view(view, test, flat, answer)) continue;
      const Bounds world = world_box(flat), box = extended::box_in(cell.outlooks.cell, world);
      if (world.min.z < cell.outlooks.floor || !cell.outlooks.hides(box, mover_halvings, answer.work.cells_visited))
        answer.visible.push_back(flat.object.id);
    }
  }

  void tell_leaf(const View& view, const ViewTest& test, const extended::LeafSet& set, Answer& answer) const {
    const auto first_region = std::lower_bound(set.visible.begin(), set.visible.end(), baked_->objects());
    for (auto i = set.visible.begin(); i != first_region; ++i) tell(view, test, static_object(*i), answer);
    const auto seen = [&](std::uint32_t region) {
      ++answer.work.cells_visited;
      return std::binary_search(first_region, set.visible.end(), baked_->objects() + region);
    };
    for (const std::uint32_t i : movers_) {
      const FlatObject& flat = world_.objects()[i];
      if (!in_view(view, test, flat, answer)) continue;
      const Bounds box = world_box(flat);
      if (box.min.z < scene_.floor.height || baked_->regions().any(box, seen)) answer.visible.push_back(flat.object.id);
    }
  }

  struct Leaf {
    bool good = false;  ///< it answers for this view
    std::uint32_t name = no_id;
    extended::LeafSet set{};
  };

  extended::CellSettings settings_;
  extended::StaticScene scene_{};
  extended::CellCache cells_;
  std::string baked_file_;
  std::uint64_t max_memory_;
  std::unique_ptr<extended::BakedCells> baked_{};
  std::vector<Leaf> leaves_{};
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
