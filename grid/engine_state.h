// Inside the engine: the steps of a frame (Batagelo and Wu 2002, section 3).
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <tbb/task_arena.h>

#include "gridcull/grid/engine.h"
#include "gridcull/grid/expiry_queue.h"
#include "gridcull/grid/grid_world.h"
#include "gridcull/grid/tbv_term.h"
#include "gridcull/grid/view_answerer.h"
#include "gridcull/grid/viewer_paths.h"

namespace gridcull {

struct GridEngine::State {
  explicit State(const GridOptions& options);

  // Between frames.
  void add(const Object& object);
  void remove(Slot slot);
  void move(Slot slot, const Pose& pose);

  // A frame, in this order.
  void check(double time, std::span<const View> views) const;
  void settle_jumps(double time);
  void expire();
  void discretise();
  void follow_pushed();
  void note_viewers(std::span<const View> views);
  void answer_views(std::span<const View> views, Answers& out);
  void merge(std::size_t views);
  void hide_unseen();

  /// Discretises the object in O and I at its present pose.
  void cover(Slot slot);
  void activate(Slot slot);
  void list_active(Slot slot);
  void unlist_active(Slot slot);
  void hide(Slot slot);
  void give_volume(Slot slot);
  /// Gives an expired volume a new term; its slot has left the queue.
  void renew_volume(Slot slot);
  TbvMatrix::Ball next_ball(Slot slot);
  void place_volume(Slot slot, const TbvMatrix::Ball& ball);
  /// The ball of a hidden object's volume.
  TbvMatrix::Ball volume(Slot slot) const;
  /// Doubles the object's term if the volume it then gets stays clear of what somebody sees.
  bool lengthen_term(ObjectState& state);
  void take_volume(Slot slot);
  void leave_grid(Slot slot);
  void set_outside(Slot slot, bool outside);
  Slot slot_of(ObjectId object) const;

  struct Pushed {
    Slot slot;
    Vec3 from;
  };

  GridOptions options;
  GridWorld world;
  ExpiryQueue expiries;
  TbvTerm terms;
  ViewerPaths viewers;

  bool started = false;
  double now = 0.0;     // time of the frame in hand
  double before = 0.0;  // time of the frame before
  FrameStats stats;

  std::uint64_t volumes = 0;  // hidden objects
  std::vector<Slot> active;   // moving objects in O and I
  std::vector<Slot> waiting;  // added, moved by hand, or jumped: to be discretised at the next frame
  std::vector<Pushed> pushed;
  std::vector<Slot> jumped;
  std::vector<std::uint8_t> seen;  // per slot: in somebody's PVS in this frame
  std::vector<Slot> expired;
  std::vector<Slot> hiding;
  std::vector<ViewResult> results;                   // per view
  std::vector<std::unique_ptr<ViewAnswerer>> tasks;  // per thread
  std::unique_ptr<tbb::task_arena> arena;            // made when first needed
  CoverScratch scratch;
  Cover cover_buffer;

  ViewerId draw_viewer = no_id;
  DrawSink* draw_sink = nullptr;
};

}  // namespace gridcull
