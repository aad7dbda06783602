// Method `silhouette` in 3D: the way from the nodes of the loose index to the objects (see silhouette_3d.cpp).
//
// Where a node holds many, its own box is tested. Where it holds few, they are gathered, whatever their depth below it,
// and the box about them is tested, when its own distance has come: nodes are loose, and many would be opened for one
// object. A group that is hidden hides all of it: its box holds its members' balls, or what they fill of them, and its
// key is the distance of that box.
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "gridcull/grid/silhouette_3d.h"

namespace gridcull {
namespace {

/// Entries that are gathered into a group, and how many are worth a test: it costs as much as those of the few entries
/// that it might spare.
constexpr std::uint32_t few = 16, worth_testing = 3;

/// Distances are rounded three or four times, each by at most 2^-52 of the coordinates that went in.
constexpr double rounding = 0x1p-46;

double magnitude(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

double distance_to_box(const Vec3& low, const Vec3& high) {
  const auto gap = [&](int k) { return std::max({low[k], -high[k], 0.0}); };
  const double x = gap(0), y = gap(1), z = gap(2);
  return std::sqrt(x * x + y * y + z * z);
}

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

void Silhouette3D::push_node(const LooseIndex::NodeId& id) {
  const Box box = box_of(id);
  const double key = distance_to_box(box.low, box.high) - blur_;
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
  index.each(node.first, [this](const BallRows::Item& item, BallRows::Place) { prefetch_ball(item); });
  index.each(node.first, [this](const BallRows::Item& item, BallRows::Place place) { push_entry(item, place); });
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
  Group group{{Vec3(infinity), Vec3(-infinity)}, id, first, 0};
  gather(id, shapes_->index.node(id));
  group.count = weigh_all(first, group.box);
  if (group.count < worth_testing) return push_entries(group);
  groups_.push_back(group);
  queue_.push(FrontQueue::Kind::group, distance_to_box(group.box.low, group.box.high) - blur_, groups_.size() - 1);
}

void Silhouette3D::gather(const LooseIndex::NodeId& id, const LooseIndex::Node& node) {
  const LooseIndex& index = shapes_->index;
  index.each(node.first, [&](const BallRows::Item& item, BallRows::Place place) {
    prefetch_ball(item);
    entries_.push_back({0.0, place, kind_of(item)});
  });
  const LooseIndex::Node* children = id.level > 0 ? index.children(id) : nullptr;
  for (int child = 0; children != nullptr && child < 8; ++child) {
    if (children[child].below == 0) continue;
    gather({id.level - 1, 2 * id.x + (child & 1), 2 * id.y + (child >> 1 & 1), 2 * id.z + (child >> 2)},
           children[child]);
  }
}

std::uint32_t Silhouette3D::weigh_all(std::uint32_t first, Box& box) {
  std::uint32_t kept = first;
  for (std::uint32_t i = first; i < entries_.size(); ++i) {
    Entry& entry = entries_[kept] = entries_[i];
    const BallRows::Item& item = shapes_->index.item(entry.place);
    if (weigh(item, ball_of(item), SilhouetteWorld::upright_now(item.marks), entry.key, box)) ++kept;
  }
  entries_.resize(kept);
  return kept - first;
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
  for (std::uint32_t i = group.first; i < group.first + group.count; ++i) {
    const Entry& entry = entries_[i];
    const BallRows::Item& item = shapes_->index.item(entry.place);
    if ((item.marks & SilhouetteWorld::is_ball) == 0) shapes_->prefetch_body(item.slot);
    queue_.push(entry.kind, entry.key, entry.place);
  }
}

void Silhouette3D::push_entry(const BallRows::Item& item, BallRows::Place place) {
  double key;
  Box box;
  if (!weigh(item, ball_of(item), SilhouetteWorld::upright_now(item.marks), key, box)) return;
  if ((item.marks & SilhouetteWorld::is_ball) == 0) shapes_->prefetch_body(item.slot);
  queue_.push(kind_of(item), key, place);
}

void Silhouette3D::push_object(BallRows::Place place, const LooseBall& ball, bool upright) {
  double key;
  Box box;
  if (weigh(shapes_->index.item(place), ball, upright, key, box)) queue_.push(FrontQueue::Kind::object, key, place);
}

double Silhouette3D::grown(const LooseBall& ball) const {
  return ball.radius + rounding * (apex_size_ + magnitude(ball.centre) + ball.radius);
}

// What lies beside the window is neither seen nor hides what is. The key is the distance of the ball, or of the upright
// cylinder that holds the object: both are grown by 64 times what the few roundings here may add.
bool Silhouette3D::weigh(const BallRows::Item& item, const LooseBall& ball, bool upright, double& key, Box& box) const {
  if (item.slot == rides_) return false;
  const Vec3 centre = ball.centre - volume_->apex();
  const double radius = grown(ball);
  const auto [wide, tall] = SilhouetteWorld::filling(item, upright, ball.radius, radius);
  if (upright) {
    const double beside = std::max(0.0, std::sqrt(centre.x * centre.x + centre.y * centre.y) - wide);
    const double above = std::max(0.0, std::fabs(centre.z) - tall);
    key = std::sqrt(beside * beside + above * above);
  } else {
    key = glm::length(centre) - radius;
  }
  if (key > limit_ || mask_.beyond_window(centre, radius)) return false;
  box.low = glm::min(box.low, centre - Vec3(wide, wide, tall));
  box.high = glm::max(box.high, centre + Vec3(wide, wide, tall));
  return true;
}

}  // namespace gridcull
