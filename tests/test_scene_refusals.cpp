// Bad scenes: each gives one line with file and pointer, and nothing is taken.
#include <doctest/doctest.h>

#include "gridcull/sim/random.h"
#include "gridcull/sim/scene.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

const std::string flat = R"({"format": "gridcull.scene/1", "dimension": 2,
  "bounds": {"min": [0, 0], "max": [20, 20]}, "grid": {"cell": 2.0},
  "objects": [
    {"id": 0, "shape": {"type": "polygon", "vertices": [[0,0],[10,0],[10,8]]}, "position": [1, 4]},
    {"id": 9, "shape": {"type": "box", "size": [5.0, 1.8]}, "position": [2, 7], "heading": 1.5, "max_speed": 60.0},
    {"id": 12, "shape": {"type": "disc", "radius": 0.25}, "position": [30, 7]},
    {"id": 13, "shape": {"type": "polyline", "vertices": [[0,0],[1,1]]}, "position": [3, 3]}],
  "viewers": [{"id": 1, "follows": 9, "range": 150.0}, {"id": 2, "position": [5, 5], "fov_degrees": 90}]})";

const std::string solid = R"({"format": "gridcull.scene/1", "dimension": 3,
  "objects": [
    {"id": 0, "shape": {"type": "sphere", "radius": 1}, "position": [1, 4, 2], "orientation": [1, 0, 0, 0]},
    {"id": 1, "shape": {"type": "box", "size": [1, 2, 3]}, "position": [1, 4, 2]},
    {"id": 2, "shape": {"type": "prism", "vertices": [[0,0],[1,0],[0,1]], "height": 4}, "position": [1, 4, 2]},
    {"id": 3, "shape": {"type": "convex", "vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]}, "position": [1, 4, 2]},
    {"id": 4, "shape": {"type": "faces", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,2]]}, "position": [1, 4, 2]}],
  "viewers": [{"id": 1, "position": [1, 1, 1], "frustum": {"fov_y_degrees": 60, "aspect": 1.5, "near": 1, "far": 9}}]})";

struct Bad {
  const char* from;
  const char* to;
  const char* said;  // what the line must hold, behind the file name
  ErrorCode code = ErrorCode::bad_scene;
};

void check_all(const std::string& good, const std::vector<Bad>& list) {
  REQUIRE_NOTHROW(parse_scene(good, "town.json"));
  for (const Bad& bad : list) {
    const std::string text = with(good, bad.from, bad.to);
    const std::string line = refusal(bad.code, [&] { parse_scene(text, "town.json"); });
    CAPTURE(std::string(bad.to));
    CAPTURE(line);
    CHECK(line.starts_with(std::string("town.json: ") + bad.said));
    CHECK_FALSE(holds(line, "\n"));
  }
}

}  // namespace

TEST_CASE("bad 2D scenes are refused by pointer") {
  const ErrorCode not_json = ErrorCode::bad_message;
  check_all(
      flat,
      {
          {"\"dimension\"", "dimension", "expected JSON: parse error at line 1", not_json},
          {"\"id\": 12", "\"id\": NaN", "expected JSON: ", not_json},
          {"\"id\": 2, \"pos", "\"id\": 2}, \"pos", "expected JSON: ", not_json},
          {"scene/1", "scene/2", "/format: expected \"gridcull.scene/1\", found \"gridcull.scene/2\""},
          {"\"gridcull.scene/1\"", "1", "/format: expected \"gridcull.scene/1\", found 1"},
          {"\"format\"", "\"fmt\"", "missing key \"format\""},
          {"\"dimension\": 2", "\"dimension\": 4", "/dimension: expected 2 or 3, found 4"},
          {"\"dimension\": 2", "\"dimension\": 2.5", "/dimension: expected 2 or 3, found 2.5"},
          {"\"dimension\": 2,", "", "missing key \"dimension\""},
          {"\"objects\"", "\"things\"", "/things: unknown key"},
          {"\"grid\": {\"cell\": 2.0}", "\"grid\": {}", "/grid: missing key \"cell\""},
          {"\"cell\": 2.0", "\"cell\": 0", "/grid/cell: expected a number above 0 and at most 1e9, found 0"},
          {"\"cell\": 2.0", "\"cell\": -1", "/grid/cell: expected a number above 0"},
          {"\"cell\": 2.0", "\"cell\": 1e999", "/grid/cell: expected a finite number, found '1e999'"},
          {"\"max\": [20, 20]", "\"max\": [20, 0]", "/bounds/max: expected more than \"min\""},
          {"\"min\": [0, 0]", "\"min\": [0, 0, 0]", "/bounds/min: expected 2 coordinates [x, y], found an array of 3"},
          {"\"id\": 12", "\"id\": 9", "/objects/2: expected each id once, found 9 twice"},
          {"\"id\": 12", "\"id\": 4294967295", "/objects/2/id: expected an id, an integer from 0 to 4294967294"},
          {"\"id\": 12", "\"id\": -3", "/objects/2/id: expected an id"},
          {"\"id\": 12", "\"id\": 12.0", "/objects/2/id: expected an id, an integer from 0 to 4294967294, found 12.0"},
          {"\"id\": 12", "\"id\": \"12\"",
           "/objects/2/id: expected an id, an integer from 0 to 4294967294, found \"12\""},
          {"\"id\": 12, ", "", "/objects/2: missing key \"id\""},
          {"\"id\": 12", "\"id\": 12, \"id\": 14", "/objects/2/id: expected each key once, found \"id\" twice"},
          {"\"id\": 12", "\"id\": 12, \"a/b~c\": 14", "/objects/2/a~1b~0c: unknown key"},
          {"\"radius\": 0.25", "\"radius\": -1",
           "/objects/2/shape/radius: expected a number above 0 and at most 1e9, found -1"},
          {"\"radius\": 0.25", "\"radius\": 0", "/objects/2/shape/radius: expected a number above 0"},
          {"\"radius\": 0.25", "\"radius\": 1e300",
           "/objects/2/shape/radius: expected a number above 0 and at most 1e9, found 1e+300"},
          {"\"radius\": 0.25", "\"radius\": \"big\"",
           "/objects/2/shape/radius: expected a number above 0 and at most 1e9, found \"big\""},
          {"\"radius\": 0.25", "\"size\": 0.25", "/objects/2/shape/size: unknown key"},
          {", \"radius\": 0.25", "", "/objects/2/shape: missing key \"radius\""},
          {"\"disc\"", "\"sphere\"", "/objects/2/shape/type: expected a 2D shape"},
          {"\"disc\"", "\"blob\"", "/objects/2/shape/type: expected a 2D shape"},
          {"[5.0, 1.8]", "[5.0, 0]", "/objects/1/shape/size/1: expected a number above 0"},
          {"[5.0, 1.8]", "[5.0]", "/objects/1/shape/size: expected 2 coordinates [x, y], found an array of 1"},
          {"[[0,0],[10,0],[10,8]]", "[[0,0],[10,0]]",
           "/objects/0/shape: polygon: expected at least three distinct points"},
          {"[[0,0],[10,0],[10,8]]", "[[0,0],[10,0],[0,0],[10,0]]",
           "/objects/0/shape: polygon: expected at least three"},
          {"[[0,0],[10,0],[10,8]]", "[[0,0],[10,0],[10,8,1]]", "/objects/0/shape/vertices/2: expected 2 coordinates"},
          {"[[0,0],[1,1]]", "[[0,0]]", "/objects/3/shape: polyline: expected at least two points"},
          {"[30, 7]", "[30, 7, 1]", "/objects/2/position: expected 2 coordinates [x, y], found an array of 3"},
          {"[30, 7]", "[30, 2e9]", "/objects/2/position/1: expected a number of magnitude at most 1e9, found 2e+09"},
          {"[30, 7]", "[30, null]", "/objects/2/position/1: expected a number of magnitude at most 1e9, found null"},
          {"[30, 7]", "{}", "/objects/2/position: expected 2 coordinates [x, y], found an object"},
          {"\"max_speed\": 60.0", "\"max_speed\": -60.0", "/objects/1/max_speed: expected a number from 0 to 1e9"},
          {"\"max_speed\": 60.0", "\"static\": 1", "/objects/1/static: expected true or false, found 1"},
          {"\"heading\": 1.5", "\"orientation\": [1,0,0,0]", "/objects/1/orientation: a 2D scene has \"heading\""},
          {"\"heading\": 1.5", "\"heading\": -1e400", "/objects/1/heading: expected a finite number, found '-1e400'"},
          {"\"follows\": 9", "\"follows\": 8",
           "/viewers/0/follows: expected the id of an object of the scene, found 8"},
          {"\"follows\": 9", "\"follows\": 9, \"position\": [1, 1]",
           "/viewers/0: expected either \"position\" or \"follows\""},
          {"\"follows\": 9, ", "", "/viewers/0: a new viewer needs \"position\" or \"follows\""},
          {"\"position\": [5, 5]", "\"position\": [5, 5], \"offset\": [1, 1]",
           "/viewers/1: \"offset\" needs an object"},
          {"\"id\": 2", "\"id\": 1", "/viewers/1: expected each id once, found 1 twice"},
          {"\"range\": 150.0", "\"range\": 0", "/viewers/0/range: expected a number above 0"},
          {"\"fov_degrees\": 90", "\"fov_degrees\": 361",
           "/viewers/1/fov_degrees: expected degrees above 0 and at most 360"},
          {"\"fov_degrees\": 90", "\"fov_degrees\": 0", "/viewers/1/fov_degrees: expected degrees above 0"},
          {"\"fov_degrees\": 90", "\"frustum\": {}", "/viewers/1/frustum: unknown key"},
      });
}

TEST_CASE("bad 3D scenes are refused by pointer") {
  check_all(
      solid,
      {
          {"[1, 0, 0, 0]", "[0, 0, 0, 0]",
           "/objects/0/orientation: expected a unit quaternion [w, x, y, z], found one of length 0"},
          {"[1, 0, 0, 0]", "[1, 0, 0]",
           "/objects/0/orientation: expected a unit quaternion [w, x, y, z], found an array of 3"},
          {"\"orientation\"", "\"heading\": 1, \"orientation\"",
           "/objects/0/orientation: expected either \"heading\" or \"orientation\""},
          {"\"sphere\"", "\"disc\"", "/objects/0/shape/type: expected a 3D shape"},
          {"\"type\": \"sphere\", \"radius\": 1", "\"type\": \"mesh\", \"file\": \"a.obj\"",
           "/objects/0/shape/type: \"mesh\" shapes stand in scene files only"},
          {"[1, 2, 3]", "[1, 2, -3]", "/objects/1/shape/size/2: expected a number above 0"},
          {"\"height\": 4", "\"height\": 0", "/objects/2/shape/height: expected a number above 0"},
          {"[[0,0],[1,0],[0,1]]", "[[0,0],[1,0]]", "/objects/2/shape: prism: expected at least three distinct points"},
          {",[0,0,1]]", ",[1,1,0]]", "/objects/3/shape: convex: expected at least four points, not all in one plane"},
          {"[[0,1,2]]", "[[0,1,3]]",
           "/objects/4/shape/triangles/0/2: expected the number of one of the 3 vertices, found 3"},
          {"[[0,1,2]]", "[[0,1,-1]]",
           "/objects/4/shape/triangles/0/2: expected the number of one of the 3 vertices, found -1"},
          {"[[0,1,2]]", "[[0,1,2.0]]",
           "/objects/4/shape/triangles/0/2: expected the number of one of the 3 vertices, found 2.0"},
          {"[[0,1,2]]", "[[0,1]]", "/objects/4/shape/triangles/0: expected 3 vertex numbers, found an array of 2"},
          {"[[0,1,2]]", "[]", "/objects/4/shape: faces: expected at least one triangle"},
          {"[1, 4, 2]", "[1, 4]", "/objects/0/position: expected 3 coordinates [x, y, z], found an array of 2"},
          {"\"fov_y_degrees\": 60", "\"fov_y_degrees\": 180",
           "/viewers/0/frustum/fov_y_degrees: expected degrees above 0 and below 180"},
          {"\"aspect\": 1.5, ", "", "/viewers/0/frustum: missing key \"aspect\""},
          {"\"aspect\": 1.5", "\"aspect\": 9e-7",
           "/viewers/0/frustum/aspect: expected an aspect of 1e-6 to 1e6, found 9e-07"},
          {"\"aspect\": 1.5", "\"aspect\": 1000001", "/viewers/0/frustum/aspect: expected an aspect of 1e-6 to 1e6"},
          {"\"far\": 9", "\"far\": 1", "/viewers/0/frustum/far: expected a number above \"near\""},
          {"\"near\": 1", "\"near\": -1", "/viewers/0/frustum/near: expected a number from 0"},
          {"\"frustum\"", "\"fov_degrees\": 90, \"frustum\"", "/viewers/0/fov_degrees: unknown key"},
      });
}

TEST_CASE("text that is no scene at all") {
  const auto said = [](const std::string& text, ErrorCode code) {
    return refusal(code, [&] { parse_scene(text, "x"); });
  };
  CHECK(said("", ErrorCode::bad_message).starts_with("x: expected JSON: "));
  CHECK(said("hello", ErrorCode::bad_message).starts_with("x: expected JSON: parse error at column 1: "));
  CHECK(said("{\n?", ErrorCode::bad_message).starts_with("x: expected JSON: parse error at line 2, column 1: "));
  CHECK(said("\x1f\x8b\x08", ErrorCode::bad_message) ==
        "x: expected JSON, found gzip data; only files named .gz are unpacked");
  CHECK(said(flat + "}", ErrorCode::bad_message).starts_with("x: expected JSON: "));
  CHECK(said(flat.substr(0, 300), ErrorCode::bad_message).starts_with("x: expected JSON: "));
  CHECK(said("[]", ErrorCode::bad_scene) == "x: expected an object, found an array of 0");
  CHECK(said("3", ErrorCode::bad_scene) == "x: expected an object, found 3");
  CHECK(said(std::string(1'000'000, '['), ErrorCode::bad_message) ==
        "x: expected JSON nested at most 32 deep, found more");
  CHECK(said("1e999", ErrorCode::bad_scene) == "x: /: expected a finite number, found '1e999'");
}

TEST_CASE("whatever the bytes, a scene is read or refused with one line") {
  // Random edits of good scenes; what is read must read back as itself.
  const std::string alphabet = "{}[]\",:0123456789.-+eE \n\\tfn/\xff";
  std::size_t taken = 0;
  for (std::uint64_t seed = 1; seed <= 6000; ++seed) {
    Random random(seed);
    std::string text = seed % 2 == 0 ? flat : solid;
    for (std::uint32_t edits = 1 + random.below(3); edits > 0; --edits) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
      const std::size_t from = random.below(static_cast<std::uint32_t>(text.size()));
      switch (random.below(4)) {
        case 0: text[at] = alphabet[random.below(static_cast<std::uint32_t>(alphabet.size()))]; break;
        case 1: text.erase(at, random.below(6)); break;
        case 2: text.insert(at, std::string(text, from, random.below(20))); break;
        default: text.insert(at, 1, alphabet[random.below(static_cast<std::uint32_t>(alphabet.size()))]);
      }
    }
    CAPTURE(seed);
    try {
      const std::string written = scene_text(parse_scene(text, "x"));
      CHECK(scene_text(parse_scene(written, "y")) == written);
      ++taken;
    } catch (const Error& fault) {
      const std::string line = fault.what();
      CHECK(line.starts_with("x: "));
      CHECK_FALSE(holds(line, "\n"));
    }
  }
  CHECK(taken > 100);
  CHECK(taken < 5900);
}

TEST_CASE("a scene file that is not there, and one that cannot be written") {
  const TemporaryFolder folder;
  const std::string missing = folder.file("none.json");
  CHECK(refusal(ErrorCode::io, [&] { read_scene(missing); }) ==
        missing + ": cannot be opened: No such file or directory");
  const std::string nowhere = folder.file("no/scene.json");
  CHECK(holds(refusal(ErrorCode::io, [&] { write_scene(nowhere, Scene{}); }), "cannot be written: No such file"));
  CHECK(holds(refusal(ErrorCode::io, [&] { write_scene(folder.file(""), Scene{}); }),
              "cannot be written: it is a folder"));
  CHECK(folder.entries() == 0);
}
