#include "gridcull/sim/import_mesh.h"

#include <cmath>
#include <utility>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/sim/import_parts.h"
#include "gridcull/sim/scene_json.h"

namespace gridcull {
namespace {

std::vector<MeshGroup> pieces_of(const MeshImportOptions& options) {
  std::vector<MeshGroup> groups = read_mesh(options.file, options.max_memory);
  if (options.split == MeshImportOptions::Split::groups) return groups;
  MeshGroup whole = groups.size() == 1 ? std::move(groups.front()) : joined(groups);
  if (options.split == MeshImportOptions::Split::parts) return connected_parts(whole);
  std::vector<MeshGroup> out;
  out.push_back(std::move(whole));
  return out;
}

SceneObject object_of(const MeshGroup& group, const MeshImportOptions& options) {
  Faces scaled = group.faces;
  for (Vec3& p : scaled.vertices) p *= options.scale;
  PlacedFaces placed_faces = placed(scaled);
  SceneObject out;
  out.name = group.name;
  out.object.is_static = true;
  out.object.pose.orientation = options.pose.orientation;
  out.object.pose.position = to_world(options.pose, rotation_of(options.pose.orientation), placed_faces.position);
  out.object.shape = std::move(placed_faces.faces);
  return out;
}

std::string note_of(std::size_t open, std::size_t all, const MeshGroup& worst) {
  std::string text = std::to_string(open) + " of " + std::to_string(all) +
                     " have holes and hide as faces, without an interior; most: " + quoted(worst.name) + " with " +
                     std::to_string(worst.holes.open_edges) + " open edges, one at (";
  for (int axis = 0; axis < 3; ++axis) text += (axis > 0 ? ", " : "") + short_number(worst.holes.at[axis]);
  return text + ") in the file";
}

void check_place(const SceneObject& object, const std::string& file) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::usage, file + ": " + quoted(object.name) + ", scaled and moved: " + why);
  };
  try {
    validate(object.object.shape);
  } catch (const Error& fault) {
    refuse(fault.what());
  }
  const double most = 1e9 - reach_of(object.object.shape);
  const Vec3 p = glm::abs(object.object.pose.position);
  if (!(p.x <= most && p.y <= most && p.z <= most)) refuse("expected coordinates of magnitude at most 1e9");
}

/// Outward to whole metres.
Bounds whole_metres_3d(const Bounds& box) {
  return {glm::floor(box.min), glm::max(glm::ceil(box.max), glm::floor(box.min) + 1.0)};
}

}  // namespace

Imported import_mesh(const MeshImportOptions& options) {
  const std::vector<MeshGroup> pieces = pieces_of(options);
  Imported out;
  out.scene.dimension = 3;
  Bounds box;
  std::size_t open = 0;
  const MeshGroup* worst = nullptr;
  for (const MeshGroup& piece : pieces) {
    SceneObject object = object_of(piece, options);
    check_place(object, options.file);
    object.object.id = static_cast<ObjectId>(out.scene.objects.size());
    for (const Vec3& p : world_vertices(object.object.shape, object.object.pose)) box.add(p);
    out.scene.objects.push_back(std::move(object));
    if (piece.faces.closed) continue;
    ++open;
    if (worst == nullptr || piece.holes.open_edges > worst->holes.open_edges) worst = &piece;
  }
  out.scene.bounds = whole_metres_3d(box);
  if (worst != nullptr) out.notes.push_back(note_of(open, pieces.size(), *worst));
  return out;
}

}  // namespace gridcull
