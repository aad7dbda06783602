// Answers one view by method `silhouette` in 2D (DESIGN sections 5.2, 5.6): the walk over the loose index, objects as
// silhouettes, hidden objects revealed where their volumes show. One task lives in each thread and is reused.
#pragma once

#include <vector>

#include "gridcull/grid/answer_ids.h"
#include "gridcull/grid/grid_world.h"
#include "gridcull/grid/silhouette_walk_2d.h"
#include "gridcull/grid/view_answerer.h"

namespace gridcull {

class SilhouetteTask2D final : public ViewAnswerer {
 public:
  void run(GridWorld& world, const View& view, Answer& answer, ViewResult& result, DrawSink* draw) override;
  std::uint64_t bytes() const override;

 private:
  void ask(Slot slot);
  void meet(const BallRows::Item& item);
  void meet_static(Slot slot, bool occluder, const Box2D& box);
  void draw_all(DrawSink& sink) const;
  /// Points of the revealed object with this number, which stay until the view is answered.
  std::vector<Vec2>& points_of(std::size_t revealed);

  GridWorld* world_ = nullptr;
  Answer* answer_ = nullptr;
  ViewResult* result_ = nullptr;
  Slot rides_ = none;
  Silhouettes2D silhouettes_;
  SilhouetteWalk2D walk_;
  WalkedNodes walked_;  // while drawing
  std::vector<std::vector<Vec2>> points_;
  AnswerIds ids_;
};

}  // namespace gridcull
