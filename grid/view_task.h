// Answers one view: copies O for this viewer, traverses, and gathers the potentially visible set. One task
// lives in each thread and is reused; it writes nothing that viewers share.
#pragma once

#include <algorithm>
#include <vector>

#include "gridcull/core/drawing.h"
#include "gridcull/core/view.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/answer_ids.h"
#include "gridcull/grid/cover_scratch.h"
#include "gridcull/grid/grid_world.h"
#include "gridcull/grid/stopwatch.h"
#include "gridcull/grid/traverse_2d.h"
#include "gridcull/grid/traverse_3d.h"
#include "gridcull/grid/view_answerer.h"
#include "gridcull/grid/view_grid.h"

namespace gridcull {

class ViewTask final : public ViewAnswerer, private RevealSink {
 public:
  /// Throws as ViewVolume does, and what the PositionSource throws. `draw` may be nullptr.
  void run(GridWorld& world, const View& view, Answer& answer, ViewResult& result, DrawSink* draw) override;

  std::uint64_t bytes() const override;

 private:
  struct Found {  // a revealed object's cover, this viewer's own
    Slot slot;
    bool container;
    Pose pose;
    Cover cover;
  };

  void look(std::size_t brick, std::uint64_t bits) override;
  void begin(const View& view);
  void traverse();
  void reveal(Slot slot);
  void find_containers();
  void look_outside();
  /// Takes the object's cells out of this viewer's O, as far as nobody else fills them.
  void exclude(Slot slot);
  bool excluded(Slot slot) const;
  void collect();
  void collect_found(const Found& found);
  void collect_brick(std::size_t lattice_brick, std::uint64_t visible);
  void consider(Slot slot, const Pose& pose);
  bool in_view(const ObjectState& object, const Pose& pose) const;
  bool mark(Slot slot) {
    if (stamps_[slot] == stamp_) return false;
    stamps_[slot] = stamp_;
    return true;
  }
  void draw_all(DrawSink& sink) const;
  void draw_line_of_sight(DrawSink& sink) const;

  /// Beyond this many cells the integer arithmetic of the shadows would overflow: then nothing is hidden.
  static constexpr std::int64_t greatest_distance = std::int64_t{1} << 30;

  GridWorld* world_ = nullptr;
  const ViewVolume* volume_ = nullptr;
  Answer* answer_ = nullptr;
  ViewResult* result_ = nullptr;
  Slot rides_ = none;
  Cell viewer_;
  bool has_window_ = false;
  bool far_away_ = false;
  ViewGrid grid_;
  Stopwatch occlusion_;
  Traverse2D traverse_2d_;
  Traverse3D traverse_3d_;
  CoverScratch scratch_;
  std::vector<std::uint32_t> stamps_;  // slot marked in this view
  std::uint32_t stamp_ = 0;
  std::vector<Slot> excluded_;  // ridden object and containers
  std::vector<Found> found_;
  std::size_t found_count_ = 0;
  std::vector<Slot> pending_;
  AnswerIds ids_;
};

}  // namespace gridcull
