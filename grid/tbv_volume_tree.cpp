#include "gridcull/grid/tbv_volume_tree.h"

#include <algorithm>
#include <array>

namespace gridcull {
namespace {

/// Half the surface, square metres.
double area(const Bounds& box) {
  const Vec3 s = box.max - box.min;
  return s.x * s.y + s.y * s.z + s.z * s.x;
}

Bounds both(const Bounds& a, const Bounds& b) {
  Bounds box;
  for (int k = 0; k < 3; ++k) box.min[k] = std::min(a.min[k], b.min[k]), box.max[k] = std::max(a.max[k], b.max[k]);
  return box;
}

bool same(const Bounds& a, const Bounds& b) { return a.min == b.min && a.max == b.max; }

bool inside(const Bounds& a, const Bounds& b) { return same(both(a, b), b); }

}  // namespace

void TbvVolumeTree::reserve(std::size_t count) {
  if (count <= volumes_.size()) return;
  if (count > volumes_.capacity()) {
    volumes_.reserve(count + count / 8);
    nodes_.reserve(2 * volumes_.capacity());
  }
  volumes_.resize(count);
}

std::uint64_t TbvVolumeTree::bytes() const {
  return nodes_.capacity() * sizeof(Node) + volumes_.capacity() * sizeof(Volume) +
         stack_.capacity() * sizeof(std::uint32_t);
}

std::uint32_t TbvVolumeTree::new_node() {
  const std::uint32_t node = free_;
  if (node == none) {
    nodes_.emplace_back();
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }
  free_ = nodes_[node].parent;
  return node;
}

void TbvVolumeTree::free_node(std::uint32_t node) {
  nodes_[node].parent = free_;
  free_ = node;
}

void TbvVolumeTree::insert(Slot slot, const TbvBall& ball) {
  const std::uint32_t leaf = new_node();
  volumes_[slot] = {ball, leaf};
  nodes_[leaf].box = ball.box();
  nodes_[leaf].left = none;
  nodes_[leaf].right = slot;
  hang_in(leaf);
  ++size_;
}

void TbvVolumeTree::erase(Slot slot) {
  const std::uint32_t leaf = volumes_[slot].leaf;
  unhang(leaf);
  free_node(leaf);
  volumes_[slot].leaf = none;
  --size_;
}

void TbvVolumeTree::renew(Slot slot, const TbvBall& ball) {
  Volume& volume = volumes_[slot];
  volume.ball = ball;
  const Bounds box = ball.box();
  std::uint32_t home = volume.leaf;
  for (int i = 0; i < home_levels && nodes_[home].parent != none; ++i) home = nodes_[home].parent;
  const bool left = !inside(box, nodes_[home].box);
  if (left) unhang(volume.leaf);
  nodes_[volume.leaf].box = box;
  ++written_;
  if (left) return hang_in(volume.leaf);
  refit(nodes_[volume.leaf].parent);
}

void TbvVolumeTree::hang_in(std::uint32_t leaf) {
  ++written_;
  if (root_ == none) {
    root_ = leaf;
    nodes_[leaf].parent = none;
    return;
  }
  const std::uint32_t sibling = best_sibling(nodes_[leaf].box);
  const std::uint32_t parent = new_node(), above = nodes_[sibling].parent;
  nodes_[parent] = {both(nodes_[leaf].box, nodes_[sibling].box), above, sibling, leaf};
  replace_child(above, sibling, parent);
  nodes_[sibling].parent = nodes_[leaf].parent = parent;
  written_ += 2;
  refit(above);
}

void TbvVolumeTree::unhang(std::uint32_t leaf) {
  const std::uint32_t parent = nodes_[leaf].parent;
  if (parent == none) {
    root_ = none;
    return;
  }
  const std::uint32_t sibling = nodes_[parent].left == leaf ? nodes_[parent].right : nodes_[parent].left;
  const std::uint32_t above = nodes_[parent].parent;
  nodes_[sibling].parent = above;
  replace_child(above, parent, sibling);
  free_node(parent);
  written_ += 2;
  refit(above);
}

void TbvVolumeTree::replace_child(std::uint32_t parent, std::uint32_t before, std::uint32_t after) {
  if (parent == none) {
    root_ = after;
  } else {
    (nodes_[parent].left == before ? nodes_[parent].left : nodes_[parent].right) = after;
  }
}

// Where the sum of all areas grows least: a new parent here, or what the child would cost on top of growing this.
std::uint32_t TbvVolumeTree::best_sibling(const Bounds& box) const {
  std::uint32_t node = root_;
  while (!nodes_[node].leaf()) {
    const double grown = area(both(nodes_[node].box, box));
    const double here = 2.0 * grown, inherited = 2.0 * (grown - area(nodes_[node].box));
    const auto below = [&](std::uint32_t child) {
      const double with = area(both(nodes_[child].box, box));
      return inherited + (nodes_[child].leaf() ? with : with - area(nodes_[child].box));
    };
    const double left = below(nodes_[node].left), right = below(nodes_[node].right);
    if (here < left && here < right) break;
    node = left <= right ? nodes_[node].left : nodes_[node].right;
  }
  return node;
}

void TbvVolumeTree::refit(std::uint32_t node) {
  while (node != none) {
    const Bounds box = both(nodes_[nodes_[node].left].box, nodes_[nodes_[node].right].box);
    if (same(box, nodes_[node].box)) return;
    nodes_[node].box = box;
    ++written_;
    rotate(node);
    node = nodes_[node].parent;
  }
}

// Of the four swaps of a child for a grandchild the one that takes most area off the other child's box, if any does.
void TbvVolumeTree::rotate(std::uint32_t node) {
  const std::array<std::uint32_t, 2> children{nodes_[node].left, nodes_[node].right};
  double best = 0.0;
  std::uint32_t down = none, up = none;
  for (std::size_t i = 0; i < 2; ++i) {
    const Node& other = nodes_[children[1 - i]];
    if (other.leaf()) continue;
    const double now = area(other.box);
    const auto offer = [&](std::uint32_t rises, std::uint32_t stays) {
      const double gain = now - area(both(nodes_[children[i]].box, nodes_[stays].box));
      if (gain > best) best = gain, down = children[i], up = rises;
    };
    offer(other.left, other.right);
    offer(other.right, other.left);
  }
  if (down != none) swap(node, down, up);
}

void TbvVolumeTree::swap(std::uint32_t node, std::uint32_t child, std::uint32_t grandchild) {
  const std::uint32_t other = nodes_[grandchild].parent;
  replace_child(node, child, grandchild);
  replace_child(other, grandchild, child);
  nodes_[grandchild].parent = node;
  nodes_[child].parent = other;
  nodes_[other].box = both(nodes_[nodes_[other].left].box, nodes_[nodes_[other].right].box);
  written_ += 4;
}

double TbvVolumeTree::cost() const {
  double sum = 0.0;
  std::vector<std::uint32_t> open;
  if (root_ != none) open.push_back(root_);
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (node.leaf()) continue;
    sum += area(node.box);
    open.push_back(node.left);
    open.push_back(node.right);
  }
  return root_ == none ? 0.0 : sum / area(nodes_[root_].box);
}

std::string_view TbvVolumeTree::fault() const {
  for (Slot slot = 0; slot < volumes_.size(); ++slot) {
    const Volume& volume = volumes_[slot];
    if (volume.leaf == none) continue;
    if (nodes_[volume.leaf].right != slot) return "a leaf of another volume";
    if (!same(nodes_[volume.leaf].box, volume.ball.box())) return "a leaf whose box is not its ball's";
  }
  return root_ == none ? std::string_view() : fault_of(root_);
}

std::string_view TbvVolumeTree::fault_of(std::uint32_t index) const {
  const Node& node = nodes_[index];
  if (node.leaf()) return {};
  for (const std::uint32_t child : {node.left, node.right}) {
    if (nodes_[child].parent != index) return "a child of another node";
    const std::string_view below = fault_of(child);
    if (!below.empty()) return below;
  }
  if (!same(node.box, both(nodes_[node.left].box, nodes_[node.right].box))) return "a box that is not its children's";
  return {};
}

}  // namespace gridcull
