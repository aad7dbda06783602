// Objects, moves and viewers as JSON: what scenes and frames share.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/json_tree.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// `meshes`: as for read_shape().
Scene read_scene(const JsonRef& json, MeshShelf* meshes = nullptr);
/// A frame's parts and time; other keys are the caller's to refuse. `where` is left empty.
Frame read_frame(const JsonRef& json, int dimension);

/// normalised() until it stays as it is, so that what is written reads back with the same bits. Throws
/// Error(bad_scene).
Quat settled(Quat q);

SceneObject read_object(const JsonRef& json, int dimension, MeshShelf* meshes = nullptr);
ObjectMove read_move(const JsonRef& json, int dimension);
ViewerUpdate read_viewer(const JsonRef& json, int dimension);

void append_object(std::string& out, const SceneObject& object, int dimension);
void append_move(std::string& out, const ObjectMove& move, int dimension);
void append_viewer(std::string& out, const ViewerUpdate& viewer, int dimension);

/// The place at which an id stands the second time: of the least such id.
std::optional<std::size_t> first_repeated(std::span<const std::uint32_t> ids);
/// Refuses an id that stands twice in `list`; ids[i] is that of list[i].
void refuse_repeated(const std::vector<JsonRef>& list, const std::vector<std::uint32_t>& ids);

/// What in `update` a viewer cannot take; "" when nothing. `viewer` is nullptr where it is new.
std::string fault_of(const SceneViewer* viewer, const ViewerUpdate& update);
/// The viewer after the update; a new one begins as SceneViewer{}.
void update_viewer(SceneViewer& viewer, const ViewerUpdate& update);
/// The update that makes this viewer.
ViewerUpdate update_of(const SceneViewer& viewer);

/// Radians of a full angle in degrees, and the degrees that read back as the same radians (the shortest of
/// them, where there are several; the nearest, where there is none).
double radians_of(double degrees);
double degrees_of(double radians);

}  // namespace gridcull
