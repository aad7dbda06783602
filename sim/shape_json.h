// Shapes as JSON (FORMATS, "Scene").
#pragma once

#include <optional>
#include <string>

#include "gridcull/core/shape.h"
#include "gridcull/sim/json_tree.h"
#include "gridcull/sim/mesh_shelf.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// A valid shape of this dimension. `meshes` gives the files that shapes of type "mesh" and "volume" name; without it
/// they are refused. Where a shape came from a file, `mesh` or `volume` says so.
Shape read_shape(const JsonRef& json, int dimension, MeshShelf* meshes = nullptr,
                 std::optional<MeshSource>* mesh = nullptr, std::optional<VolumeSource>* volume = nullptr);
/// Throws Error(bad_scene) for a Volume, whose field stands in a file.
void append_shape(std::string& out, const Shape& shape);
void append_mesh(std::string& out, const MeshSource& source);
void append_volume(std::string& out, const VolumeSource& source, const Volume& volume);

}  // namespace gridcull
