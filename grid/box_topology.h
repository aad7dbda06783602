// How the corners, faces and edges of a box hang together: the same for all boxes, so it is kept once.
#pragma once

#include <array>
#include <cstdint>

namespace gridcull::box_topology {

/// Corners by bits: 1 = +x, 2 = +y, 4 = +z. Face 2 k looks along -k, face 2 k + 1 along +k; its corners
/// counter-clockwise from outside.
inline constexpr std::array<std::array<std::uint8_t, 4>, 6> faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// Runs counter-clockwise about `left` and clockwise about `right`, both seen from outside.
struct Edge {
  std::uint8_t from, to, left, right;
};

/// The face on whose border the way from a to b lies.
constexpr std::uint8_t face_along(std::uint8_t a, std::uint8_t b) {
  for (std::uint8_t f = 0; f < 6; ++f) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (faces[f][i] == a && faces[f][(i + 1) % 4] == b) return f;
    }
  }
  return 255;
}

constexpr std::array<Edge, 12> all_edges() {
  std::array<Edge, 12> edges{};
  std::size_t count = 0;
  for (std::uint8_t a = 0; a < 8; ++a) {
    for (std::uint8_t b = a + 1; b < 8; ++b) {
      if (face_along(a, b) != 255) edges[count++] = {a, b, face_along(a, b), face_along(b, a)};
    }
  }
  return edges;
}

inline constexpr std::array<Edge, 12> edges = all_edges();
static_assert(edges[11].from != 0 && edges[11].right != 255);

}  // namespace gridcull::box_topology
