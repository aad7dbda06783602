#include "gridcull/methods/five_d_subtree.h"

#include <algorithm>

namespace gridcull {

void append(FiveDTree& whole, const FiveDTree& part, const FiveDSpace& space) {
  const auto nodes = static_cast<std::uint32_t>(whole.nodes.size());
  const auto sets = static_cast<std::uint32_t>(whole.leaves(space));
  for (FiveDNode node : part.nodes) {
    node.second += node.axis == FiveDNode::leaf ? sets : nodes;
    whole.nodes.push_back(node);
  }
  whole.sets.insert(whole.sets.end(), part.sets.begin(), part.sets.end());
}

void merge_equal_leaves(FiveDTree& tree, std::size_t node, const FiveDSpace& space) {
  if (tree.nodes.size() != node + 3) return;
  const FiveDNode &a = tree.nodes[node + 1], &b = tree.nodes[node + 2];
  if (a.axis != FiveDNode::leaf || b.axis != FiveDNode::leaf) return;
  if (!std::ranges::equal(tree.set(space, a.second), tree.set(space, b.second))) return;
  tree.nodes[node] = a;
  tree.nodes.resize(node + 1);
  tree.sets.resize(tree.sets.size() - space.words());
}

Subtree SubtreeBuilder::build(CellWork work) {
  out_ = {};
  grow(std::move(work));
  return std::move(out_);
}

/// The cells of its budget that a part did not need. They go to its sibling, which is built after it.
std::uint32_t SubtreeBuilder::grow(CellWork work) {
  if (stop_) return 0;
  const auto split = choose_split(scene_, options_, work, scratch_, out_.rays);
  if (!split) {
    add_leaf(work);
    return work.budget - 1;
  }
  const std::size_t node = out_.tree.nodes.size();
  out_.tree.nodes.push_back({static_cast<std::uint8_t>(split->axis), split->step, 0});
  std::array<CellWork, 2> parts = divide(scene_, work, *split);
  const std::uint32_t spare = grow(std::move(parts[0]));
  out_.tree.nodes[node].second = static_cast<std::uint32_t>(out_.tree.nodes.size());
  parts[1].budget += spare;
  const std::uint32_t left = grow(std::move(parts[1]));
  merge_equal_leaves(out_.tree, node, scene_.space());
  return left;
}

void SubtreeBuilder::add_leaf(const CellWork& work) {
  const LeafSets sets = judge_leaf(scene_, options_, test_, work, scratch_, out_.rays);
  add_eighths(sets, 0, sets.count);
  ++out_.cells;
  done_ += static_cast<std::uint64_t>(work.share * 0x1p50);
}

/// Eighths first .. first + count - 1 of those that the sets have.
void SubtreeBuilder::add_eighths(const LeafSets& sets, int first, int count) {
  FiveDTree& tree = out_.tree;
  const std::size_t words = scene_.space().words(), node = tree.nodes.size();
  if (count == 1) {
    tree.nodes.push_back({FiveDNode::leaf, 0, static_cast<std::uint32_t>(tree.leaves(scene_.space()))});
    const auto begin = sets.words.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(first) * words);
    tree.sets.insert(tree.sets.end(), begin, begin + static_cast<std::ptrdiff_t>(words));
    return;
  }
  const int half = count / 2;
  const auto eighth = static_cast<std::uint32_t>(sets.first + first + half);
  tree.nodes.push_back({turn_axis, eighth * (scene_.space().steps() / 8), 0});
  add_eighths(sets, first, half);
  tree.nodes[node].second = static_cast<std::uint32_t>(tree.nodes.size());
  add_eighths(sets, first + half, count - half);
  merge_equal_leaves(tree, node, scene_.space());
}

}  // namespace gridcull
