// A binary tree of axis-aligned boxes over boxes: the hierarchy of Hudson et al. 1997, section 3.1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"

namespace gridcull {

class BoxTree {
 public:
  static constexpr std::uint32_t most_in_leaf = 4;

  struct Item {
    Bounds box;
    std::uint32_t name;  ///< what the walk hands out
    std::uint32_t tie;   ///< unique: orders items with the same middle
  };
  /// Its left child is the next node.
  struct Node {
    Bounds box;
    std::uint32_t right = 0;             ///< 0: a leaf
    std::uint32_t first = 0, count = 0;  ///< the items below
  };

  /// Splits at the median of the longest side of the middles' box. Depends on the set of items, not on their order.
  void build(std::vector<Item>& items);
  /// New boxes for the same items: box_of(name). Whether the tree has become so loose that it should be built anew:
  /// the half surfaces of all nodes together are more than `looseness` times what they were.
  template <class BoxOf>
  bool refit(const BoxOf& box_of) {
    for (std::size_t i = nodes_.size(); i-- > 0;) fit(i, box_of);
    return total_surface() > looseness * built_surface_;
  }

  /// Appends the names of the items of all leaves whose box holds the point.
  void add_at(const Vec3& point, std::vector<std::uint32_t>& out) const {
    if (!nodes_.empty()) add_at(0, point, out);
  }

  bool empty() const { return nodes_.empty(); }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  std::span<const std::uint32_t> names(const Node& node) const {
    return std::span<const std::uint32_t>(names_).subspan(node.first, node.count);
  }

 private:
  static constexpr double looseness = 1.5;

  void split(std::vector<Item>& items, std::uint32_t first, std::uint32_t count);
  void add_at(std::uint32_t at, const Vec3& point, std::vector<std::uint32_t>& out) const;
  double total_surface() const;
  template <class BoxOf>
  void fit(std::size_t i, const BoxOf& box_of) {
    Node& node = nodes_[i];
    node.box = Bounds{};
    const auto add = [&node](const Bounds& b) {
      node.box.add(b.min);
      node.box.add(b.max);
    };
    if (node.right == 0) {
      for (const std::uint32_t name : names(node)) add(box_of(name));
    } else {
      add(nodes_[i + 1].box);
      add(nodes_[node.right].box);
    }
  }

  std::vector<Node> nodes_{};
  std::vector<std::uint32_t> names_{};
  double built_surface_ = 0.0;
};

}  // namespace gridcull
