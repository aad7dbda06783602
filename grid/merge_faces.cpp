// Claim. A ray that crosses a merged face crosses some owner's face there (convex_union.cpp: the union is exact on the
// rounded world points, which are the truth). Crossing a face of a solid, not along it, puts the ray in the solid's
// open interior just before or just behind; so a point behind the merged face is hidden by an owner, unless that owner
// is left out for the viewer. Prism walls: under the even-odd rule a wall has the interior on one side unless another
// wall runs along it, and such walls are left out.
//
// Faces whose rounded corners are not exactly in one plane, or not strictly convex, are left out: they still occlude
// with their objects' pieces. Pairs are found by sort and sweep over x; each union starts its search again, so that
// rows grow to rectangles.
#include "gridcull/grid/merge_faces.h"

#include <algorithm>
#include <limits>

#include "gridcull/core/bounds.h"
#include "gridcull/core/hull.h"
#include "gridcull/grid/convex_cut.h"
#include "gridcull/grid/convex_union.h"
#include "gridcull/grid/exact_side.h"
#include "gridcull/grid/outline_hull.h"

namespace gridcull {
namespace {

constexpr std::size_t most_corners = 32;

struct Face {
  FlatPolygon polygon;
  Bounds box;
  std::vector<ObjectId> owners;
};

/// Whether another wall runs along a part of this one.
bool shares_its_line(const Wall& wall, const std::vector<Wall>& walls) {
  const Vec2 along = wall.b - wall.a;
  const auto place = [&](const Vec2& p) { return glm::dot(p - wall.a, along); };
  return std::any_of(walls.begin(), walls.end(), [&](const Wall& w) {
    if (w.a == wall.a && w.b == wall.b) return false;
    if (side_of_line(wall.a, wall.b, w.a) != 0 || side_of_line(wall.a, wall.b, w.b) != 0) return false;
    // Rounded, so only what is clearly beside or merely joins at a corner is let through.
    if (w.b == wall.a && place(w.a) < 0.0) return false;
    if (w.a == wall.b && place(w.b) > place(wall.b)) return false;
    const double low = std::min(place(w.a), place(w.b)), high = std::max(place(w.a), place(w.b));
    return !(high < 0.0 || low > place(wall.b));
  });
}

void add_prism_faces(const Prism& prism, std::vector<FlatPolygon>& out) {
  const std::vector<Wall> walls = walls_of(prism.vertices);
  const double h = prism.height;
  for (const Wall& w : walls) {
    if (!shares_its_line(w, walls)) out.push_back({{w.a, 0.0}, {w.b, 0.0}, {w.b, h}, {w.a, h}});
  }
  const std::vector<Vec2> hull = hull_of_outline(prism.vertices);
  if (!lies_inside(hull, walls)) return;
  for (const double z : {0.0, h}) {
    FlatPolygon lid;
    for (const Vec2& p : hull) lid.emplace_back(p, z);
    out.push_back(std::move(lid));
  }
}

void add_box_faces(const Cuboid& box, std::vector<FlatPolygon>& out) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double side : {-1.0, 1.0}) {
      FlatPolygon quad;
      for (const auto& [s, t] : {std::array{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}) {
        Vec3 sign(0.0);
        const int u = static_cast<int>(k), v = (u + 1) % 3, w = (u + 2) % 3;
        sign[u] = side, sign[v] = s, sign[w] = t;
        quad.push_back(0.5 * box.size * sign);  // as world_vertices() has them
      }
      out.push_back(std::move(quad));
    }
  }
}

std::vector<FlatPolygon> local_faces(const Shape& shape) {
  std::vector<FlatPolygon> out;
  if (const auto* box = std::get_if<Cuboid>(&shape)) add_box_faces(*box, out);
  if (const auto* prism = std::get_if<Prism>(&shape)) add_prism_faces(*prism, out);
  if (const auto* convex = std::get_if<Convex>(&shape)) {
    out = join_triangles(convex->vertices, convex_hull(convex->vertices).triangles);
  }
  if (const auto* faces = std::get_if<Faces>(&shape)) out = join_triangles(faces->vertices, faces->triangles);
  return out;
}

std::vector<Face> world_faces(std::span<const PlacedSource> sources) {
  std::vector<Face> out;
  for (const PlacedSource& source : sources) {
    const Rotation rotation = rotation_of(source.pose.orientation);
    for (const FlatPolygon& local : local_faces(*source.shape)) {
      Face face;
      for (const Vec3& p : local) {
        face.polygon.push_back(to_world(source.pose, rotation, p));
        face.box.add(face.polygon.back());
      }
      face.owners = {source.owner};
      if (is_flat_and_convex(face.polygon)) out.push_back(std::move(face));
    }
  }
  return out;
}

bool touch(const Bounds& a, const Bounds& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
         b.min.z <= a.max.z;
}

/// Takes `other` into `face` if their union is convex.
bool merge(Face& face, const Face& other) {
  if (!touch(face.box, other.box)) return false;
  const auto both = convex_union(face.polygon, other.polygon);
  if (!both || both->size() > most_corners) return false;
  face.polygon = *both;
  for (const Vec3& p : *both) face.box.add(p);
  std::vector<ObjectId> owners;
  std::set_union(face.owners.begin(), face.owners.end(), other.owners.begin(), other.owners.end(),
                 std::back_inserter(owners));
  face.owners = std::move(owners);
  return true;
}

/// One sweep; true when something was merged.
bool sweep(std::vector<Face>& faces) {
  std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.box.min.x < b.box.min.x; });
  bool any = false;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size() && !faces[i].polygon.empty(); ++j) {
      if (faces[j].box.min.x > faces[i].box.max.x) break;
      if (faces[j].polygon.empty() || !merge(faces[i], faces[j])) continue;
      faces[j].polygon.clear();
      any = true;
      j = i;  // again from the next one on
    }
  }
  std::erase_if(faces, [](const Face& f) { return f.polygon.empty(); });
  return any;
}

double area_of(const FlatPolygon& polygon) {
  Vec3 sum(0.0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return glm::length(sum);
}

}  // namespace

std::uint64_t MergedFace::bytes() const {
  return sizeof(MergedFace) - sizeof(ConvexPiece) + piece.bytes() + owners.capacity() * sizeof(ObjectId);
}

std::vector<MergedFace> merge_static_faces(std::span<const PlacedSource> sources) {
  std::vector<Face> faces = world_faces(sources);
  while (sweep(faces)) {
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const Face& a, const Face& b) { return area_of(a.polygon) > area_of(b.polygon); });
  std::vector<MergedFace> out;
  for (const Face& face : faces) {
    if (face.owners.size() < 2) continue;
    MergedFace merged{flat_piece(face.polygon), face.owners};
    if (!merged.piece.empty()) out.push_back(std::move(merged));
  }
  return out;
}

}  // namespace gridcull
