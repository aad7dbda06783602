#include "gridcull/methods/box_tree.h"

#include <algorithm>

namespace gridcull {

void BoxTree::build(std::vector<Item>& items) {
  nodes_.clear();
  names_.clear();
  if (!items.empty()) split(items, 0, static_cast<std::uint32_t>(items.size()));
  for (const Item& item : items) names_.push_back(item.name);
  built_surface_ = total_surface();
}

void BoxTree::split(std::vector<Item>& items, std::uint32_t first, std::uint32_t count) {
  const std::size_t at = nodes_.size();
  nodes_.emplace_back();
  Bounds box, middles;
  const auto begin = items.begin() + first, end = begin + count;
  for (auto item = begin; item != end; ++item) {
    box.add(item->box.min);
    box.add(item->box.max);
    middles.add(item->box.centre());
  }
  nodes_[at].box = box;
  nodes_[at].first = first;
  nodes_[at].count = count;
  if (count <= most_in_leaf) return;
  const Vec3 size = middles.size();
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, end, [axis](const Item& a, const Item& b) {
    const double x = a.box.centre()[axis], y = b.box.centre()[axis];
    return x < y || (x == y && a.tie < b.tie);
  });
  split(items, first, half);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  split(items, first + half, count - half);
}

void BoxTree::add_at(std::uint32_t at, const Vec3& point, std::vector<std::uint32_t>& out) const {
  const Node& node = nodes_[at];
  for (int k = 0; k < 3; ++k) {
    if (!(node.box.min[k] <= point[k] && point[k] <= node.box.max[k])) return;
  }
  if (node.right == 0) {
    out.insert(out.end(), names_.begin() + node.first, names_.begin() + node.first + node.count);
    return;
  }
  add_at(at + 1, point, out);
  add_at(node.right, point, out);
}

double BoxTree::total_surface() const {
  double sum = 0.0;
  for (const Node& node : nodes_) {
    const Vec3 s = node.box.size();
    sum += s.x * s.y + s.y * s.z + s.z * s.x;
  }
  return sum;
}

}  // namespace gridcull
