// Triangle meshes from files (OBJ, PLY, STL, glTF, 3DS and what else assimp reads).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/mesh.h"

namespace gridcull {

/// A named piece of a mesh file, in the file's own axes and units, all transformations applied. Vertices at one place
/// are one; `faces.closed` says whether it closes, `holes` where it does not.
struct MeshGroup {
  std::string name{};
  Faces faces{};
  MeshHoles holes{};
};

/// What meshes may take at most unless told otherwise, bytes.
constexpr std::uint64_t default_mesh_memory = std::uint64_t{4} << 30;

/// Whether this gridcull was built with assimp.
bool reads_meshes();

/// The groups of a file (nodes that have triangles), in its order; names are the file's, made different where they are
/// not. Lines and points are passed over. Throws Error(io) when the file cannot be read, Error(bad_scene) for one that
/// is no mesh, has no triangle, or a vertex that is not finite or above 1e9, and where gridcull was built without
/// assimp; Error(limit) when it would take more than `max_memory`.
std::vector<MeshGroup> read_mesh(const std::string& path, std::uint64_t max_memory = default_mesh_memory);

/// All groups as one.
MeshGroup joined(const std::vector<MeshGroup>& groups);

/// The parts that hang together (triangles that share a vertex), in the order of their first triangles.
std::vector<MeshGroup> connected_parts(const MeshGroup& group);

/// The same as a shape about a position in whole metres in its middle: differences of coordinates that were floats in
/// the file are then exact, and so are the sums that give them back, so parts that touch stay so.
struct PlacedFaces {
  Faces faces{};
  Vec3 position{0.0};
};
PlacedFaces placed(const Faces& faces);

/// Whether the path ends as models do: .obj, .ply, .stl, .gltf, .glb, .3ds.
bool is_mesh_file(const std::string& path);

}  // namespace gridcull
