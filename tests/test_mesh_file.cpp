// Meshes from files: what is read, what is refused, and scenes that name them.
#include <algorithm>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "gridcull/core/view_volume.h"
#include "gridcull/sim/cut_polygon.h"
#include "gridcull/sim/mesh_file.h"
#include "gridcull/sim/scene.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

const auto needs_assimp = doctest::skip(!reads_meshes());

// A tetrahedron whose corners stand once for every triangle, and a lone triangle beside it that touches nothing.
const std::string two_groups = R"(o tent
v 0 0 0
v 4 0 0
v 0 4 0
v 0 0 4
f 1 3 2
f 1 2 4
f 1 4 3
f 2 3 4
o kite
v 9 0 0
v 9 1 0
v 9 0 1
f 5 6 7
)";

const std::string stl = R"(solid tent
facet normal 0 0 -1
 outer loop
 vertex 0 0 0
 vertex 0 4 0
 vertex 4 0 0
 endloop
endfacet
facet normal 0 -1 0
 outer loop
 vertex 0 0 0
 vertex 4 0 0
 vertex 0 0 4
 endloop
endfacet
facet normal -1 0 0
 outer loop
 vertex 0 0 0
 vertex 0 0 4
 vertex 0 4 0
 endloop
endfacet
facet normal 1 1 1
 outer loop
 vertex 4 0 0
 vertex 0 4 0
 vertex 0 0 4
 endloop
endfacet
endsolid tent
)";

const std::string ply = R"(ply
format ascii 1.0
element vertex 5
property float x
property float y
property float z
element face 5
property list uchar int vertex_indices
end_header
0 0 0
2 0 0
2 2 0
0 2 0
1 1 3
4 3 2 1 0
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
)";

/// One triangle in a node that is moved by (10, 0, 0), in a node that is twice as large.
const std::string gltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"name": "large", "scale": [2, 2, 2], "children": [1]},
            {"name": "moved", "translation": [10, 0, 0], "mesh": 0}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 4}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}],
  "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

std::string scene_with(const std::string& shape) {
  return R"({"format": "gridcull.scene/1", "dimension": 3, "objects": [{"id": 7, "static": true, "shape": )" + shape +
         R"(, "position": [1, 0, 0]}], "viewers": []})";
}

}  // namespace

TEST_CASE("groups of an OBJ are objects, closed or not" * needs_assimp) {
  const TemporaryFolder folder;
  const auto groups = read_mesh(folder.with("two.obj", two_groups));
  REQUIRE(groups.size() == 2);
  CHECK(groups[0].name == "tent");
  CHECK(groups[0].faces.vertices.size() == 4);
  CHECK(groups[0].faces.triangles.size() == 4);
  CHECK(groups[0].faces.closed);
  CHECK(groups[1].name == "kite");
  CHECK_FALSE(groups[1].faces.closed);
  CHECK(groups[1].holes.open_edges == 3);
  CHECK(groups[1].holes.at.x == 9.0);
}

TEST_CASE("an STL's corners are welded, a PLY's quadrilaterals cut" * needs_assimp) {
  const TemporaryFolder folder;
  const auto tent = read_mesh(folder.with("tent.stl", stl));
  REQUIRE(tent.size() == 1);
  CHECK(tent[0].faces.vertices.size() == 4);
  CHECK(tent[0].faces.closed);
  const auto pyramid = read_mesh(folder.with("pyramid.ply", ply));
  REQUIRE(pyramid.size() == 1);
  CHECK(pyramid[0].faces.triangles.size() == 6);
  CHECK(pyramid[0].faces.closed);
  CHECK(interior_holds(pyramid[0].faces, Pose{}, {1, 1, 1}));
}

TEST_CASE("a glTF's transformations are applied" * needs_assimp) {
  const TemporaryFolder folder;
  const auto groups = read_mesh(folder.with("moved.gltf", gltf));
  REQUIRE(groups.size() == 1);
  CHECK(groups[0].name == "moved");
  Bounds box;
  for (const Vec3& p : groups[0].faces.vertices) box.add(p);
  CHECK(box.min.x == 20.0);
  CHECK(box.max.x == 22.0);
  CHECK(box.max.y == 2.0);
}

TEST_CASE("parts that hang together, and the whole in one" * needs_assimp) {
  const TemporaryFolder folder;
  const auto groups = read_mesh(folder.with("two.obj", two_groups));
  const MeshGroup all = joined(groups);
  CHECK(all.faces.triangles.size() == 5);
  CHECK_FALSE(all.faces.closed);
  const auto parts = connected_parts(all);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].faces.closed);
  CHECK(parts[0].faces.vertices.size() == 4);
  CHECK_FALSE(parts[1].faces.closed);
  const PlacedFaces kite = placed(parts[1].faces);
  CHECK(kite.position == Vec3(9, 0, 0));
  CHECK(kite.faces.vertices[0] + kite.position == parts[1].faces.vertices[0]);
}

TEST_CASE("a scene names mesh files relative to itself, and is written as it was" * needs_assimp) {
  const TemporaryFolder folder;
  folder.with("two.obj", two_groups);
  const std::string path =
      folder.with("scene.json", scene_with(R"({"type": "mesh", "file": "two.obj", "group": "tent"})"));
  const Scene scene = read_scene(path);
  const auto& faces = std::get<Faces>(scene.objects[0].object.shape);
  CHECK(faces.closed);
  CHECK(interior_holds(faces, scene.objects[0].object.pose, {2, 1, 1}));
  const std::string text = scene_text(scene);
  CHECK(text.find(R"("shape": {"type": "mesh", "file": "two.obj", "group": "tent"})") != std::string::npos);

  // Without the file's name the triangles themselves are written, and read back.
  Scene loose = scene;
  loose.objects[0].mesh.reset();
  const Scene again = parse_scene(scene_text(loose), "again");
  CHECK(std::get<Faces>(again.objects[0].object.shape).closed);
  CHECK(std::get<Faces>(again.objects[0].object.shape).triangles == faces.triangles);
  const std::string whole = folder.with("whole.json", scene_with(R"({"type": "mesh", "file": "two.obj"})"));
  CHECK(std::get<Faces>(read_scene(whole).objects[0].object.shape).triangles.size() == 5);
}

TEST_CASE("bad meshes are refused in one line" * needs_assimp) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& name, const std::string& content, std::uint64_t most = default_mesh_memory) {
    const std::string path = folder.with(name, content);
    return [path, most] { read_mesh(path, most); };
  };
  CHECK(refusal(ErrorCode::io, [&] { read_mesh(folder.file("none.obj")); }) ==
        folder.file("none.obj") + ": cannot be read as a mesh: expected a file");
  CHECK(refusal(ErrorCode::io, [&] { read_mesh(folder.file("")); }) != "");
  CHECK(holds(refusal(ErrorCode::bad_scene, read("text.obj", "hello\n")), "text.obj: "));
  CHECK(holds(refusal(ErrorCode::bad_scene, read("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")), "lines.obj: "));
  CHECK(holds(refusal(ErrorCode::bad_scene, read("sliver.obj", "v 0 0 0\nv 1 0 0\nv 0 0 0\nf 1 2 3\n")),
              "expected at least one triangle, found none"));
  CHECK(holds(refusal(ErrorCode::bad_scene, read("unknown.xyzzy", "v 0 0 0\n")), "unknown.xyzzy: cannot be read"));
  CHECK(holds(refusal(ErrorCode::bad_scene, read("far.obj", "v 0 0 0\nv 1e12 0 0\nv 0 1 0\nf 1 2 3\n")),
              "expected coordinates of magnitude at most 1e9"));
  CHECK(holds(refusal(ErrorCode::bad_scene, read("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")), "nan.obj: "));
  const std::string header = "format ascii 1.0\nelement vertex 3\nproperty float x\n";
  for (const char* start : {"PLY\n", "\n ply\n"}) {
    CHECK(holds(refusal(ErrorCode::bad_scene, read("head.ply", start + header)), "expected a PLY header that ends"));
    CHECK(holds(refusal(ErrorCode::bad_scene, read("head.ply", start + header + "end_headerx\n")),
                "expected a PLY header"));
  }
  CHECK(holds(
      refusal(ErrorCode::bad_scene, read("many.ply", "ply\nformat ascii 1.0\nelement face 400000000\nend_header\n")),
      "announces 400000000 elements"));
  REQUIRE(mkfifo(folder.file("pipe.mtl").c_str(), 0600) == 0);
  CHECK_NOTHROW(read("pipe.obj", "mtllib pipe.mtl\n" + two_groups)());
  CHECK(refusal(ErrorCode::io, [&] { read_mesh(folder.file("pipe.mtl")); }) != "");
  std::string deep = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)";
  for (int i = 1; i < 20000; ++i) deep += "{\"children\": [" + std::to_string(i) + "]},";
  CHECK(holds(refusal(ErrorCode::bad_scene, read("deep.gltf", deep + "{}]}")), "nested deeper than 500"));
  CHECK(holds(refusal(ErrorCode::bad_scene,
                      read("twice.gltf", R"({"asset": {"version": "2.0"}, "nodes": [{"children": [1, 1]}, {}]})")),
              "node 1 has more than one parent"));
  CHECK(holds(refusal(ErrorCode::limit, read("big.obj", two_groups, 4096)), "5 triangles would take about 1 MiB"));
  CHECK(holds(refusal(ErrorCode::limit, read("huge.obj", two_groups, 64)), " bytes would take about"));
  for (const std::string& text : {two_groups, stl, ply, gltf}) {
    const std::string name = text == two_groups ? "cut.obj"
                             : text == stl      ? "cut.stl"
                             : text == ply      ? "cut.ply"
                                                : "cut.gltf";
    for (std::size_t length = 0; length < text.size(); length += 7) {
      INFO(name, " cut at ", length);
      const std::string line = refusal(ErrorCode::bad_scene, read(name, text.substr(0, length)));
      CHECK_FALSE(holds(line, "\n"));
      CHECK_FALSE(holds(line, "another code"));
    }
  }
}

TEST_CASE("a scene's bad meshes are refused by pointer" * needs_assimp) {
  const TemporaryFolder folder;
  folder.with("two.obj", two_groups);
  const auto line = [&](ErrorCode code, const std::string& shape) {
    const std::string path = folder.with("scene.json", scene_with(shape));
    return refusal(code, [&] { read_scene(path); });
  };
  CHECK(holds(line(ErrorCode::io, R"({"type": "mesh", "file": "none.obj"})"), "scene.json: /objects/0/shape/file: "));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "mesh", "file": "two.obj", "group": "roof"})"),
              "expected one of its groups ('tent', 'kite'), found 'roof'"));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "mesh"})"), "file"));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "mesh", "file": "two.obj", "scale": 2})"), "scale"));
  CHECK(holds(
      refusal(ErrorCode::bad_scene, [&] { parse_scene(scene_with(R"({"type": "mesh", "file": "two.obj"})"), "wire"); }),
      "wire: /objects/0/shape/type: \"mesh\" shapes stand in scene files only"));
  CHECK(
      holds(line(ErrorCode::bad_scene,
                 R"({"type": "faces", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]], "closed": true})"),
            "mesh: expected no hole, found 3 open edges"));
}

TEST_CASE("without assimp, mesh files are refused and say why" * doctest::skip(reads_meshes())) {
  const TemporaryFolder folder;
  const std::string path = folder.with("a.obj", "v 0 0 0\n");
  CHECK(holds(refusal(ErrorCode::bad_scene, [&] { read_mesh(path); }), "built without assimp"));
}

TEST_CASE("concave polygons are cut within their outlines, crossed ones keep their boundary") {
  const std::vector<Vec3> u{{0, 0, 5}, {9, 0, 5}, {9, 4, 5}, {6, 4, 5}, {6, 1, 5}, {3, 1, 5}, {3, 4, 5}, {0, 4, 5}};
  const auto area_of = [](const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
    double area = 0.0;
    for (const Triangle& t : triangles) {
      area += 0.5 * glm::length(glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
    }
    return area;
  };
  for (const bool backwards : {false, true}) {
    for (const int axis : {0, 1, 2}) {
      std::vector<Vec3> points;
      for (const Vec3& p : u) points.emplace_back(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
      std::vector<std::uint32_t> polygon{0, 1, 2, 3, 4, 5, 6, 7};
      if (backwards) std::reverse(polygon.begin(), polygon.end());
      std::vector<Triangle> triangles;
      cut_polygon(points, polygon, triangles);
      CHECK(triangles.size() == 6);
      CHECK(area_of(points, triangles) == doctest::Approx(27.0));
    }
  }
  const std::vector<Vec3> bow{{0, 0, 0}, {4, 3, 0}, {4, 0, 0}, {0, 3, 0}};
  std::vector<Triangle> triangles;
  cut_polygon(bow, {0, 1, 2, 3}, triangles);
  CHECK(triangles.size() == 2);
  CHECK(find_holes({bow, triangles}).open_edges == 4);
}
