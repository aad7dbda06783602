// Scenes: the start of a moving world, as files of the format `gridcull.scene/1`.
//
// Readers refuse what they do not know. A refusal is one line: file, JSON pointer, what was expected, what
// stood there, as in `town.json: /objects/3/shape/radius: expected a number above 0, found -1`.
#pragma once

#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull {

class MeshShelf;
class ScalarField;

/// The file that a shape came from, and the group in it; "" for all of it.
struct MeshSource {
  std::string file{};  ///< relative to the scene file
  std::string group{};
};

/// The file that a volume's field came from.
struct VolumeSource {
  std::string file{};  ///< relative to the scene file
  std::string grid{};  ///< "": the first one of floats
  double scale = 1.0;  ///< metres a unit of the file
};

/// Reads a grid of a volume file ("": the first one of floats) that may take so many bytes. Throws Error. The service
/// gives it; who has none reads no volumes.
using FieldReader = std::function<ScalarField(const std::string& path, const std::string& grid, std::uint64_t most)>;

/// An object as a scene or frames file gives it.
struct SceneObject {
  Object object{};
  std::string name{};                    ///< "" when the file gives none
  std::optional<double> heading{};       ///< radians, as given; object.pose.orientation is turn_about_z() of it
  std::optional<MeshSource> mesh{};      ///< where the shape, Faces, came from
  std::optional<VolumeSource> volume{};  ///< where the shape, a Volume, came from
};

/// A viewer as a scene gives it.
struct SceneViewer {
  ViewerId id = no_id;
  /// The object it rides on. Without it pose.position is its place in the world; with it pose.position is
  /// the offset in that object's frame (metres).
  std::optional<ObjectId> follows{};
  /// orientation is absolute and counts only when own_direction; else the viewer looks as the followed
  /// object does, or along +x.
  Pose pose{};
  bool own_direction = false;
  std::optional<double> heading{};                         ///< radians, as given
  double range = std::numeric_limits<double>::infinity();  ///< metres, > 0
  double fov = 2.0 * std::numbers::pi;                     ///< 2D: radians, full angle
  std::optional<Frustum> frustum{};                        ///< 3D: none means all directions
};

struct Scene {
  int dimension = 2;
  std::optional<Bounds> bounds{};  ///< none: to be derived from the content
  std::optional<double> cell{};    ///< metres; none: to be derived from the content
  std::vector<SceneObject> objects{};
  std::vector<SceneViewer> viewers{};
  std::string static_volume{};  ///< file of the static objects' cells, relative to the scene file; "": none
};

/// Reads a scene file ("-" is standard input, .gz is unpacked) and the meshes and volumes that it names
/// (sim/mesh_shelf.h), each of which may take `max_mesh_memory` bytes. Throws Error(io), Error(bad_message) for text
/// that is not JSON, Error(limit) for meshes and volumes that are too big and Error(bad_scene) for everything else.
Scene read_scene(const std::string& path, std::uint64_t max_mesh_memory = std::uint64_t{4} << 30,
                 const FieldReader& read_field = {});

/// The same from text; `source_name` stands at the front of refusals. Without a shelf files of meshes, volumes and
/// static cells are refused.
Scene parse_scene(std::string_view text, const std::string& source_name, MeshShelf* meshes = nullptr);

/// Writes a scene so that reading it gives the same bits. "-" is standard output; .gz packs; the file
/// appears whole or not at all. Throws Error(io).
void write_scene(const std::string& path, const Scene& scene);

/// The text that write_scene() writes.
std::string scene_text(const Scene& scene);

}  // namespace gridcull
