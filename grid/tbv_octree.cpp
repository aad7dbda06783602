#include "gridcull/grid/tbv_octree.h"

#include <algorithm>
#include <cmath>

namespace gridcull {

TbvOctree::TbvOctree(const Lattice& lattice, const Limits& limits) : lattice_(lattice), limits_(limits) {
  // A cube around the lattice, so much larger that no ball in it reaches the border with its margins.
  const Bounds box = lattice.box();
  const Vec3 size = box.size();
  const double rim = 8.0 * lattice.margin();
  origin_ = box.min - Vec3(rim);
  const double side = std::max({size.x, size.y, size.z}) + 2.0 * rim;
  const double least = lattice.cell() * static_cast<double>(limits.least_side);
  while (deepest_ + 1u < sides_.size() && std::ldexp(side, -(deepest_ + 1)) >= least) ++deepest_;
  for (int depth = 0; depth <= deepest_; ++depth) sides_[static_cast<std::size_t>(depth)] = std::ldexp(side, -depth);
  nodes_.emplace_back();
}

void TbvOctree::reserve(std::size_t count) {
  if (count > volumes_.capacity()) volumes_.reserve(count + count / 8);
  if (count > volumes_.size()) volumes_.resize(count);
}

std::uint64_t TbvOctree::bytes() const {
  return nodes_.capacity() * sizeof(Node) + entries_.capacity() * sizeof(Entry) + volumes_.capacity() * sizeof(Volume) +
         (thinned_.capacity() + stack_.capacity()) * sizeof(std::uint32_t);
}

// Powers of two scale without rounding, so neighbours of any depth agree on the boundary between them.
Bounds TbvOctree::box_of(const Node& node) const {
  const double side = sides_[node.depth];
  Bounds box;
  box.min = origin_ + side * Vec3(node.x, node.y, node.z);
  box.max = origin_ + side * Vec3(node.x + 1.0, node.y + 1.0, node.z + 1.0);
  return box;
}

bool TbvOctree::touches(const TbvBall& ball, const Node& node) const {
  const Bounds box = box_of(node);
  const double r = ball.radius + 2.0 * lattice_.margin();
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max({box.min[k] - ball.centre[k], ball.centre[k] - box.max[k], 0.0});
    square += gap * gap;
  }
  return square <= r * r;
}

bool TbvOctree::inside(const TbvBall& ball, const Node& node) const {
  const Bounds box = box_of(node);
  const double r = ball.radius + 3.0 * lattice_.margin();
  bool all = true;
  for (int k = 0; k < 3; ++k) all = all && ball.centre[k] - r >= box.min[k] && ball.centre[k] + r <= box.max[k];
  return all;
}

// Sudarsky and Gotsman's point: what lies above this node holds the volume before and after, and needs no look.
std::uint32_t TbvOctree::common_ancestor(std::uint32_t leaf, const TbvBall& old_ball, const TbvBall& new_ball) const {
  std::uint32_t node = leaf;
  while (nodes_[node].parent != none && !(inside(new_ball, nodes_[node]) && inside(old_ball, nodes_[node]))) {
    node = nodes_[node].parent;
  }
  return node;
}

void TbvOctree::insert(Slot slot, const TbvBall& ball) {
  volumes_[slot].ball = ball;
  enter(0, slot);
  ++size_;
}

void TbvOctree::erase(Slot slot) {
  take_out(slot);
  --size_;
  settle();
}

void TbvOctree::renew(Slot slot, const TbvBall& ball) {
  Volume& volume = volumes_[slot];
  const std::uint32_t ancestor = common_ancestor(entries_[volume.entries].leaf, volume.ball, ball);
  if (nodes_[ancestor].child == none && inside(ball, nodes_[ancestor])) {
    volume.ball = ball;  // it stays inside its leaf
    ++written_;
    return;
  }
  take_out(slot);
  volume.ball = ball;
  enter(ancestor, slot);
  settle();
}

void TbvOctree::enter(std::uint32_t node, Slot slot) {
  const TbvBall& ball = volumes_[slot].ball;
  if (nodes_[node].child == none) {
    link(node, slot);
    if (nodes_[node].size > limits_.split && nodes_[node].depth < deepest_) split(node);
    return;
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t child = nodes_[node].child + i;
    if (touches(ball, nodes_[child])) enter(child, slot);
  }
}

void TbvOctree::take_out(Slot slot) {
  for (std::uint32_t e = volumes_[slot].entries; e != none;) {
    const std::uint32_t next = entries_[e].next, parent = nodes_[entries_[e].leaf].parent;
    unlink(e);
    if (parent != none && (thinned_.empty() || thinned_.back() != parent)) thinned_.push_back(parent);
    e = next;
  }
}

void TbvOctree::link(std::uint32_t leaf, Slot slot) {
  std::uint32_t e = free_entries_;
  if (e != none) {
    free_entries_ = entries_[e].after;
  } else {
    e = static_cast<std::uint32_t>(entries_.size());
    entries_.emplace_back();
  }
  Node& node = nodes_[leaf];
  Volume& volume = volumes_[slot];
  entries_[e] = {slot, leaf, none, node.head, none, volume.entries};
  if (node.head != none) entries_[node.head].before = e;
  if (volume.entries != none) entries_[volume.entries].last = e;
  node.head = volume.entries = e;
  ++node.size;
  if (node.parent != none) ++nodes_[node.parent].size;
  ++written_;
}

void TbvOctree::unlink(std::uint32_t e) {
  Entry& entry = entries_[e];
  Node& node = nodes_[entry.leaf];
  (entry.before == none ? node.head : entries_[entry.before].after) = entry.after;
  if (entry.after != none) entries_[entry.after].before = entry.before;
  (entry.last == none ? volumes_[entry.slot].entries : entries_[entry.last].next) = entry.next;
  if (entry.next != none) entries_[entry.next].last = entry.last;
  --node.size;
  if (node.parent != none) --nodes_[node.parent].size;
  entry.after = free_entries_;
  free_entries_ = e;
  ++written_;
}

void TbvOctree::split(std::uint32_t leaf) {
  std::uint32_t child = free_nodes_;
  if (child != none) {
    free_nodes_ = nodes_[child].parent;
  } else {
    child = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 8);
  }
  const Node old = nodes_[leaf];
  for (std::uint32_t i = 0; i < 8; ++i) {
    Node& node = nodes_[child + i];
    node = Node{};
    node.parent = leaf;
    node.x = 2 * old.x + (i & 1), node.y = 2 * old.y + (i >> 1 & 1), node.z = 2 * old.z + (i >> 2);
    node.depth = static_cast<std::uint16_t>(old.depth + 1);
  }
  written_ += 9;
  if (old.parent != none) {
    ++nodes_[old.parent].inner;
    nodes_[old.parent].size -= old.size;
  }
  nodes_[leaf].child = child;
  nodes_[leaf].head = none;
  nodes_[leaf].size = 0;
  for (std::uint32_t e = old.head; e != none;) {
    const std::uint32_t next = entries_[e].after;
    const Slot slot = entries_[e].slot;
    // The leaf's counts are gone already: only the volume's own chain is left to mend.
    (entries_[e].last == none ? volumes_[slot].entries : entries_[entries_[e].last].next) = entries_[e].next;
    if (entries_[e].next != none) entries_[entries_[e].next].last = entries_[e].last;
    entries_[e].after = free_entries_;
    free_entries_ = e;
    ++written_;
    enter(leaf, slot);
    e = next;
  }
}

void TbvOctree::merge(std::uint32_t node) {
  const std::uint32_t child = nodes_[node].child, parent = nodes_[node].parent;
  stack_.clear();  // the volumes, once each
  const std::uint32_t stamp = begin_visit();
  for (std::uint32_t i = 0; i < 8; ++i) {
    while (nodes_[child + i].head != none) {
      const std::uint32_t e = nodes_[child + i].head;
      Volume& volume = volumes_[entries_[e].slot];
      if (volume.stamp != stamp) stack_.push_back(entries_[e].slot);
      volume.stamp = stamp;
      unlink(e);
    }
  }
  nodes_[child].parent = free_nodes_;
  free_nodes_ = child;
  nodes_[node].child = none;
  if (parent != none) --nodes_[parent].inner;
  ++written_;
  for (const Slot slot : stack_) link(node, slot);
}

void TbvOctree::settle() {
  while (!thinned_.empty()) {
    std::uint32_t node = thinned_.back();
    thinned_.pop_back();
    // A node that was merged away since is a leaf.
    while (node != none && nodes_[node].child != none && nodes_[node].inner == 0 &&
           nodes_[node].size <= limits_.merge) {
      merge(node);
      node = nodes_[node].parent;
    }
  }
}

std::uint32_t TbvOctree::begin_visit() {
  if (++stamp_ == 0) {
    for (Volume& volume : volumes_) volume.stamp = 0;
    stamp_ = 1;
  }
  return stamp_;
}

// Which side of the three planes between the children: most questions are small and go down one way.
void TbvOctree::open_children(const Node& node, const BrickCells& asked) {
  const double half = sides_[node.depth + 1u];
  const Vec3 middle = origin_ + half * Vec3(2.0 * node.x + 1.0, 2.0 * node.y + 1.0, 2.0 * node.z + 1.0);
  unsigned lower = 0, upper = 0;
  for (int k = 0; k < 3; ++k) {
    lower |= unsigned{asked.low()[k] <= middle[k]} << k;
    upper |= unsigned{asked.high()[k] >= middle[k]} << k;
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    if ((i & ~upper) == 0 && (~i & 7u & ~lower) == 0) stack_.push_back(node.child + i);
  }
}

std::string_view TbvOctree::fault() const {
  for (Slot slot = 0; slot < volumes_.size(); ++slot) {
    for (std::uint32_t e = volumes_[slot].entries; e != none; e = entries_[e].next) {
      if (entries_[e].slot != slot) return "an entry in another volume's chain";
      if (!touches(volumes_[slot].ball, nodes_[entries_[e].leaf])) return "a volume in a leaf that it does not touch";
    }
  }
  return fault_of(0);
}

std::string_view TbvOctree::fault_of(std::uint32_t index) const {
  const Node& node = nodes_[index];
  std::uint32_t size = 0, inner = 0;
  for (std::uint32_t e = node.head; e != none; e = entries_[e].after, ++size) {
    if (entries_[e].leaf != index) return "an entry in another leaf's list";
  }
  for (std::uint32_t i = 0; node.child != none && i < 8; ++i) {
    const Node& child = nodes_[node.child + i];
    if (child.parent != index) return "a child of another node";
    (child.child != none ? inner : size) += child.child != none ? 1 : child.size;
    const std::string_view below = fault_of(node.child + i);
    if (!below.empty()) return below;
  }
  if (size != node.size || inner != node.inner) return "a count that is wrong";
  if (node.child == none && node.depth < deepest_ && size > limits_.split) return "a full leaf that is not split";
  if (node.child != none && inner == 0 && size <= limits_.merge) return "leaves that are not merged";
  return {};
}

}  // namespace gridcull
