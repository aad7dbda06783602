// The five-dimensional tree and its three bit codings (Gotsman, Sudarsky, Fayman 1999, section 6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gridcull/methods/five_d_space.h"

namespace gridcull {

/// Nodes in preorder: the first child of node i is node i + 1.
struct FiveDNode {
  static constexpr std::uint8_t leaf = 0xFF;
  std::uint8_t axis = leaf;  ///< that its plane divides
  std::uint32_t step = 0;    ///< of the plane (FiveDSpace::plane)
  std::uint32_t second = 0;  ///< inner: the second child, on the far side of the plane; leaf: number of its set
};

struct FiveDTree {
  std::vector<FiveDNode> nodes{};     ///< at least the root
  std::vector<std::uint64_t> sets{};  ///< of the leaves: space.words() words each, bit i is member i

  std::size_t leaves(const FiveDSpace& space) const { return space.words() == 0 ? 0 : sets.size() / space.words(); }
  std::span<const std::uint64_t> set(const FiveDSpace& space, std::uint32_t number) const {
    return std::span(sets).subspan(number * space.words(), space.words());
  }
};

/// How the leaves' sets v are written. Each node costs a bit (leaf or not), each inner one 3 + q bits for its plane.
enum class FiveDCoding : std::uint8_t {
  plain = 1,    ///< v of each leaf, n bits
  parent = 2,   ///< v of each node, relative to its parent's
  sibling = 3,  ///< v of each pair's lighter one relative to the parent's, of the heavier one relative to both
};
inline constexpr std::array five_d_codings{FiveDCoding::plain, FiveDCoding::parent, FiveDCoding::sibling};

/// A string of bits, the lowest of each byte first.
struct BitString {
  std::vector<std::byte> bytes{};
  std::uint64_t size = 0;  ///< bits
};

BitString encode(const FiveDTree& tree, const FiveDSpace& space, FiveDCoding coding);

/// Throws Error(bad_scene), with `name` in front, when the bits end too early, go on too long or make no tree.
FiveDTree decode(const BitString& bits, const FiveDSpace& space, FiveDCoding coding, std::string_view name);

}  // namespace gridcull
