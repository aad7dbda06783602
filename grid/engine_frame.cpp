// The steps of a frame. The order of the answers' bits never depends on scheduling: viewers write only their
// own answers, and what they reveal is merged in the order of the views.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "gridcull/core/error.h"
#include "gridcull/core/hand_over.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/engine_state.h"

namespace gridcull {
namespace {

constexpr std::uint8_t patience = 8;  // frames
constexpr std::size_t ahead = 12;     // objects

}  // namespace

void GridEngine::State::check(double time, std::span<const View> views) const {
  if (!std::isfinite(time)) throw Error(ErrorCode::bad_frame, "time: expected a finite number of seconds");
  if (started && !(time > now)) {
    throw Error(ErrorCode::bad_frame,
                "time: expected more than " + std::to_string(now) + ", found " + std::to_string(time));
  }
  for (const View& view : views) (void)ViewVolume(view, options.dimension);
}

// Criterion 2 of the paper: hidden and expired, so a new term. All poses are read before any volume is given up:
// if the source throws, the volumes go back to the queue and expire again in the next frame.
void GridEngine::State::expire() {
  expired.clear();
  expiries.pop_expired(now, expired);
  try {
    for (std::size_t i = 0; i < expired.size(); ++i) {
      // Hidden objects are many and seldom touched: ask for their memory some objects ahead.
      if (i + ahead < expired.size()) world.prefetch(expired[i + ahead]);
      if (world.silhouettes && i + ahead / 2 < expired.size()) {
        world.silhouettes->index.prefetch_node(expired[i + ahead / 2]);
      }
      world.read_alone(expired[i]);
    }
  } catch (...) {
    for (const Slot slot : expired) expiries.push(slot, expiries.expiry(slot));
    throw;
  }
  stats.tbv_expired += expired.size();
  for (const Slot slot : expired) renew_volume(slot);
}

// Objects of the last PVS are discretised, those that did not move excepted.
void GridEngine::State::discretise() {
  for (const Slot slot : waiting) {
    ObjectState& state = world.objects[slot];
    state.place = Place::active;
    mark_stale(slot);
    if (state.is_static) {
      cover(slot);
    } else {
      list_active(slot);
    }
  }
  if (!waiting.empty()) options.static_cells.reset();  // what they hold is in the matrices now
  waiting.clear();
  if (world.source != nullptr) {
    read_active();
  } else if (follows_at_once()) {
    follow_stale();
  } else {
    follow_pushed();
  }
  stale.clear();
  if (world.silhouettes) world.silhouettes->settle();
}

// A viewer that jumped may stand inside an outline without having crossed it: such outlines become solid.
void GridEngine::State::note_viewers(std::span<const View> views) {
  viewers.update(world.lattice, views);
  if (world.hollow.size() == 0 || viewers.jumpers().empty()) return;
  expired.clear();
  world.hollow.enclosing(viewers.jumpers(), expired);
  for (const Slot slot : expired) {
    world.hollow.erase(slot);
    world.objects[slot].hollow = false;
    world.tbv.insert(slot, world.tbv.ball(slot));
  }
}

void GridEngine::State::answer_views(std::span<const View> views, Answers& out) {
  out.views.resize(views.size());
  results.resize(std::max(results.size(), views.size()));
  const std::span<const std::uint32_t> order = view_order.sort(views, world.lattice.box());
  const auto one = [&](std::size_t place, ViewAnswerer& task) {
    const std::size_t i = order[place];
    task.run(world, views[i], out.views[i], results[i], sink_of(views[i].viewer));
  };
  if (options.threads == 1 || views.size() < 2) {
    for (std::size_t i = 0; i < views.size(); ++i) one(i, *tasks[0]);
  } else {
    // More threads than the machine has would only make TBB print a warning.
    // One arena for the engine's life: each finished one leaves some kilobytes in TBB and slows the next down.
    if (!arena) arena = std::make_unique<tbb::task_arena>(std::min(options.threads, tbb::info::default_concurrency()));
    const auto body = [&](std::size_t i) {
      take_over();
      ViewAnswerer& task = *tasks[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
      take_over(&task);
      // Isolated: a source that uses TBB itself must not make this thread take up another view meanwhile.
      tbb::this_task_arena::isolate([&] { one(i, task); });
      hand_over(&task);
    };
    hand_over();
    arena->execute([&] { tbb::parallel_for(std::size_t{0}, views.size(), body); });
    for (const auto& task : tasks) take_over(task.get());
  }
  drawings.clear();
}

void GridEngine::State::merge(std::size_t views) {
  for (std::size_t i = 0; i < views; ++i) {
    if (hides()) {
      for (const Slot slot : results[i].seen) seen[slot] = 1;
    }
    stats.traverse_us += results[i].traverse_us;
    stats.occlude_us += results[i].occlude_us;
    stats.collect_us += results[i].collect_us;
  }
  for (std::size_t i = 0; i < views; ++i) {
    for (const Slot slot : results[i].revealed) {
      ObjectState& state = world.objects[slot];
      if (state.place != Place::hidden) continue;  // another view revealed it too
      ++stats.tbv_revealed;
      if (const double speed = world.objects.max_speed(slot); speed > 0.0) {
        state.term = static_cast<float>(terms.shorter(state.term, speed));
      }
      activate(slot);
      // In I from now on. Not seen by anyone, it stays there for a few frames: near the border of what is
      // visible a new volume would be revealed at once, and that costs more than a discretisation.
      if (!seen[slot]) state.patience = patience;
      cover(slot);
    }
  }
}

// Criterion 1 of the paper: not in anybody's PVS and without a volume, so it gets one.
void GridEngine::State::hide_unseen() {
  if (!hides()) return;
  hiding.clear();
  std::size_t kept = 0;
  for (const Slot slot : active) {
    ObjectState& state = world.objects[slot];
    const bool keep = seen[slot] || !state.may_hide || state.patience > 0;
    if (seen[slot]) {
      state.patience = 0;
    } else if (state.patience > 0) {
      --state.patience;
    }
    seen[slot] = 0;
    if (keep) {
      state.active_place = static_cast<std::uint32_t>(kept);
      active[kept++] = slot;
    } else {
      hiding.push_back(slot);
    }
  }
  active.resize(kept);
  // Backwards: what was discretised last hangs first in its bricks' lists, so that even the first frame, which
  // hides most of a world, finds every entry at once.
  std::for_each(hiding.rbegin(), hiding.rend(), [&](Slot slot) { hide(slot); });
}

}  // namespace gridcull
