#include "property_run.h"

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/shared_cells.h"
#include "gridcull/grid/static_tiles.h"
#include "gridcull/grid/tile_stream.h"
#include "gridcull/methods/frustum.h"

namespace gridcull::test {
namespace {

/// The world as it stands, and the pull instance's source.
class Stage final : public PositionSource {
 public:
  /// Without what makes no sense: an object removed that is not there, added that is, moved that is not.
  ScriptFrame apply(const ScriptFrame& frame) {
    ScriptFrame done;
    for (const ObjectId id : frame.remove) {
      if (objects.erase(id) != 0) done.remove.push_back(id);
    }
    for (const Object& o : frame.add) {
      if (objects.emplace(o.id, o).second) done.add.push_back(o);
    }
    for (const ScriptMove& m : frame.moves) {
      const auto found = objects.find(m.id);
      if (found == objects.end()) continue;
      found->second.pose = m.pose;
      done.moves.push_back(m);
    }
    return done;
  }

  Pose pose(ObjectId object) override { return objects.at(object).pose; }

  std::vector<Object> list() const {
    std::vector<Object> out;
    for (const auto& [id, object] : objects) out.push_back(object);
    return out;
  }

  std::map<ObjectId, Object> objects;
};

bool ascending(const std::vector<ObjectId>& ids) {
  for (std::size_t i = 1; i < ids.size(); ++i) {
    if (!(ids[i - 1] < ids[i])) return false;
  }
  return true;
}

bool holds(const std::vector<ObjectId>& ids, ObjectId id) { return std::binary_search(ids.begin(), ids.end(), id); }

std::string list_of(const std::vector<ObjectId>& ids) {
  std::string text;
  for (const ObjectId id : ids) text += (text.empty() ? "" : " ") + std::to_string(id);
  return "{" + text + "}";
}

bool same_work(const WorkCounts& a, const WorkCounts& b) {
  return a.cells_visited == b.cells_visited && a.cells_hidden == b.cells_hidden && a.object_tests == b.object_tests &&
         a.occluders == b.occluders && a.rasters == b.rasters && a.tbv_tests == b.tbv_tests &&
         a.tbv_revealed == b.tbv_revealed;
}

}  // namespace

struct Truth::Frame {
  std::unique_ptr<ExactRays> rays;  // 3D
  std::vector<ExactAnswer> views;
};

Truth::Truth(const WorldScript& script, int rays) {
  if (rays == 0) return;
  Stage stage;
  ScriptFrame start;
  start.add = script.objects;
  stage.apply(start);
  for (const ScriptFrame& step : script.frames) {
    stage.apply(step);
    const std::vector<Object> world = stage.list();
    Frame& frame = frames_.emplace_back();
    if (script.dimension == 3 && !step.views.empty()) frame.rays = std::make_unique<ExactRays>(world, rays);
    for (const View& view : step.views) {
      frame.views.push_back(frame.rays ? frame.rays->visible(view) : exact_visible_2d(world, view));
    }
  }
}
Truth::~Truth() = default;

const Truth::Frame* Truth::frame(std::size_t index) const { return index < frames_.size() ? &frames_[index] : nullptr; }

namespace {

/// Of a world's static cells: none, a quarter, half or three quarters, for one world always the same.
std::uint64_t some_of(const TiledCells& tiles, std::size_t choice) {
  std::uint64_t bytes = 0;
  for (const StaticTile& tile : tiles.tiles()) bytes += tile_bytes(tile);
  return bytes * (choice % 4) / 4;
}

/// The static objects' cells as a volume file gives them back.
std::shared_ptr<const StaticCells> stored_cells(const WorldScript& script) {
  constexpr std::uint64_t plenty = std::uint64_t{1} << 32;
  const Lattice lattice(script.dimension, script.bounds, script.cell, plenty);
  auto cells =
      std::make_shared<StaticCells>(*discretise_static(lattice, script.objects, plenty, [](double) { return true; }));
  const SharedCells shared = share_cells(*cells, plenty);
  unshare_cells(shared, plenty, *cells);
  return cells;
}

class Run {
 public:
  Run(const WorldScript& script, const MethodEntry& method, const Truth& truth, Tally& tally)
      : script_(script), truth_(truth), tally_(tally) {
    MethodOptions o;
    counts_work_ = script.dimension == 2 || method.info.name != "silhouette";
    o.dimension = script.dimension;
    o.bounds = script.bounds;
    o.cell = script.cell;
    o.tbv = script.tbv;
    // Coarse pixels in some worlds: there a wrong one shows.
    if (script.tbv == "off" && method.options.find("--resolution R") != std::string_view::npos) o.resolution = 32;
    push_ = method.make(o);
    o.threads = script.threads;
    // Where and how static objects' cells are kept must not change a bit.
    if (has_store(StoreKind::openvdb)) o.store = StoreKind::openvdb;
    o.static_cells = stored_cells(script);
    pull_ = method.make(o);
    pull_->set_source(&stage_);
    frustum_ = make_frustum_culler(script.dimension);
    if (method.info.name == "voxel") {
      // And one that holds a part of the static cells only: that may be less tight, but misses nobody.
      o.static_tiles = tiled(*o.static_cells, 3);
      o.static_memory = some_of(*o.static_tiles, script.objects.size() + script.frames.size());
      o.static_cells.reset();
      streamed_ = method.make(o);
    }
    ScriptFrame start;
    start.add = script.objects;
    feed(start);
  }

  std::optional<Fault> play() {
    for (frame_ = 0; frame_ < script_.frames.size() && !fault_; ++frame_) {
      const ScriptFrame& frame = script_.frames[frame_];
      feed(frame);
      push_->query(frame.time, frame.views, pushed_);
      pull_->query(frame.time, frame.views, pulled_);
      frustum_->query(frame.time, frame.views, loose_);
      if (streamed_) streamed_->query(frame.time, frame.views, some_);
      check_stats();
      check_views(frame.views);
    }
    return fault_;
  }

 private:
  void feed(const ScriptFrame& wanted) {
    std::map<ObjectId, Vec3> before;
    for (const auto& [id, object] : stage_.objects) before[id] = object.pose.position;
    const ScriptFrame frame = stage_.apply(wanted);
    for (const ObjectId id : frame.remove) {
      push_->remove(id);
      pull_->remove(id);
      frustum_->remove(id);
      if (streamed_) streamed_->remove(id);
      before.erase(id);
    }
    for (const Object& object : frame.add) {
      push_->add(object);
      pull_->add(object);
      frustum_->add(object);
      if (streamed_) streamed_->add(object);
      before.erase(object.id);  // no past of its own
    }
    for (const ScriptMove& m : frame.moves) {
      push_->move(m.id, m.pose);
      frustum_->move(m.id, m.pose);
      if (streamed_) streamed_->move(m.id, m.pose);
      if (stage_.objects.at(m.id).is_static) pull_->move(m.id, m.pose);
    }
    if (frame_ > 0) announce(before, frame_step());
  }

  double frame_step() const { return script_.frames[frame_].time - script_.frames[frame_ - 1].time; }

  /// The rule of the engine for pushed moves and of sim's replay.
  void announce(const std::map<ObjectId, Vec3>& before, double seconds) {
    for (const auto& [id, from] : before) {
      const auto& object = stage_.objects.at(id);
      if (object.is_static || !object.max_speed) continue;
      const double distance = glm::length(object.pose.position - from);
      if (distance > *object.max_speed * seconds * (1.0 + 1e-9)) pull_->announce_jump(id);
    }
  }

  void fail(const char* rule, const std::string& text) {
    if (fault_) return;
    fault_ = Fault{rule, "frame " + std::to_string(frame_) + ": " + rule + ": " + text};
  }

  void check_stats() {
    const FrameStats &a = pushed_.stats, &b = pulled_.stats;
    if (a.positions_read != b.positions_read || a.tbv_active != b.tbv_active || a.tbv_revealed != b.tbv_revealed ||
        a.tbv_expired != b.tbv_expired || a.jumps != b.jumps) {
      fail("differs", "counts of the frame between push and pull, 1 and " + std::to_string(script_.threads) +
                          " threads: positions read " + std::to_string(a.positions_read) + " and " +
                          std::to_string(b.positions_read) + ", jumps " + std::to_string(a.jumps) + " and " +
                          std::to_string(b.jumps));
    }
    tally_.revealed += a.tbv_revealed;
    tally_.expired += a.tbv_expired;
    tally_.jumps += a.jumps;
  }

  void check_views(std::span<const View> views) {
    const std::vector<Object> world = stage_.list();
    const Truth::Frame* truth = truth_.frame(frame_);
    if (pushed_.views.size() != views.size() || pulled_.views.size() != views.size()) {
      fail("differs", "number of answers");
      return;
    }
    for (std::size_t i = 0; i < views.size() && !fault_; ++i) {
      check_view(views[i], world, pushed_.views[i], pulled_.views[i], loose_.views[i]);
      if (truth != nullptr) tally_.visible += truth->views[i].visible.size();
      if (truth != nullptr && !fault_) check_reference(views[i], *truth, truth->views[i], pushed_.views[i].visible);
      if (streamed_ && !fault_) check_rules(views[i], world, some_.views[i], loose_.views[i]);
      if (streamed_ && truth != nullptr && !fault_) {
        check_reference(views[i], *truth, truth->views[i], some_.views[i].visible);
      }
      ++tally_.views;
      tally_.answered += pushed_.views[i].visible.size();
      tally_.in_view += loose_.views[i].visible.size();
    }
  }

  void check_view(const View& view, const std::vector<Object>& world, const Answer& push, const Answer& pull,
                  const Answer& loose) {
    const std::string who = "viewer " + std::to_string(view.viewer);
    const std::vector<ObjectId>& ids = push.visible;
    if (push.viewer != view.viewer) fail("order", who + " got the answer of another");
    if (ids != pull.visible) fail("differs", who + ": push " + list_of(ids) + ", pull " + list_of(pull.visible));
    if (counts_work_ && !same_work(push.work, pull.work)) fail("differs", who + ": work counts");
    check_rules(view, world, push, loose);
  }

  /// What needs no reference.
  void check_rules(const View& view, const std::vector<Object>& world, const Answer& answer, const Answer& loose) {
    const std::string who = "viewer " + std::to_string(view.viewer);
    const std::vector<ObjectId>& ids = answer.visible;
    if (!ascending(ids)) fail("order", who + ": " + list_of(ids));
    if (holds(ids, view.rides)) fail("ridden", who + " is told of object " + std::to_string(view.rides));
    for (const ObjectId id : ids) {
      if (!holds(loose.visible, id)) fail("out of view", who + " is told of object " + std::to_string(id));
    }
    for (const Object& o : world) {
      if (o.id == view.rides || holds(ids, o.id)) continue;
      if (interior_holds(o.shape, o.pose, view.pose.position)) {
        fail("container", who + " stands in object " + std::to_string(o.id) + ", answer " + list_of(ids));
      }
    }
  }

  void check_reference(const View& view, const Truth::Frame& truth, const ExactAnswer& exact,
                       const std::vector<ObjectId>& ids) {
    for (std::size_t i = 0; i < exact.visible.size(); ++i) {
      const ObjectId id = exact.visible[i];
      if (holds(ids, id)) continue;
      if (truth.rays && !truth.rays->confirm(view, id, exact.witness[i])) continue;
      const Vec3& w = exact.witness[i];
      fail("missed", "viewer " + std::to_string(view.viewer) + " sees object " + std::to_string(id) + " along (" +
                         std::to_string(w.x) + ", " + std::to_string(w.y) + ", " + std::to_string(w.z) + "), answer " +
                         list_of(ids));
    }
  }

  const WorldScript& script_;
  const Truth& truth_;
  Tally& tally_;
  Stage stage_;
  std::unique_ptr<Culler> push_, pull_, frustum_;
  std::unique_ptr<Culler> streamed_;  // `voxel`
  /// Whether push and pull must do the same work. Not `silhouette` in 3D: volumes are revealed in another order there,
  /// so lists in the index are too, and what a test inside one bucket of the queue costs depends on the order.
  bool counts_work_ = true;
  Answers pushed_, pulled_, loose_, some_;
  std::size_t frame_ = 0;
  std::optional<Fault> fault_;
};

}  // namespace

namespace {

/// The rule tells errors apart by their words, not by the numbers in them.
Fault fault_of(const Error& error) {
  std::string rule = std::string("error: ") + error.what();
  std::erase_if(rule, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; });
  return {rule, std::string("threw: ") + error.what()};
}

}  // namespace

std::optional<Fault> check_world(const WorldScript& script, const MethodEntry& method, const Truth& truth,
                                 Tally& tally) {
  try {
    return Run(script, method, truth, tally).play();
  } catch (const Error& error) {
    return fault_of(error);
  }
}

std::optional<Fault> check_world(const WorldScript& script, const MethodEntry& method, int rays) {
  try {
    Tally ignored;
    const Truth truth(script, rays);
    return Run(script, method, truth, ignored).play();
  } catch (const Error& error) {
    return fault_of(error);
  }
}

}  // namespace gridcull::test
