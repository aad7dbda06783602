#include "gridcull/grid/silhouette_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridcull {
namespace {

struct BoxLoop {
  std::array<std::uint8_t, 6> vertex{};
  std::uint8_t count = 0;
};

/// Region number: sum of 3^k (1 + sign_k), sign_k = -1, 0, 1 as the viewpoint lies below, within or above along k.
constexpr BoxLoop box_loop(int region) {
  const std::array<int, 3> sign{region % 3 - 1, region / 3 % 3 - 1, region / 9 - 1};
  const auto seen = [&](std::size_t face) { return sign[face / 2] == (face % 2 == 0 ? -1 : 1); };
  std::array<int, 8> next{-1, -1, -1, -1, -1, -1, -1, -1};
  // Edges between a seen face and one that is not, with the seen face on the right of the way.
  for (const box_topology::Edge& edge : box_topology::edges) {
    if (seen(edge.left) == seen(edge.right)) continue;
    const std::uint8_t a = seen(edge.left) ? edge.to : edge.from, b = seen(edge.left) ? edge.from : edge.to;
    next[a] = b;
  }
  BoxLoop loop;
  int start = 0;
  while (start < 8 && next[static_cast<std::size_t>(start)] < 0) ++start;
  if (start == 8) return loop;
  int at = start;
  do {
    loop.vertex[loop.count++] = static_cast<std::uint8_t>(at);
    at = next[static_cast<std::size_t>(at)];
  } while (at != start);
  return loop;
}

constexpr std::array<BoxLoop, 27> all_box_loops() {
  std::array<BoxLoop, 27> loops{};
  for (int region = 0; region < 27; ++region) loops[static_cast<std::size_t>(region)] = box_loop(region);
  return loops;
}

constexpr std::array<BoxLoop, 27> box_loops = all_box_loops();
static_assert(box_loops[13].count == 0 && box_loops[4].count == 4 && box_loops[0].count == 6);

void find_box_loop(const ConvexPiece& piece, const Vec3& apex, VertexLoop& out) {
  const Vec3 p = apex - piece.centre;
  int region = 0, weight = 1;
  out.height = -std::numeric_limits<double>::infinity();
  out.doubt = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k, weight *= 3) {
    const double above = p[k] - piece.half[k], below = -p[k] - piece.half[k];
    region += weight * (1 + (above > 0.0) - (below > 0.0));
    out.doubt = std::min({out.doubt, std::fabs(above), std::fabs(below)});
    if (above > out.height) out.height = above, out.highest = 2 * k + 1;
    if (below > out.height) out.height = below, out.highest = 2 * k;
  }
  const BoxLoop& loop = box_loops[static_cast<std::size_t>(region)];
  out.count = loop.count;
  for (std::size_t i = 0; i < loop.vertex.size(); ++i) out.vertex[i] = loop.vertex[i];
}

}  // namespace

void find_loop(const ConvexPiece& piece, const Vec3& apex, VertexLoop& out) {
  out.count = 0;
  if (piece.kind == ConvexPiece::Kind::box) return find_box_loop(piece, apex, out);
  std::uint64_t seen = 0;
  out.height = 0.0;
  out.doubt = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < piece.faces.size(); ++f) {
    const ConvexPiece::Plane& plane = piece.faces[f].plane;
    const double height = glm::dot(plane.normal, apex) - plane.offset;
    out.doubt = std::min(out.doubt, std::fabs(height));
    if (!(height > 0.0)) continue;
    seen |= std::uint64_t{1} << f;
    if (height > out.height) out.height = height, out.highest = static_cast<int>(f);
  }
  if (seen == 0) return;
  std::array<std::uint8_t, ConvexPiece::max_vertices> next;
  int links = 0;
  std::uint8_t start = 0;
  for (const ConvexPiece::Edge& edge : piece.edges) {
    const bool left = (seen >> edge.left & 1) != 0, right = (seen >> edge.right & 1) != 0;
    if (left == right) continue;
    // With the seen face on the right of the way.
    const std::uint8_t a = left ? edge.to : edge.from, b = left ? edge.from : edge.to;
    next[a] = b;
    start = a;
    ++links;
  }
  if (links < 3) return;
  // One simple cycle through all links, or (rounding, or a vertex passed twice) none.
  std::uint8_t at = start;
  int count = 0;
  do {
    out.vertex[static_cast<std::size_t>(count++)] = at;
    at = next[at];
  } while (at != start && count < links);
  if (at == start && count == links) out.count = count;
}

}  // namespace gridcull
