#include "gridcull/methods/shadow_walk.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gridcull/core/world_points.h"

namespace gridcull {

void ShadowWalk::begin(const Task& task, Answer& answer) {
  task_ = task;
  answer_ = &answer;
  eye_ = task.test->volume().apex();
  flat_ = task.world->dimension() == 2;
  hidden_by_.assign(task.frusta.size(), 0);
  hidden_by_unions_ = 0;
}

void ShadowWalk::run(const BoxTree& tree) {
  if (tree.empty()) return;
  const std::size_t count = task_.frusta.size();
  visit(tree, 0, count >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1);
}

/// Never no for a box that touches the view volume: 2^-46 of its reach is far above the roundings of three products
/// and of the volume's planes.
bool ShadowWalk::may_be_in_view(const SightBox& box) const {
  const ViewVolume& volume = task_.test->volume();
  const double margin = 0x1p-46 * box.reach;
  if (volume.convex()) {
    for (const HalfSpace& side : volume) {
      const Vec3& n = side.normal;
      const double most = glm::dot(n, box.centre) + std::fabs(n.x) * box.half.x + std::fabs(n.y) * box.half.y +
                          std::fabs(n.z) * box.half.z;
      if (most < -margin) return false;
    }
  }
  if (!std::isfinite(volume.range())) return true;
  Vec3 gap(0.0);
  for (int k = 0; k < 3; ++k) gap[k] = std::fmax(0.0, std::fabs(box.centre[k]) - box.half[k]);
  return glm::length(gap) <= volume.range() * (1.0 + 0x1p-46) + margin;
}

/// Whether one frustum holds it; those that it is outside of leave `active`.
template <class Occludee>
bool ShadowWalk::hides(const Occludee& occludee, std::uint64_t& active, std::uint64_t objects) {
  for (std::uint64_t left = active; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    Overlap place = task_.frusta[k]->overlap(occludee, answer_->work.rasters);
    if (task_.exact && place == Overlap::partial && lies_beside(*task_.frusta[k], occludee)) place = Overlap::outside;
    if (place == Overlap::outside) active &= ~(std::uint64_t{1} << k);
    if (place != Overlap::inside) continue;
    hidden_by_[k] += objects;
    return true;
  }
  return false;
}

/// Each of its scalar products is counted as a test against a plane.
bool ShadowWalk::lies_beside(const ShadowFrustum& frustum, const SightBox& box) {
  Operations done;
  const bool beside = gridcull::lies_beside(frustum, box, edges_, done);
  answer_->work.rasters += done.dots;
  return beside;
}

void ShadowWalk::visit(const BoxTree& tree, std::uint32_t at, std::uint64_t active) {
  const BoxTree::Node& node = tree.node(at);
  const SightBox box(node.box, eye_);
  ++answer_->work.cells_visited;
  if (!may_be_in_view(box)) return;
  if (active != 0 && hides(box, active, node.count)) {
    ++answer_->work.cells_hidden;
    return;
  }
  if (node.right != 0) {
    visit(tree, at + 1, active);
    visit(tree, node.right, active);
    return;
  }
  for (const std::uint32_t place : tree.names(node)) visit_object(place, active);
}

void ShadowWalk::visit_object(std::uint32_t place, std::uint64_t active) {
  const FlatObject& flat = task_.world->object(place);
  if (flat.object.id == task_.rides) return;
  ++answer_->work.object_tests;
  if (std::find(task_.holders.begin(), task_.holders.end(), place) != task_.holders.end()) {
    answer_->visible.push_back(flat.object.id);
    return;
  }
  const SightBox box(task_.world->boxes()[place], eye_);
  if (!may_be_in_view(box)) return;
  if (active != 0 && is_hidden(outline_of(place), box, active)) return;
  if (task_.test->may_touch(flat)) answer_->visible.push_back(flat.object.id);
}

ShadowWalk::Outline ShadowWalk::outline_of(std::uint32_t place) const {
  const FlatObject& flat = task_.world->object(place);
  const PlacedBound* bound = task_.world->bound(place);
  const Pose& pose = flat.object.pose;
  Outline out{.object = &flat, .bound = bound, .blur = blur_of(pose.position, reach_of(flat.object.shape), eye_)};
  if (bound != nullptr && bound->round) {
    out.ball.emplace(bound->ball.centre, bound->ball.radius, eye_);
  } else if (bound == nullptr && flat.local.kind == LocalShape::Kind::ball) {
    out.ball.emplace(pose.position, flat.local.radius, eye_);
  }
  return out;
}

bool ShadowWalk::is_hidden(const Outline& outline, const SightBox& box, std::uint64_t active) {
  if (outline.ball ? hides(*outline.ball, active, 1) : hides(box, active, 1)) return true;
  return active != 0 && hides_outline(outline, box, active);
}

/// Its corners in points_, as seen from the eye.
void ShadowWalk::list_points(const Outline& outline) {
  points_.clear();
  const auto add = [this](const Vec3& p) {
    points_.push_back(p - eye_);
    if (flat_) points_.back().z = 0.0;
  };
  if (outline.bound != nullptr) {
    for (const Vec3& p : outline.bound->boundary.vertices) add(p);
  } else {
    for_each_world_point(outline.object->object.shape, outline.object->object.pose, add);
  }
}

/// The general test: the object's own outline, or its bound's, against each frustum, then against two together.
bool ShadowWalk::hides_outline(const Outline& outline, const SightBox& box, std::uint64_t active) {
  std::uint64_t& tests = answer_->work.rasters;
  const bool ball = outline.ball.has_value();
  if (ball && (!task_.unions || std::has_single_bit(active))) return false;
  if (!ball) list_points(outline);
  if (!(ball ? polygon_.build(*outline.ball, flat_) : polygon_.build(points_, box.centre, outline.blur, flat_))) {
    return false;
  }
  beyond_.clear();
  for (std::uint64_t left = active; left != 0; left &= left - 1) {
    const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
    const ShadowFrustum& frustum = *task_.frusta[k];
    if (!(ball ? frustum.beyond(*outline.ball, tests) : frustum.beyond(points_, outline.blur, tests))) continue;
    const Overlap place = ball ? Overlap::partial : overlap(polygon_, frustum, tests);
    if (place == Overlap::partial) beyond_.push_back(k);
    if (place != Overlap::inside) continue;
    ++hidden_by_[k];
    return true;
  }
  return task_.unions && hides_together(beyond_);
}

bool ShadowWalk::hides_together(std::span<const std::uint32_t> numbers) {
  if (numbers.size() < 2) return false;
  std::uint64_t& tests = answer_->work.rasters;
  within_.clear();
  for (const std::uint32_t k : numbers) within_.push_back(rays_within(polygon_, *task_.frusta[k], tests));
  const std::size_t rays = polygon_.rays().size();
  const std::uint64_t all = rays >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << rays) - 1;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (std::size_t j = i + 1; j < numbers.size(); ++j) {
      if ((within_[i] | within_[j]) != all) continue;
      if (!inside_union(polygon_, *task_.frusta[numbers[i]], *task_.frusta[numbers[j]], scratch_, tests)) continue;
      ++hidden_by_unions_;
      return true;
    }
  }
  return false;
}

}  // namespace gridcull
