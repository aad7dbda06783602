// Answers one view by method `silhouette` in 3D (DESIGN section 5): a front-to-back walk over the loose index, in
// which the silhouettes of what was found visible cover the directions behind them.
#pragma once

#include <vector>

#include "gridcull/core/view_volume.h"
#include "gridcull/grid/answer_ids.h"
#include "gridcull/grid/coverage_mask.h"
#include "gridcull/grid/front_queue.h"
#include "gridcull/grid/grid_world.h"
#include "gridcull/grid/outer_outline.h"
#include "gridcull/grid/piece_sections.h"
#include "gridcull/grid/silhouette_drawing.h"
#include "gridcull/grid/view_answerer.h"

namespace gridcull {

class Silhouette3D final : public ViewAnswerer {
 public:
  /// `resolution`: pixels along the longer side of the mask; 0: chosen per view.
  Silhouette3D(int resolution, InstructionSet isa) : resolution_(resolution), mask_(isa) {}

  /// The most that its mask takes, whatever the view; resolution > 0.
  static std::uint64_t mask_bytes(int resolution);

  void run(GridWorld& world, const View& view, Answer& answer, ViewResult& result, DrawSink* draw) override;
  std::uint64_t bytes() const override;

 private:
  /// What waits to enter the mask, relative to the viewpoint: the tangent cone of a ball, or a loop of rays.
  struct Occluder {
    Vec3 centre;
    double radius;       ///< 0: a loop
    std::uint32_t rays;  ///< first in rays_
    std::uint32_t count;
  };
  /// An object that looked visible as a whole and is tested again in slices of its depth.
  struct Sliced {
    Slot slot;
    std::uint32_t slice;
    double nearest, farthest;  ///< of its front; metres from the viewpoint
  };
  static constexpr std::uint32_t slices = 3;

  void begin(const View& view);
  /// The mask's resolution for this view.
  int pixels() const;
  void walk();
  struct Box {
    Vec3 low, high;  ///< relative to the viewpoint
  };
  /// An object or volume that is in the queue or on its way there, with the pixels that it is first tested with.
  struct Entry {
    double key;
    BallRows::Place place;
    FrontQueue::Kind kind;
    std::int8_t face;                    ///< -1: they are not told
    std::array<std::int16_t, 4> pixels;  ///< as masking::Rectangle
  };
  /// What hangs in a node and below, where that is little: tested together, as one box.
  struct Group {
    Box box;
    LooseIndex::NodeId node;
    std::uint32_t first, count;  ///< in entries_
  };
  /// A node's, or a group's.
  double key_of(const Box& box) const;
  Box box_of(const LooseIndex::NodeId& id) const;
  void push_node(const LooseIndex::NodeId& id);
  void push_children(const LooseIndex::NodeId& id);
  void open_node(LooseIndex::NodeId id);
  void push_group(const LooseIndex::NodeId& id);
  void gather(const LooseIndex::NodeId& id, const LooseIndex::Node& node);
  void look_at_group(const Group& group);
  void push_entries(const Group& group);
  /// Into the queue: entries [first, end).
  void push_range(std::uint32_t first, std::uint32_t end);
  void push_object(BallRows::Place place, const LooseBall& ball, bool upright);
  /// What is to be weighed is asked from memory; weigh_rest() sends it to entries_, by eights.
  void weigh(const BallRows::Item& item, BallRows::Place place);
  void weigh_rest();
  void load(const LooseBall& ball, const BallRows::Item& item, bool upright, BallRows::Place place,
            FrontQueue::Kind kind);
  void place_balls();
  void look_at_volume(const Entry& entry);
  /// First test: the object as a whole.
  void look(const Entry& entry);
  bool open_pixels(const Entry& entry) const {
    const std::array<std::int16_t, 4>& p = entry.pixels;
    return mask_.open_pixels(entry.face, {p[0], p[1], p[2], p[3]});
  }
  /// The rectangle about the box of an upright object, or about the ball. `centre`: relative to the viewpoint.
  bool open_about(const BallRows::Item& item, const Vec3& centre, double radius, double grown, bool upright) const;
  bool holds_viewpoint(Slot slot) const;
  bool open_whole(Slot slot, Sliced& object);
  bool open_as_ball(const LooseBall& ball, Sliced& object);
  /// Where an object is tested as a bounding sphere: that, in the world, with all that rounding may do.
  LooseBall bounding_ball(Slot slot, const SilhouetteWorld::Solid& solid) const;
  bool open_solid(Slot slot, const SilhouetteWorld::Solid& solid, Sliced& object);
  bool open_outline() const;
  /// Second test: slice after slice, from the nearest on.
  void look_at_slices(Sliced object);
  bool open_slice(const Sliced& object);
  void see(Slot slot);
  void hide_behind(Slot slot);
  void hide_behind_ball(const LooseBall& ball);
  void hide_behind_pieces(Slot slot);
  void push_loop(const Outline& loop, double key);
  void enter(const Occluder& occluder);
  bool in_view(Slot slot) const;
  /// The ball's radius and what the rounding of its place relative to the viewpoint may make of it.
  double grown(const LooseBall& ball) const;
  /// Of the slot asked about last it is kept: whoever is found visible is asked about again as an occluder.
  const SightFrame& sight(Slot slot);
  /// The object's own ball, or its volume.
  LooseBall ball_of(const BallRows::Item& item) const {
    if ((item.marks & SilhouetteWorld::is_loose) == 0) return item.ball;
    return {pose_of(item.slot).position, item.ball.radius};
  }
  /// Hints that ball_of() is needed soon.
  void prefetch_ball(const BallRows::Item& item) const {
    if ((item.marks & SilhouetteWorld::is_loose) != 0) world_->objects.prefetch_whereabouts(item.slot);
  }
  const Pose& pose_of(Slot slot) const { return world_->objects.pose(slot); }

  int resolution_;
  CoverageMask mask_;
  FrontQueue queue_;
  GridWorld* world_ = nullptr;
  const SilhouetteWorld* shapes_ = nullptr;
  const ViewVolume* volume_ = nullptr;
  Answer* answer_ = nullptr;
  ViewResult* result_ = nullptr;
  Slot rides_ = none;
  Slot sighted_ = none;  // whose frame_ is
  SightFrame frame_{};
  double limit_ = 0.0;                     // nothing whose nearest point is farther can be reported
  double apex_size_ = 0.0;                 // sum of its coordinates' magnitudes
  Vec3 corner_{0.0};                       // of the index, relative to the viewpoint
  double blur_ = 0.0;                      // metres: rounding of distances to anything in the index
  std::vector<LooseIndex::NodeId> nodes_;  // in the queue, as occluders are
  std::vector<Group> groups_;
  std::vector<Entry> entries_;
  std::vector<BallRows::Place> waiting_;  // to be weighed
  masking::Outlook outlook_{};
  masking::Balls balls_;  // that are weighed next
  std::array<BallRows::Place, 8> places_{};
  std::array<FrontQueue::Kind, 8> kinds_{};
  masking::Batch batch_;
  Box box_{};  // about what was weighed since it was emptied
  std::vector<Occluder> occluders_;
  std::vector<Vec3> rays_;
  std::vector<Sliced> sliced_;
  Outline outline_;
  std::array<Section, max_sections> sections_;
  AnswerIds ids_;
  bool drawing_ = false;
  WalkedNodes walked_;  // while drawing
};

}  // namespace gridcull
