// The three codings of the five-dimensional tree, and range queries on it.
#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/random.h"
#include "gridcull/core/trigonometry.h"
#include "gridcull/methods/five_d_code.h"
#include "gridcull/methods/five_d_query.h"
#include "gridcull/methods/five_d_subtree.h"

namespace gridcull::test {
namespace {

FiveDSpace space_of(int dimension, std::uint32_t members) {
  FiveDSpace space;
  space.dimension = dimension;
  space.bits = 6;
  space.positions = {Vec3(-10, -20, dimension == 3 ? -5 : 0), Vec3(10, 20, dimension == 3 ? 5 : 0)};
  space.statics = members;
  return space;
}

/// A random tree: each node divides at a random step of a random axis, or is a leaf with a random set.
class RandomTree {
 public:
  RandomTree(const FiveDSpace& space, std::uint64_t seed, int depth, double density)
      : space_(space), random_(seed), density_(density) {
    std::array<std::uint32_t, view_axes> low{}, high{};
    high.fill(space.steps());
    grow(low, high, depth);
  }
  FiveDTree tree{};

 private:
  void grow(std::array<std::uint32_t, view_axes> low, std::array<std::uint32_t, view_axes> high, int depth) {
    const std::size_t node = tree.nodes.size();
    std::size_t axis = random_.below(view_axes);
    while (!space_.has(static_cast<int>(axis))) axis = random_.below(view_axes);
    if (depth == 0 || high[axis] - low[axis] < 2 || random_.unit() < 0.1) return add_leaf();
    const std::uint32_t step = low[axis] + 1 + random_.below(high[axis] - low[axis] - 1);
    tree.nodes.push_back({static_cast<std::uint8_t>(axis), step, 0});
    auto first = high, second = low;
    first[axis] = second[axis] = step;
    grow(low, first, depth - 1);
    tree.nodes[node].second = static_cast<std::uint32_t>(tree.nodes.size());
    grow(second, high, depth - 1);
  }
  void add_leaf() {
    tree.nodes.push_back({FiveDNode::leaf, 0, static_cast<std::uint32_t>(tree.leaves(space_))});
    const std::size_t begin = tree.sets.size();
    tree.sets.resize(begin + space_.words(), 0);
    for (std::uint32_t m = 0; m < space_.members(); ++m) {
      if (random_.unit() < density_) tree.sets[begin + m / 64] |= std::uint64_t{1} << (m % 64);
    }
  }
  const FiveDSpace& space_;
  Random random_;
  double density_;
};

bool same(const FiveDTree& a, const FiveDTree& b) {
  const auto equal = [](const FiveDNode& x, const FiveDNode& y) {
    return x.axis == y.axis && x.step == y.step && x.second == y.second;
  };
  return a.sets == b.sets && std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), equal);
}

/// The leaf that holds a line of sight; on a plane the far side.
std::span<const std::uint64_t> leaf_at(const FiveDTree& tree, const FiveDSpace& space, const Vec3& from,
                                       const Vec3& d) {
  const std::array<double, view_axes> at{from.x, from.y, from.z, turn_of(d), rise_of(d)};
  std::uint32_t i = 0;
  while (tree.nodes[i].axis != FiveDNode::leaf) {
    const FiveDNode& node = tree.nodes[i];
    i = at[node.axis] >= space.plane(node.axis, node.step) ? node.second : i + 1;
  }
  return tree.set(space, tree.nodes[i].second);
}

Quat random_turn(Random& random) {
  return normalised({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
}

}  // namespace

TEST_CASE("turns grow with the angle, rises with the elevation") {
  double last = -1.0;
  for (int i = 0; i < 4000; ++i) {
    const SinCos angle = stable_sincos(6.283185307 * i / 4000.0);
    const double turn = turn_of({angle.cos, angle.sin, 0.3});
    CHECK(turn > last);
    CHECK(turn < whole_turn);
    last = turn;
  }
  CHECK(turn_of({2, 2, 0}) == 1.0);
  CHECK(turn_of({0, 1, 0}) == 2.0);
  CHECK(turn_of({-1, 1, 0}) == 3.0);
  CHECK(turn_of({-3, 0, 0}) == 4.0);
  CHECK(turn_of({-1, -1, 0}) == 5.0);
  CHECK(turn_of({0, -1, 0}) == 6.0);
  CHECK(turn_of({1, -1, 0}) == 7.0);
  CHECK(rise_of({0, 3, 4}) == doctest::Approx(0.8));
}

TEST_CASE("the paper's example has the paper's lengths") {
  const FiveDSpace space = space_of(3, 7);
  FiveDTree tree;
  tree.nodes = {{0, 32, 2}, {FiveDNode::leaf, 0, 0}, {FiveDNode::leaf, 0, 1}};
  tree.sets = {0b0011000, 0b0101000};
  // Three bits say what the nodes are, 3 + q the plane; the third coding says which child is lighter.
  const std::uint64_t nodes = 3 + 3 + 6;
  CHECK(encode(tree, space, FiveDCoding::plain).size == nodes + 14);
  CHECK(encode(tree, space, FiveDCoding::parent).size == nodes + 13);
  CHECK(encode(tree, space, FiveDCoding::sibling).size == nodes + 12 + 1);
}

TEST_CASE("every coding gives the tree back, and refuses what is cut short or too long") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const FiveDSpace space = space_of(seed % 2 == 0 ? 2 : 3, static_cast<std::uint32_t>(1 + seed * 5 % 150));
    const RandomTree random(space, seed, 7, seed % 3 == 0 ? 0.5 : 0.1);
    for (const FiveDCoding coding : five_d_codings) {
      CAPTURE(seed);
      BitString bits = encode(random.tree, space, coding);
      CHECK(same(decode(bits, space, coding, "test"), random.tree));
      const std::uint64_t whole = bits.size;
      for (bits.size = 0; bits.size < whole; bits.size += 1 + whole / 40) {
        CHECK_THROWS_AS(decode(bits, space, coding, "test"), Error);
      }
      bits.size = whole + 1;
      bits.bytes.push_back(std::byte{0});
      CHECK_THROWS_AS(decode(bits, space, coding, "test"), Error);
    }
  }
}

TEST_CASE("bits that are no tree are refused, or make another tree, and nothing worse") {
  const FiveDSpace space = space_of(3, 40);
  const RandomTree random(space, 3, 5, 0.3);
  int refused = 0, trees = 0;
  for (const FiveDCoding coding : five_d_codings) {
    const BitString whole = encode(random.tree, space, coding);
    for (std::uint64_t bit = 0; bit < whole.size; ++bit) {
      BitString altered = whole;
      altered.bytes[static_cast<std::size_t>(bit / 8)] ^= static_cast<std::byte>(1u << (bit % 8));
      try {
        const FiveDTree tree = decode(altered, space, coding, "test");
        for (const FiveDNode& node : tree.nodes) {
          REQUIRE(node.second < (node.axis == FiveDNode::leaf ? tree.leaves(space) : tree.nodes.size()));
        }
        ++trees;
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  CHECK(refused > 0);
  CHECK(trees > 0);
}

TEST_CASE("a query holds the leaf of every line of sight in the view volume") {
  int lines = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const int dimension = seed % 2 == 0 ? 2 : 3;
    const FiveDSpace space = space_of(dimension, 70);
    const RandomTree made(space, seed, 9, 0.05);
    Random random(seed + 1000);
    View view;
    view.pose.position = {random.uniform(-10, 10), random.uniform(-20, 20), 0.0};
    if (dimension == 2) {
      view.pose.orientation = turn_about_z(seed % 10 == 0 ? 0.0 : random.uniform(-4, 4));
      view.fov = seed % 7 == 0 ? random.uniform(3.2, 6.2) : random.uniform(0.01, 3.1);
    } else {
      view.pose.position.z = random.uniform(-5, 5);
      view.pose.orientation = random_turn(random);
      if (seed % 3 != 0) view.frustum = Frustum{random.uniform(0.05, 2.5), random.uniform(0.3, 3.0)};
    }
    const ViewVolume volume(view, dimension);
    const ViewRange range(view, volume, dimension, 0.0);
    std::vector<std::uint64_t> members(space.words());
    std::vector<std::uint32_t> stack;
    std::uint64_t nodes = 0;
    find_members(made.tree, space, range, members, stack, nodes);
    CHECK(nodes <= 2 * made.tree.nodes.size());
    for (int i = 0; i < 400; ++i) {
      Vec3 d(random.uniform(-1, 1), random.uniform(-1, 1), dimension == 3 ? random.uniform(-1, 1) : 0.0);
      if (!volume.may_touch_ball(view.pose.position + d, 0.0)) continue;
      ++lines;
      const auto leaf = leaf_at(made.tree, space, view.pose.position, d);
      for (std::size_t w = 0; w < leaf.size(); ++w) {
        CAPTURE(seed);
        REQUIRE((leaf[w] & ~members[w]) == 0);
      }
    }
  }
  CHECK(lines > 20000);
}

TEST_CASE("a query in one direction looks at a part of the tree, a box about the viewpoint at more") {
  const FiveDSpace space = space_of(3, 70);
  const RandomTree made(space, 5, 12, 0.05);
  View view;
  view.frustum = Frustum{0.5, 1.0};
  std::vector<std::uint64_t> members(space.words());
  std::vector<std::uint32_t> stack;
  const auto visited = [&](double around) {
    std::uint64_t nodes = 0;
    find_members(made.tree, space, ViewRange(view, ViewVolume(view, 3), 3, around), members, stack, nodes);
    return nodes;
  };
  const std::uint64_t narrow = visited(0.0), wide = visited(5.0);
  view.frustum.reset();
  CHECK(narrow < wide);
  CHECK(narrow < visited(0.0));
  CHECK(visited(0.0) < made.tree.nodes.size());
}

TEST_CASE("leaves with equal sets become one") {
  const FiveDSpace space = space_of(3, 7);
  FiveDTree tree;
  tree.nodes = {{0, 32, 2}, {FiveDNode::leaf, 0, 0}, {FiveDNode::leaf, 0, 1}};
  tree.sets = {0b11, 0b01};
  FiveDTree other = tree;
  merge_equal_leaves(other, 0, space);
  CHECK(same(other, tree));
  tree.sets = {0b11, 0b11};
  merge_equal_leaves(tree, 0, space);
  REQUIRE(tree.nodes.size() == 1);
  CHECK(tree.nodes[0].axis == FiveDNode::leaf);
  CHECK(tree.sets == std::vector<std::uint64_t>{0b11});
}

}  // namespace gridcull::test
