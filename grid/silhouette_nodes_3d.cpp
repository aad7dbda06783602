// Method `silhouette` in 3D: the way from the nodes of the loose index to the objects (see silhouette_3d.cpp).
//
// Where a node holds many, its own box is tested. Where it holds few, they are gathered, whatever their depth below it,
// and the box about them is tested, when its own distance has come: nodes are loose, and many would be opened for one
// object. A group that is hidden hides all of it: its box holds its members' balls, or what they fill of them, and its
// key is the distance of that box.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "gridcull/grid/box_distance.h"
#include "gridcull/grid/silhouette_3d.h"

namespace gridcull {
namespace {

/// Entries that are gathered into a group, and how many are worth a test: it costs as much as those of the few entries
/// that it might spare.
constexpr std::uint32_t few = 32, worth_testing = 4;

FrontQueue::Kind kind_of(const BallRows::Item& item) {
  return (item.marks & SilhouetteWorld::is_hidden) != 0 ? FrontQueue::Kind::volume : FrontQueue::Kind::object;
}

}  // namespace

// The index grows a node's box by a margin that covers its own rounding; blur_ covers that of these sums.
Silhouette3D::Box Silhouette3D::box_of(const LooseIndex::NodeId& id) const {
  const double side = shapes_->index.side(id.level);
  const double grown = 0.5 * side + shapes_->index.margin() + blur_;
  const Vec3 low = corner_ + side * Vec3(id.x, id.y, id.z);
  return {low - Vec3(grown), low + Vec3(side + grown)};
}

double Silhouette3D::key_of(const Box& box) const { return distance_to_box(box.low, box.high) - blur_; }

void Silhouette3D::push_node(const LooseIndex::NodeId& id) {
  const Box box = box_of(id);
  const double key = key_of(box);
  // Half the diagonal of a cube is below 0.8661 sides: that ball holds all that hangs in the node and below.
  const double reach = 0.8661 * (box.high.x - box.low.x);
  if (key > limit_ || mask_.beyond_window(0.5 * (box.low + box.high), reach)) return;
  nodes_.push_back(id);
  queue_.push(FrontQueue::Kind::node, key, nodes_.size() - 1);
}

void Silhouette3D::open_node(LooseIndex::NodeId id) {
  const LooseIndex& index = shapes_->index;
  const LooseIndex::Node& node = index.node(id);
  if (node.below <= few) return push_group(id);
  const Box box = box_of(id);
  if (!mask_.open_box(box.low, box.high)) {
    ++answer_->work.cells_hidden;
    if (drawing_) walked_.hidden.push_back(id);
    return;
  }
  ++answer_->work.cells_visited;
  index.note_opened(id);
  if (drawing_) walked_.opened.push_back(id);
  const auto first = static_cast<std::uint32_t>(entries_.size());
  index.each(node.first, [this](const BallRows::Item& item, BallRows::Place place) { weigh(item, place); });
  weigh_rest();
  push_range(first, static_cast<std::uint32_t>(entries_.size()));
  if (id.level > 0) push_children(id);
}

void Silhouette3D::push_children(const LooseIndex::NodeId& id) {
  const LooseIndex::Node* children = shapes_->index.children(id);
  if (children == nullptr) return;
  for (int child = 0; child < 8; ++child) {
    if (children[child].below == 0) continue;
    shapes_->index.rows().prefetch(children[child].first);
    push_node({id.level - 1, 2 * id.x + (child & 1), 2 * id.y + (child >> 1 & 1), 2 * id.z + (child >> 2)});
  }
}

void Silhouette3D::push_group(const LooseIndex::NodeId& id) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto first = static_cast<std::uint32_t>(entries_.size());
  box_ = {Vec3(infinity), Vec3(-infinity)};
  gather(id, shapes_->index.node(id));
  weigh_rest();
  const Group group{box_, id, first, static_cast<std::uint32_t>(entries_.size()) - first};
  if (group.count < worth_testing) return push_entries(group);
  groups_.push_back(group);
  queue_.push(FrontQueue::Kind::group, key_of(group.box), groups_.size() - 1);
}

void Silhouette3D::gather(const LooseIndex::NodeId& id, const LooseIndex::Node& node) {
  const LooseIndex& index = shapes_->index;
  index.each(node.first, [this](const BallRows::Item& item, BallRows::Place place) { weigh(item, place); });
  const LooseIndex::Node* children = id.level > 0 ? index.children(id) : nullptr;
  for (int child = 0; children != nullptr && child < 8; ++child) {
    if (children[child].below == 0) continue;
    const LooseIndex::NodeId at{id.level - 1, 2 * id.x + (child & 1), 2 * id.y + (child >> 1 & 1),
                                2 * id.z + (child >> 2)};
    if (key_of(box_of(at)) <= limit_) gather(at, children[child]);
  }
}

void Silhouette3D::look_at_group(const Group& group) {
  if (!mask_.open_box(group.box.low, group.box.high)) {
    ++answer_->work.cells_hidden;
    if (drawing_) walked_.hidden.push_back(group.node);
    return;
  }
  push_entries(group);
}

void Silhouette3D::push_entries(const Group& group) {
  ++answer_->work.cells_visited;
  shapes_->index.note_opened(group.node);
  if (drawing_) walked_.opened.push_back(group.node);
  push_range(group.first, group.first + group.count);
}

void Silhouette3D::push_range(std::uint32_t first, std::uint32_t end) {
  for (std::uint32_t i = first; i < end; ++i) {
    const BallRows::Item& item = shapes_->index.item(entries_[i].place);
    if ((item.marks & SilhouetteWorld::is_ball) == 0) shapes_->prefetch_body(item.slot);
    queue_.push(entries_[i].kind, entries_[i].key, i);
  }
}

void Silhouette3D::push_object(BallRows::Place place, const LooseBall& ball, bool upright) {
  const auto first = static_cast<std::uint32_t>(entries_.size());
  load(ball, shapes_->index.item(place), upright, place, FrontQueue::Kind::object);
  place_balls();
  push_range(first, static_cast<std::uint32_t>(entries_.size()));
}

double Silhouette3D::grown(const LooseBall& ball) const {
  return ball.radius + distance_rounding * (apex_size_ + magnitude(ball.centre) + ball.radius);
}

void Silhouette3D::weigh(const BallRows::Item& item, BallRows::Place place) {
  if (item.slot == rides_) return;
  prefetch_ball(item);
  waiting_.push_back(place);
}

void Silhouette3D::weigh_rest() {
  for (const BallRows::Place place : waiting_) {
    const BallRows::Item& item = shapes_->index.item(place);
    load(ball_of(item), item, SilhouetteWorld::upright_now(item.marks), place, kind_of(item));
    if (balls_.count == 8) place_balls();
  }
  waiting_.clear();
  if (balls_.count > 0) place_balls();
}

void Silhouette3D::load(const LooseBall& ball, const BallRows::Item& item, bool upright, BallRows::Place place,
                        FrontQueue::Kind kind) {
  const auto k = static_cast<std::size_t>(balls_.count++);
  balls_.x[k] = ball.centre.x, balls_.y[k] = ball.centre.y, balls_.z[k] = ball.centre.z;
  balls_.radius[k] = ball.radius;
  balls_.wide[k] = upright ? item.wide : -1.0;
  balls_.tall[k] = item.tall;
  places_[k] = place;
  kinds_[k] = kind;
}

// What lies beside the window is neither seen nor hides what is. The key is the distance of the ball, or of the upright
// cylinder that holds the object: both are grown by 64 times what the few roundings there may add.
void Silhouette3D::place_balls() {
  mask_.place_balls(outlook_, balls_, batch_);
  balls_.count = 0;
  for (unsigned left = batch_.kept; left != 0; left &= left - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(left));
    const auto short_of = [](int x) { return static_cast<std::int16_t>(x); };
    entries_.push_back(
        {batch_.key[k],
         places_[k],
         kinds_[k],
         static_cast<std::int8_t>((batch_.single >> k & 1) != 0 ? batch_.face[k] : -1),
         {short_of(batch_.x0[k]), short_of(batch_.x1[k]), short_of(batch_.y0[k]), short_of(batch_.y1[k])}});
    const Vec3 centre(batch_.x[k], batch_.y[k], batch_.z[k]), half(batch_.wide[k], batch_.wide[k], batch_.tall[k]);
    box_.low = glm::min(box_.low, centre - half);
    box_.high = glm::max(box_.high, centre + half);
  }
}

}  // namespace gridcull
