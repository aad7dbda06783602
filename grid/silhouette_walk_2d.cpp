#include "gridcull/grid/silhouette_walk_2d.h"

#include <algorithm>
#include <bit>
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
void SilhouetteWalk2D::begin(const LooseIndex& index, const StaticRows2D& rows, std::span<const Slot> outside,
                             const Sight2D& sight) {
  index_ = &index;
  static_rows_ = &rows;
  sight_ = &sight;
  spots_.clear();
  row_spots_.clear();
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
  if (!rows.empty()) {
    const Box2D& box = rows.box();
    far = std::max(far, glm::length(glm::max(glm::abs(box.low - sight.eye()), glm::abs(box.high - sight.eye()))));
  }
  queue_.begin(std::min(far, sight.range()));
  for (std::size_t i = 0, tops = spots_.size(); i < tops; ++i) take(Spot(spots_[i]), index.node(spots_[i].id));
  push_rows();
  if (!rows.empty()) push_row({{rows.top(), 0}, rows.box(), {}, false});
  for (const Slot slot : outside) push(index.item(index.place_of(slot)), index.place_of(slot));
}

void SilhouetteWalk2D::take(const Spot& spot, const LooseIndex::Node& node) {
  const double half = reach(spot.id.level);
  const Vec2 d = glm::max(glm::abs(spot.middle - sight_->eye()) - half, Vec2(0.0));
  const double square = glm::dot(d, d);
  if (square > limit_ * limit_) return;
  if (node.below <= crowd) {
    // Nobody asked whether they can be seen, so that says nothing of what may hang here (LooseIndex::lately_opened()).
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

void SilhouetteWalk2D::push_row(const RowSpot& spot) {
  const double square = square_of(spot.box);
  if (square > limit_ * limit_) return;
  static_rows_->prefetch(spot.id);
  queue_.push_node(std::sqrt(square), is_row | static_cast<std::uint32_t>(row_spots_.size()));
  row_spots_.push_back(spot);
}

void SilhouetteWalk2D::push_member(const RowSpot& spot, Slot slot) {
  const double square = square_of(spot.box);
  if (square > limit_ * limit_) return;
  queue_.push_object(std::sqrt(square), slot, is_row | static_cast<std::uint32_t>(row_spots_.size()));
  row_spots_.push_back(spot);
  pushed_.push_back(slot);
}

void SilhouetteWalk2D::open_row(RowSpot spot, const Silhouettes2D& silhouettes, WorkCounts& work) {
  if (hides(silhouettes, spot)) {
    ++work.cells_hidden;
    if (noted_ != nullptr) noted_->hidden_rows.push_back(spot.box);
    return;
  }
  ++work.cells_visited;
  const StaticRows2D::Row& row = static_rows_->row(spot.id);
  const bool has_members = spot.id.level == 0;
  if (has_members) work.object_tests += static_cast<std::uint64_t>(std::popcount(row.there));
  if (noted_ != nullptr && has_members) noted_->opened_rows.push_back(spot.box);
  sight_->spans_of(row.boxes, spans_);
  for (unsigned left = row.there; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const RowSpot of_lane{{spot.id.level - 1, row.what[lane]},
                          StaticRows2D::box_of(row, lane),
                          spans_[lane],
                          (row.occluders >> lane & 1) != 0};
    if (!has_members) {
      push_row(of_lane);
    } else if (!hides(silhouettes, of_lane)) {
      push_member(of_lane, row.what[lane]);
    }
  }
}

}  // namespace gridcull
