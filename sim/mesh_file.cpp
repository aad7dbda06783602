#include "gridcull/sim/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <set>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/sim/cut_polygon.h"

#if GRIDCULL_HAS_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#endif

namespace gridcull {
namespace {

/// What a triangle comes to in the end, with its vertices, its edge lists and its piece in the engine: about 600 bytes
/// (measured on a town of 49,000 triangles), more while the file is read.
constexpr std::uint64_t bytes_a_triangle = 1000;

bool before(const Vec3& a, const Vec3& b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

/// Makes vertices at one place one, leaves out those that no triangle names and triangles that name one twice.
void weld(Faces& faces) {
  std::vector<std::uint32_t> order(faces.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 &p = faces.vertices[a], &q = faces.vertices[b];
    return before(p, q) || (!before(q, p) && a < b);
  });
  std::vector<std::uint32_t> first(order.size());  // the first vertex at the same place
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && !before(faces.vertices[order[i - 1]], faces.vertices[order[i]]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  constexpr std::uint32_t unnamed = 0xFFFF'FFFFu;
  std::vector<std::uint32_t> number(order.size(), unnamed);
  Faces out;
  for (Triangle t : faces.triangles) {
    for (std::uint32_t& corner : t) corner = first[corner];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::uint32_t& corner : t) {
      std::uint32_t& name = number[corner];
      if (name == unnamed) {
        name = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(faces.vertices[corner]);
      }
      corner = name;
    }
    out.triangles.push_back(t);
  }
  faces = std::move(out);
}

void finish(MeshGroup& group) {
  weld(group.faces);
  group.holes = find_holes(group.faces);
  group.faces.closed = !group.faces.triangles.empty() && group.holes.open_edges == 0;
}

std::string megabytes(std::uint64_t bytes) { return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB"; }

[[noreturn]] void refuse_size(const std::string& path, const std::string& found, std::uint64_t bytes,
                              std::uint64_t max_memory) {
  throw Error(ErrorCode::limit, path + ": " + found + " would take about " + megabytes(bytes) + ", more than the " +
                                    megabytes(max_memory) + " of --max-memory");
}

/// assimp 5.2 never ends on a PLY whose header has no end.
void check_ply(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  if (!std::getline(in, line) || line.substr(0, 3) != "ply") return;
  for (int lines = 0; lines < 10000 && std::getline(in, line); ++lines) {
    if (line.starts_with("end_header")) return;
  }
  throw Error(ErrorCode::bad_scene, path + ": cannot be read as a mesh: expected a PLY header that ends in end_header");
}

void check_file(const std::string& path, std::uint64_t max_memory) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault) || !std::ifstream(path)) {
    throw Error(ErrorCode::io, path + ": cannot be read as a mesh: expected a file");
  }
  const std::uint64_t size = std::filesystem::file_size(path, fault);
  // Text and bytes alike grow when they are unpacked into triangles.
  if (!fault && 4 * size > max_memory) refuse_size(path, std::to_string(size) + " bytes", 4 * size, max_memory);
  check_ply(path);
}

#if GRIDCULL_HAS_ASSIMP

class Reader {
 public:
  Reader(const std::string& path, std::uint64_t max_memory) : path_(path), max_memory_(max_memory) {}

  std::vector<MeshGroup> read() {
    const aiScene* scene = open();
    check_size(*scene);
    add(*scene, *scene->mRootNode, aiMatrix4x4());
    if (groups_.empty()) throw Error(ErrorCode::bad_scene, path_ + ": expected at least one triangle, found none");
    return std::move(groups_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorCode::bad_scene, path_ + ": cannot be read as a mesh: " + one_line(why));
  }

  /// As it stands in the file: Debian's assimp is built with assertions, and its own steps end the program over files
  /// that break its promises.
  const aiScene* open() {
    const aiScene* scene = nullptr;
    try {
      scene = importer_.ReadFile(path_, 0);
    } catch (const std::exception& fault) {
      refuse(fault.what());
    }
    if (scene == nullptr || scene->mRootNode == nullptr) refuse(importer_.GetErrorString());
    return scene;
  }

  static std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "unknown format" : text.substr(0, 200);
  }

  void check_size(const aiScene& scene) const {
    std::uint64_t triangles = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) triangles += scene.mMeshes[i]->mNumFaces;
    const std::uint64_t bytes = triangles * bytes_a_triangle;
    if (bytes > max_memory_) refuse_size(path_, std::to_string(triangles) + " triangles", bytes, max_memory_);
  }

  void add(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above) {
    const aiMatrix4x4 place = above * node.mTransformation;
    MeshGroup group;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene.mMeshes[node.mMeshes[i]], place, group.faces);
    if (!group.faces.triangles.empty()) {
      finish(group);
      const std::string name = node.mName.C_Str();
      group.name = unused(!name.empty() || node.mNumMeshes != 1 ? name : scene.mMeshes[node.mMeshes[0]]->mName.C_Str());
      if (!group.faces.triangles.empty()) groups_.push_back(std::move(group));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], place);
  }

  void add(const aiMesh& mesh, const aiMatrix4x4& place, Faces& out) const {
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D at = place * mesh.mVertices[i];
      const Vec3 p(at.x, at.y, at.z);
      for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(p[axis]) <= 1e9) continue;
        throw Error(ErrorCode::bad_scene, path_ + ": vertex " + std::to_string(i) + " of '" + mesh.mName.C_Str() +
                                              "': expected coordinates of magnitude at most 1e9");
      }
      out.vertices.push_back(p + Vec3(0.0));  // -0 is 0
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) add(mesh.mFaces[i], mesh, first, out);
  }

  void add(const aiFace& face, const aiMesh& mesh, std::uint32_t first, Faces& out) const {
    std::vector<std::uint32_t> polygon;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) refuse("a face names a vertex that is not there");
      polygon.push_back(first + face.mIndices[k]);
    }
    cut_polygon(out.vertices, std::move(polygon), out.triangles);
  }

  std::string unused(const std::string& wanted) {
    std::string name = wanted.empty() ? "mesh" : wanted;
    for (int i = 2; !names_.insert(name).second; ++i)
      name = (wanted.empty() ? "mesh" : wanted) + "#" + std::to_string(i);
    return name;
  }

  const std::string& path_;
  std::uint64_t max_memory_;
  Assimp::Importer importer_{};
  std::vector<MeshGroup> groups_{};
  std::set<std::string> names_{};
};

#endif

/// The least number of the set that a vertex is in.
std::uint32_t root_of(std::vector<std::uint32_t>& above, std::uint32_t i) {
  while (above[i] != i) i = above[i] = above[above[i]];
  return i;
}

}  // namespace

bool reads_meshes() {
#if GRIDCULL_HAS_ASSIMP
  return true;
#else
  return false;
#endif
}

std::vector<MeshGroup> read_mesh(const std::string& path, std::uint64_t max_memory) {
  check_file(path, max_memory);
#if GRIDCULL_HAS_ASSIMP
  return Reader(path, max_memory).read();
#else
  throw Error(ErrorCode::bad_scene,
              path + ": this gridcull was built without assimp and reads no meshes (Debian: libassimp-dev)");
#endif
}

MeshGroup joined(const std::vector<MeshGroup>& groups) {
  MeshGroup out;
  for (const MeshGroup& group : groups) {
    const auto first = static_cast<std::uint32_t>(out.faces.vertices.size());
    out.faces.vertices.insert(out.faces.vertices.end(), group.faces.vertices.begin(), group.faces.vertices.end());
    for (const Triangle& t : group.faces.triangles) {
      out.faces.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  finish(out);
  return out;
}

std::vector<MeshGroup> connected_parts(const MeshGroup& group) {
  const Faces& faces = group.faces;
  std::vector<std::uint32_t> above(faces.vertices.size());
  std::iota(above.begin(), above.end(), 0u);
  for (const Triangle& t : faces.triangles) {
    for (const std::size_t k : {1u, 2u}) {
      const std::uint32_t a = root_of(above, t[0]), b = root_of(above, t[k]);
      above[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<MeshGroup> parts;
  std::map<std::uint32_t, std::size_t> part_of;
  for (const Triangle& t : faces.triangles) {
    const auto [place, is_new] = part_of.try_emplace(root_of(above, t[0]), parts.size());
    if (is_new) parts.emplace_back().name = group.name + "/" + std::to_string(parts.size());
    parts[place->second].faces.triangles.push_back(t);
  }
  std::vector<std::uint32_t> number(faces.vertices.size());
  for (MeshGroup& part : parts) {
    std::vector<std::uint32_t> used;
    for (const Triangle& t : part.faces.triangles) used.insert(used.end(), t.begin(), t.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::size_t i = 0; i < used.size(); ++i) {
      number[used[i]] = static_cast<std::uint32_t>(i);
      part.faces.vertices.push_back(faces.vertices[used[i]]);
    }
    for (Triangle& t : part.faces.triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
    finish(part);
  }
  return parts;
}

PlacedFaces placed(const Faces& faces) {
  Bounds box;
  for (const Vec3& p : faces.vertices) box.add(p);
  PlacedFaces out{faces, glm::floor(box.centre())};
  for (Vec3& p : out.faces.vertices) p -= out.position;
  return out;
}

}  // namespace gridcull
