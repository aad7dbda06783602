#include "gridcull/grid/engine.h"

#include <chrono>
#include <cmath>
#include <string>

#include "gridcull/core/error.h"
#include "gridcull/grid/engine_state.h"

namespace gridcull {

GridEngine::GridEngine(const GridOptions& options) {
  if (options.dimension != 2 && options.dimension != 3) {
    throw Error(ErrorCode::bad_scene, "dimension: expected 2 or 3, found " + std::to_string(options.dimension));
  }
  if (options.threads < 1 || options.threads > 256) {
    throw Error(ErrorCode::usage, "threads: expected 1 .. 256, found " + std::to_string(options.threads));
  }
  if (options.resolution != 0 && (options.resolution < 8 || options.resolution > 8192)) {
    throw Error(ErrorCode::usage, "resolution: expected 8 .. 8192, found " + std::to_string(options.resolution));
  }
  state_ = std::make_unique<State>(options);
  if (options.static_cells && !options.static_cells->fit(state_->world.lattice)) {
    throw Error(ErrorCode::bad_scene, "static cells: expected those of this lattice, found another's");
  }
  if (options.static_tiles && options.hiding == Hiding::voxel) {
    GridWorld& world = state_->world;
    world.tiles = std::make_unique<TileStream>(options.static_tiles, world.lattice, options.static_memory);
  }
}

GridEngine::~GridEngine() = default;

const MethodInfo& grid_engine_info(Hiding hiding) {
  static constexpr MethodInfo voxel{"voxel",
                                    "regular grid, occluders fused in object space (Batagelo and Wu 2002)",
                                    Guarantee::conservative,
                                    true,
                                    true,
                                    true};
  static constexpr MethodInfo silhouette{"silhouette",
                                         "regular grid, occluders fused in image space (DESIGN section 5; Batagelo and "
                                         "Wu 2002, section 7)",
                                         Guarantee::conservative,
                                         true,
                                         true,
                                         true};
  return hiding == Hiding::voxel ? voxel : silhouette;
}

const MethodInfo& GridEngine::info() const { return grid_engine_info(state_->options.hiding); }

void GridEngine::add(const Object& object) { state_->add(object); }

void GridEngine::remove(ObjectId object) { state_->remove(state_->slot_of(object)); }

void GridEngine::move(ObjectId object, const Pose& pose) {
  const Slot slot = state_->slot_of(object);
  check_pose(pose, object, state_->options.dimension);
  state_->move(slot, pose);
}

void GridEngine::move_all(std::span<const Move> moves) { state_->move_all(moves); }

void GridEngine::set_source(PositionSource* source) {
  State& s = *state_;
  if (source == s.world.source) return;
  s.world.source = source;
  // The new source may know other places than the old one told: no volume holds any longer.
  for (Slot slot = 0; slot < s.world.objects.size(); ++slot) {
    if (s.world.objects[slot].place == Place::hidden) s.activate(slot);
  }
}

void GridEngine::announce_jump(ObjectId object) {
  const Slot slot = state_->slot_of(object);
  ObjectState& object_state = state_->world.objects[slot];
  if (object_state.jumped) return;
  object_state.jumped = true;
  state_->jumped.push_back(slot);
}

void GridEngine::query(double time, std::span<const View> views, Answers& out) {
  const auto start = std::chrono::steady_clock::now();
  State& s = *state_;
  s.check(time, views);
  s.before = s.started ? s.now : time;  // before the first frame is no time
  s.now = time;
  ++s.world.frame;
  if (s.world.silhouettes) s.world.silhouettes->index.begin_frame();
  s.world.positions_read = 0;
  s.stats = {};
  s.settle_jumps(time);
  s.started = true;
  s.expire();
  s.discretise();
  if (s.world.tiles) s.world.tiles->follow(views, s.world.objects, s.world.matrix);
  s.note_viewers(views);
  const auto ready = std::chrono::steady_clock::now();
  try {
    s.answer_views(views, out);
  } catch (...) {
    s.viewers.forget();
    throw;
  }
  const auto answered = std::chrono::steady_clock::now();
  s.merge(views.size());
  s.hide_unseen();
  const auto end = std::chrono::steady_clock::now();
  const auto us = [](auto d) { return std::chrono::duration<double, std::micro>(d).count(); };
  s.stats.positions_read = s.world.positions_read;
  s.stats.tbv_active = s.volumes;
  s.stats.discretise_us = us(ready - start) + us(end - answered);
  s.stats.total_us = us(end - start);
  out.stats = s.stats;
}

void GridEngine::draw_next(std::span<const Drawing> drawings) {
  state_->drawings.assign(drawings.begin(), drawings.end());
}

void GridEngine::draw_next(ViewerId viewer, DrawSink* sink) {
  state_->drawings.clear();
  if (sink != nullptr) state_->drawings.push_back({viewer, sink});
}

const Lattice& GridEngine::lattice() const { return state_->world.lattice; }

std::uint64_t GridEngine::State::list_bytes() const {
  std::uint64_t bytes = (pushed.capacity() + pushed_strays.capacity()) * sizeof(Pushed) + seen.capacity() +
                        world.outside.capacity() * sizeof(Slot);
  for (const auto* list : {&active, &waiting, &stale, &told, &jumped, &expired, &hiding}) {
    bytes += list->capacity() * sizeof(Slot);
  }
  return bytes;
}

MemoryUse GridEngine::memory() const {
  const State& s = *state_;
  MemoryUse use;
  use.matrices = s.world.matrix.matrix_bytes() + s.world.tbv.matrix_bytes() + s.world.hollow.matrix_bytes() +
                 s.world.seen_in.bytes();
  use.entries = s.world.matrix.entry_bytes() + s.world.tbv.entry_bytes() + s.world.hollow.entry_bytes();
  use.objects = s.world.objects.bytes() + s.expiries.bytes() + s.list_bytes() + tiles().directory;
  for (Slot slot = 0; slot < s.world.objects.size(); ++slot) {
    const ObjectState& state = s.world.objects[slot];
    if (state.shape) use.objects += state.shape->bytes();
  }
  if (const SilhouetteWorld* silhouettes = s.world.silhouettes.get()) {
    use.matrices += silhouettes->index.node_bytes();
    use.entries += silhouettes->index.entry_bytes();
    use.objects += silhouettes->shape_bytes();
  }
  for (const auto& task : s.tasks) use.viewers += task->bytes();
  for (const ViewResult& result : s.results) {
    use.viewers += sizeof(result) + (result.seen.capacity() + result.revealed.capacity()) * sizeof(Slot);
  }
  return use;
}

TileUse GridEngine::tiles() const { return state_->world.tiles ? state_->world.tiles->use() : TileUse{}; }

}  // namespace gridcull
