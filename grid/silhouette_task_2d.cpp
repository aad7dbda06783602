// Claim: the answer holds every visible object X. If X is placed, it has a row (static_rows_2d.h), or its ball hangs in
// the index or in the list of what does not fit there, and if X was not met it is hidden (silhouette_walk_2d.h); if it
// was met, it was entered and the claim of silhouette_2d.h holds. If X has a temporal bounding volume, the same holds
// for the volume, which holds X: one that is not wholly hidden is revealed, and X is entered as it stands. What the
// viewer rides on is left out altogether.
#include "gridcull/grid/silhouette_task_2d.h"

#include <algorithm>
#include <chrono>

#include "gridcull/grid/draw_volumes.h"

namespace gridcull {

void SilhouetteTask2D::run(GridWorld& world, const View& view, Answer& answer, ViewResult& result, DrawSink* draw) {
  const auto start = std::chrono::steady_clock::now();
  const ViewVolume volume(view, 2);
  world_ = &world;
  answer_ = &answer;
  result_ = &result;
  result.seen.clear();
  result.revealed.clear();
  result.occlude_us = 0.0;  // goes on inside the traversal
  answer.viewer = view.viewer;
  answer.visible.clear();
  answer.work = {};
  rides_ = view.rides == no_id ? none : world.objects.find(view.rides);
  silhouettes_.begin(volume);
  walked_.clear();
  walk_.note_nodes(draw != nullptr ? &walked_ : nullptr);
  walk_.run(
      world.silhouettes->index, world.silhouettes->rows, world.outside, silhouettes_, answer.work,
      [this](Slot slot) { ask(slot); }, [this](const BallRows::Item& item) { meet(item); },
      [this](Slot slot, bool occluder, const Box2D& box) { meet_static(slot, occluder, box); });
  const auto walked = std::chrono::steady_clock::now();
  answer.work.occluders = silhouettes_.candidates();
  answer.work.rasters = silhouettes_.sight().buffer().size();
  silhouettes_.finish(result.seen);
  ids_.list(world.objects, result.seen, answer.visible);
  if (draw != nullptr) draw_all(*draw);
  const auto end = std::chrono::steady_clock::now();
  result.traverse_us = std::chrono::duration<double, std::micro>(walked - start).count();
  result.collect_us = std::chrono::duration<double, std::micro>(end - walked).count();
}

void SilhouetteTask2D::ask(Slot slot) { world_->silhouettes->outlines.prefetch(slot); }

void SilhouetteTask2D::draw_all(DrawSink& sink) const {
  const LooseIndex& index = world_->silhouettes->index;
  const Sight2D& sight = silhouettes_.sight();
  draw_nodes(index, walked_, sink);
  // Without a range, as far as the farthest corner of the world.
  const Bounds box = world_->lattice.box();
  const Vec2 far = glm::max(glm::abs(Vec2(box.min) - sight.eye()), glm::abs(Vec2(box.max) - sight.eye()));
  sink.region(seen_region(sight.buffer(), sight.eye(), std::min(sight.range(), glm::length(far))));
  draw_volumes(
      *world_, *result_, [&](Slot slot) { return index.ball(slot); }, sink);
}

void SilhouetteTask2D::meet(const BallRows::Item& item) {
  const Slot slot = item.slot;
  if (slot == rides_) return;
  const SilhouetteWorld& shapes = *world_->silhouettes;
  const bool occluder = (item.marks & SilhouetteWorld::is_occluder) != 0;
  if ((item.marks & SilhouetteWorld::is_hidden) == 0) {
    silhouettes_.enter(slot, shapes.outlines.at(slot), occluder);
    return;
  }
  ++answer_->work.tbv_tests;
  if (!silhouettes_.shows_disc(Vec2(item.ball.centre), item.ball.radius)) return;
  ++answer_->work.tbv_revealed;
  shapes.index.note_opened(slot);
  const Pose pose = world_->read(slot);
  std::vector<Vec2>& points = points_of(result_->revealed.size());
  result_->revealed.push_back(slot);
  silhouettes_.enter(slot, shapes.outlines.place(slot, pose, points), occluder);
}

void SilhouetteTask2D::meet_static(Slot slot, bool occluder, const Box2D& box) {
  if (slot == rides_) return;
  silhouettes_.enter_boxed(slot, world_->silhouettes->outlines.at(slot), occluder, box);
}

std::vector<Vec2>& SilhouetteTask2D::points_of(std::size_t revealed) {
  if (revealed == points_.size()) points_.emplace_back();
  return points_[revealed];
}

std::uint64_t SilhouetteTask2D::bytes() const {
  std::uint64_t bytes = silhouettes_.bytes() + walk_.bytes();
  for (const auto& points : points_) bytes += sizeof(points) + points.capacity() * sizeof(Vec2);
  return bytes;
}

}  // namespace gridcull
