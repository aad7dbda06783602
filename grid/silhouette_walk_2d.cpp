#include "gridcull/grid/silhouette_walk_2d.h"

#include <algorithm>
#include <cmath>

namespace gridcull {
namespace {

Vec2 middle_of_child(const Vec2& middle, double side, int child) {
  const double step = 0.25 * side;
  return {middle.x + ((child & 1) != 0 ? step : -step), middle.y + ((child & 2) != 0 ? step : -step)};
}

LooseIndex::NodeId child_of(const LooseIndex::NodeId& id, int child) {
  return {id.level - 1, 2 * id.x + (child & 1), 2 * id.y + (child >> 1), 0};
}

}  // namespace

// Boxes of lower nodes are worked out from their parents', a rounding a level. Each is far below the slack that
// loose_box() adds, and that is doubled here.
void SilhouetteWalk2D::begin(const LooseIndex& index, std::span<const Slot> outside, const Sight2D& sight) {
  index_ = &index;
  sight_ = &sight;
  spots_.clear();
  pushed_.clear();
  rows_.clear();  // a walk that ended in an exception may have left some
  const double side = index.side(index.top());
  double far = 0.0;
  for (int i = 0; i < 4; ++i) {
    const LooseIndex::NodeId id{index.top(), i & 1, i >> 1, 0};
    if (!index.exists(id)) continue;
    const Bounds box = index.loose_box(id);
    slack_ = 2.0 * std::max(0.0, 0.5 * (box.max.x - box.min.x) - side);
    const Vec2 d = glm::max(glm::abs(Vec2(box.min) - sight.eye()), glm::abs(Vec2(box.max) - sight.eye()));
    far = std::max(far, glm::length(d));
    spots_.push_back({id, Vec2(box.centre())});
  }
  limit_ = sight.range() * (1.0 + 1e-9) + sight.blur();
  queue_.begin(std::min(far, sight.range()));
  for (std::size_t i = 0, tops = spots_.size(); i < tops; ++i) take(Spot(spots_[i]), index.node(spots_[i].id));
  push_rows();
  for (const Slot slot : outside) push(index.item(index.place_of(slot)), index.place_of(slot));
}

void SilhouetteWalk2D::take(const Spot& spot, const LooseIndex::Node& node) {
  const double half = reach(spot.id.level);
  const Vec2 d = glm::max(glm::abs(spot.middle - sight_->eye()) - half, Vec2(0.0));
  const double square = glm::dot(d, d);
  if (square > limit_ * limit_) return;
  if (node.below <= crowd) {
    if (node.below > 0) index_->note_opened(spot.id);
    if (noted_ != nullptr && node.below > 0) noted_->opened.push_back(spot.id);
    gather(spot.id, node);
  } else {
    queue_.push_node(std::sqrt(square), static_cast<std::uint32_t>(spots_.size()));
    spots_.push_back(spot);
  }
}

void SilhouetteWalk2D::open(std::uint32_t at, const Silhouettes2D& silhouettes, WorkCounts& work) {
  const Spot spot = spots_[at];
  const Vec2 half(reach(spot.id.level));
  if (!silhouettes.shows_box(spot.middle - half, spot.middle + half)) {
    ++work.cells_hidden;
    if (noted_ != nullptr) noted_->hidden.push_back(spot.id);
    return;
  }
  ++work.cells_visited;
  index_->note_opened(spot.id);
  add_row(index_->node(spot.id).first);
  const LooseIndex::Node* children = spot.id.level > 0 ? index_->children(spot.id) : nullptr;
  const double side = index_->side(spot.id.level);
  for (int i = 0; children != nullptr && i < 4; ++i) {
    if (children[i].below != 0) take({child_of(spot.id, i), middle_of_child(spot.middle, side, i)}, children[i]);
  }
  push_rows();
}

void SilhouetteWalk2D::gather(const LooseIndex::NodeId& id, const LooseIndex::Node& node) {
  add_row(node.first);
  if (id.level == 0) return;
  const LooseIndex::Node* children = index_->children(id);
  for (int i = 0; children != nullptr && i < 4; ++i) {
    if (children[i].below != 0) gather(child_of(id, i), children[i]);
  }
}

// Whoever pushes a row waits for its memory, which is asked for here for several.
void SilhouetteWalk2D::add_row(std::uint32_t first) {
  if (first == none) return;
  index_->rows().prefetch(first);
  rows_.push_back(first);
}

void SilhouetteWalk2D::push_rows() {
  for (const std::uint32_t row : rows_) {
    index_->each(row, [this](const BallRows::Item& item, BallRows::Place place) { push(item, place); });
  }
  rows_.clear();
}

void SilhouetteWalk2D::push(const BallRows::Item& item, BallRows::Place place) {
  const Vec2 d = Vec2(item.ball.centre) - sight_->eye();
  // As rounded: what is a little beyond the range is sorted out by whoever tests the object.
  const double square = glm::dot(d, d), most = limit_ + item.ball.radius;
  if (!(square <= most * most)) return;
  queue_.push_object(std::sqrt(square) - item.ball.radius, item.slot, place);
  pushed_.push_back(item.slot);
}

}  // namespace gridcull
