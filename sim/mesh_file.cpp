#include "gridcull/sim/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "gridcull/sim/cut_polygon.h"

#if GRIDCULL_HAS_ASSIMP
#include <assimp/DefaultIOSystem.h>
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

/// A header's line in small letters, without blanks around it.
bool header_line(std::istream& in, std::string& out) {
  if (!std::getline(in, out) || out.size() > 4096) return false;
  const auto blank = [](unsigned char c) { return std::isspace(c) != 0; };
  out.erase(std::find_if_not(out.rbegin(), out.rend(), blank).base(), out.end());
  out.erase(out.begin(), std::find_if_not(out.begin(), out.end(), blank));
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return true;
}

/// assimp 5.2 never ends on a PLY whose header has no end, nor on one that announces more than there is.
void check_ply(const std::string& path, std::uint64_t size) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  bool is_ply = false;
  for (int lines = 0; lines < 10000 && header_line(in, line); ++lines) {
    if (line.empty()) continue;
    if (!is_ply && !line.starts_with("ply")) return;
    is_ply = true;
    if (line == "end_header") return;
    unsigned long long count = 0;
    if (std::sscanf(line.c_str(), "element %*s %llu", &count) == 1 && count > size) {
      throw Error(ErrorCode::bad_scene, path + ": cannot be read as a mesh: a PLY of " + std::to_string(size) +
                                            " bytes announces " + std::to_string(count) + " elements");
    }
  }
  if (!is_ply) return;
  throw Error(ErrorCode::bad_scene, path + ": cannot be read as a mesh: expected a PLY header that ends in end_header");
}

/// The JSON of a glTF, text or binary; nothing where it is neither.
nlohmann::json gltf_json(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 20> head{};
  in.read(head.data(), head.size());
  if (in && std::string_view(head.data(), 4) == "glTF") {
    std::uint32_t length = 0;  // of the first chunk
    std::memcpy(&length, head.data() + 12, 4);
    std::string text(std::min<std::uint64_t>(length, std::filesystem::file_size(path)), ' ');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    return nlohmann::json::parse(text, nullptr, false);
  }
  if (std::filesystem::path(path).extension() != ".gltf") return nlohmann::json::value_t::discarded;
  return nlohmann::json::parse(std::ifstream(path), nullptr, false);
}

/// assimp walks a glTF's nodes by calls within calls, and those with two parents once for each: nodes have to be a
/// forest, and a low one.
void check_gltf(const std::string& path) {
  constexpr std::size_t deepest = 500;
  const nlohmann::json json = gltf_json(path);
  if (!json.is_object() || !json.contains("nodes") || !json["nodes"].is_array()) return;
  const nlohmann::json& nodes = json["nodes"];
  std::vector<std::size_t> parent(nodes.size(), nodes.size());
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorCode::bad_scene, path + ": cannot be read as a mesh: " + why);
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].is_object() || !nodes[i].contains("children") || !nodes[i]["children"].is_array()) continue;
    for (const nlohmann::json& child : nodes[i]["children"]) {
      if (!child.is_number_unsigned() || child.get<std::uint64_t>() >= nodes.size()) continue;
      std::size_t& above = parent[child.get<std::size_t>()];
      if (above != nodes.size()) refuse("node " + child.dump() + " has more than one parent");
      above = i;
    }
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::size_t depth = 0;
    for (std::size_t at = i; at != nodes.size(); at = parent[at]) {
      if (++depth > deepest) refuse("its nodes are nested deeper than " + std::to_string(deepest));
    }
  }
}

void check_file(const std::string& path, std::uint64_t max_memory) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault) || !std::ifstream(path)) {
    throw Error(ErrorCode::io, path + ": cannot be read as a mesh: expected a file");
  }
  const std::uint64_t size = std::filesystem::file_size(path, fault);
  // Text and bytes alike grow when they are unpacked into triangles.
  if (!fault && 4 * size > max_memory) refuse_size(path, std::to_string(size) + " bytes", 4 * size, max_memory);
  check_ply(path, fault ? 0 : size);
  check_gltf(path);
}

#if GRIDCULL_HAS_ASSIMP

/// What a model names beside itself is opened only where it is a plain file (a pipe would be waited for), and materials
/// not at all.
class PlainFiles final : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* file) const override {
    std::error_code fault;
    const std::filesystem::path path(file);
    return path.extension() != ".mtl" && std::filesystem::is_regular_file(path, fault);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return Exists(file) ? Assimp::DefaultIOSystem::Open(file, mode) : nullptr;
  }
};

/// A name for people and files: bytes that are no plain characters of ASCII become '?', others stay.
std::string cleaned(const char* text) {
  std::string out(text);
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  }
  return out;
}

class Reader {
 public:
  Reader(const std::string& path, std::uint64_t max_memory) : path_(path), max_memory_(max_memory) {
    importer_.SetIOHandler(new PlainFiles);  // which it then owns
  }

  std::vector<MeshGroup> read() {
    const aiScene* scene = open();
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
    return text.empty() ? "unknown format" : cleaned(text.substr(0, 200).c_str());
  }

  /// Meshes count as often as nodes name them.
  void count(const aiMesh& mesh) {
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) triangles_ += std::max(2u, mesh.mFaces[i].mNumIndices) - 2;
    const std::uint64_t bytes = triangles_ * bytes_a_triangle;
    if (bytes > max_memory_) refuse_size(path_, std::to_string(triangles_) + " triangles", bytes, max_memory_);
  }

  void add(const aiScene& scene, const aiNode& node, const aiMatrix4x4& above) {
    const aiMatrix4x4 place = above * node.mTransformation;
    MeshGroup group;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene.mMeshes[node.mMeshes[i]], place, group.faces);
    if (!group.faces.triangles.empty()) {
      finish(group);
      const std::string name = cleaned(node.mName.C_Str());
      group.name =
          unused(!name.empty() || node.mNumMeshes != 1 ? name : cleaned(scene.mMeshes[node.mMeshes[0]]->mName.C_Str()));
      if (!group.faces.triangles.empty()) groups_.push_back(std::move(group));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], place);
  }

  void add(const aiMesh& mesh, const aiMatrix4x4& place, Faces& out) {
    count(mesh);
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
    const std::string base = wanted.empty() ? "mesh" : wanted;
    std::string name = base;
    for (std::size_t& next = numbers_[base]; !names_.insert(name).second;) {
      name = base + "#" + std::to_string(next = std::max<std::size_t>(next + 1, 2));
    }
    return name;
  }

  const std::string& path_;
  std::uint64_t max_memory_;
  Assimp::Importer importer_{};
  std::vector<MeshGroup> groups_{};
  std::set<std::string> names_{};
  std::map<std::string, std::size_t> numbers_{};  ///< last number given to a name
  std::uint64_t triangles_ = 0;                   ///< so far, of all nodes
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

bool is_mesh_file(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  constexpr std::string_view endings[] = {".obj", ".ply", ".stl", ".gltf", ".glb", ".3ds"};
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

}  // namespace gridcull
