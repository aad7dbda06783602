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
#include "gridcull/grid/view_order.h"
#include "gridcull/grid/viewer_paths.h"

namespace gridcull {

struct GridEngine::State {
  explicit State(const GridOptions& options);

  struct Pushed {
    Slot slot;
    Vec3 from;
  };

  // Between frames.
  void add(const Object& object);
  void remove(Slot slot);
  void move(Slot slot, const Pose& pose);
  void move_all(std::span<const Move> moves);

  // A frame, in this order.
  void check(double time, std::span<const View> views) const;
  void settle_jumps(double time);
  void expire();
  void discretise();
  void read_active();
  void follow_pushed();
  void follow_stale();
  void note_viewers(std::span<const View> views);
  void answer_views(std::span<const View> views, Answers& out);
  void merge(std::size_t views);
  void hide_unseen();

  /// Whether objects that nobody sees get volumes.
  bool hides() const {
    if (options.tbv == TbvMode::automatic) return world.source != nullptr || !follows_at_once();
    return options.tbv != TbvMode::off;
  }
  /// A pushed move that leaves its object on its leash is done in move() already.
  bool follows_at_once() const { return world.silhouettes != nullptr && options.dimension == 3; }
  /// Whether the object moves on its leash; `square`: of its way, metres.
  static bool stays_on_leash(Whereabouts& where, const Pose& to, double square);
  void move_in_full(Slot slot, const Pose& pose, double square);
  /// Gives a hidden object at `position` the leash that its volume leaves it; false: none, it may be outside.
  bool leash_in_volume(Slot slot, const Vec3& position, const TbvMatrix::Ball& ball);
  /// Keeps the object's old position; `list`: pushed or pushed_strays.
  void note_pushed(Slot slot, double square, std::vector<Pushed>& list);
  bool jumped_since(const Pushed& push, double step, double time) const;
  /// The object is to be covered at the start of the next frame.
  void mark_stale(Slot slot);
  void forget_removed();
  /// Discretises the object in O and I at its present pose.
  void cover(Slot slot);
  /// cover() of method `silhouette`.
  void hang(Slot slot);
  /// Metres that the object shall be able to go in its node of the index.
  double room(Slot slot) const;
  void unleash(Slot slot);
  /// The object's cells at its present pose, into cover_buffer.
  void find_cells(Slot slot);
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
  bool lengthen_term(Slot slot);
  /// Method `silhouette`: whether a volume would hang where nobody looks.
  bool looks_deep(const LooseBall& ball) const;
  void take_volume(Slot slot);
  void leave_grid(Slot slot);
  /// The object's cells no longer come from tiles.
  void leave_tiles(Slot slot);
  void set_outside(Slot slot, bool outside);
  Slot slot_of(ObjectId object) const;
  /// Of the lists below.
  std::uint64_t list_bytes() const;

  GridOptions options;
  GridWorld world;
  ExpiryQueue expiries;
  TbvTerm terms;
  ViewerPaths viewers;

  bool started = false;
  double now = 0.0;     // time of the frame in hand
  double before = 0.0;  // time of the frame before
  FrameStats stats;

  std::uint64_t volumes = 0;                  // hidden objects
  std::vector<Slot> active;                   // moving objects in O and I
  std::vector<Slot> waiting;                  // added, moved by hand, or jumped: to be discretised at the next frame
  std::vector<Slot> stale;                    // follows_at_once(): marked as stale; whoever still is will be covered
  std::vector<Pushed> pushed, pushed_strays;  // strays: hidden, and perhaps outside their volumes
  /// No object of `pushed` needs longer for its way, at its max_speed; seconds, squared, rounded.
  double pushed_needs = 0.0;
  std::uint16_t round = 1;  // of pushes, between two frames; never 0
  std::vector<Slot> told;   // of the moves in hand
  std::vector<Slot> jumped;
  std::vector<std::uint8_t> seen;  // per slot: in somebody's PVS in this frame
  std::vector<Slot> expired;
  std::vector<Slot> hiding;
  ViewOrder view_order;
  std::vector<ViewResult> results;                   // per view
  std::vector<std::unique_ptr<ViewAnswerer>> tasks;  // per thread
  std::unique_ptr<tbb::task_arena> arena;            // made when first needed
  CoverScratch scratch;
  Cover cover_buffer;

  std::vector<Drawing> drawings;  // of the next query

  DrawSink* sink_of(ViewerId viewer) const {
    for (const Drawing& drawing : drawings) {
      if (drawing.viewer == viewer) return drawing.sink;
    }
    return nullptr;
  }
};

}  // namespace gridcull
