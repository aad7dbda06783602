// Parity along +x. In the plane of y and z a point is in a triangle when a ray along +y crosses an odd number of its
// edges. An edge is judged from its lower to its upper end in z, half open, so two triangles that share it get one
// answer, and in a mesh that closes every ray along +x meets an even number of triangles in all, corners and edges
// included. A triangle seen from its edge has three edges on one line, which a ray along +y crosses never or twice.
#include "gridcull/core/mesh.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "gridcull/core/predicates.h"

namespace gridcull {
namespace {

Vec2 flat(const Vec3& p) { return {p.y, p.z}; }

bool crosses_edge(const Vec3& a, const Vec3& b, const Vec3& point) {
  if ((a.z > point.z) == (b.z > point.z)) return false;
  const Vec3 &low = a.z < b.z ? a : b, &high = a.z < b.z ? b : a;
  return orientation(flat(low), flat(high), flat(point)) > 0;
}

}  // namespace

MeshHoles find_holes(const Faces& mesh) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::vector<Edge> edges;
  for (const Triangle& t : mesh.triangles) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(t[k], t[(k + 1) % 3]));
  }
  std::sort(edges.begin(), edges.end());
  MeshHoles out;
  for (auto at = edges.begin(); at != edges.end();) {
    const auto end = std::upper_bound(at, edges.end(), *at);
    if ((end - at) % 2 != 0 && out.open_edges++ == 0) {
      out.at = 0.5 * (mesh.vertices[at->first] + mesh.vertices[at->second]);
    }
    at = end;
  }
  return out;
}

MeshSide side_of_mesh(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const Vec3& point) {
  bool inside = false;
  for (const Triangle& t : triangles) {
    const Vec3 &a = vertices[t[0]], &b = vertices[t[1]], &c = vertices[t[2]];
    if (a.x < point.x && b.x < point.x && c.x < point.x) continue;
    const bool in = crosses_edge(a, b, point) != (crosses_edge(b, c, point) != crosses_edge(c, a, point));
    if (!in) continue;
    const int side = orientation(a, b, c, point), facing = orientation(flat(a), flat(b), flat(c));
    if (side == 0) return MeshSide::on_surface;
    // The normal's x has the sign of `facing`: the triangle is met beyond the point where the two differ.
    if (side != facing) inside = !inside;
  }
  return inside ? MeshSide::inside : MeshSide::outside;
}

}  // namespace gridcull
