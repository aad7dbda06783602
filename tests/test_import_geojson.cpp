// Building footprints as static objects.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/sim/import_geojson.h"

namespace gridcull::test {
namespace {

class TextFile {
 public:
  explicit TextFile(const std::string& text)
      : path(std::filesystem::temp_directory_path() / ("gridcull-geojson-" + std::to_string(::getpid()))) {
    std::ofstream(path) << text;
  }
  ~TextFile() { std::filesystem::remove(path); }
  std::string path;
};

std::string collection(const std::string& features) {
  return R"({"type": "FeatureCollection", "features": [)" + features + "]}";
}

std::string feature(const std::string& type, const std::string& coordinates, const std::string& properties = "{}") {
  return R"({"type": "Feature", "properties": )" + properties + R"(, "geometry": {"type": ")" + type +
         R"(", "coordinates": )" + coordinates + "}}";
}

Imported import(const std::string& text, GeojsonOptions options = {}) {
  const TextFile file(text);
  options.file = file.path;
  return import_geojson(options);
}

const std::string square = "[[[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]]";
const std::string yard =
    "[[[0, 0], [30, 0], [30, 30], [0, 30], [0, 0]], [[10, 10], [10, 20], [20, 20], [20, 10], [10, 10]]]";

TEST_CASE("outlines, heights and names") {
  GeojsonOptions options{.height = 7.0, .metres = true};
  const Imported out =
      import(collection(feature("Polygon", square, R"({"height": 12.5, "name": "church"})") + "," +
                        feature("Polygon", square, R"({"height": "20 m"})") + "," +
                        feature("Polygon", square, R"({"building:levels": "4"})") + "," +
                        feature("Polygon", square, R"({"height": "unknown"})") + "," +
                        feature("MultiPolygon", "[" + square + ", " + square + "]") + "," + feature("Point", "[1, 2]")),
             options);
  const double heights[] = {12.5, 20, 12, 7, 7, 7};
  REQUIRE(out.scene.objects.size() == 6);
  CHECK(out.scene.dimension == 3);
  for (std::size_t i = 0; i < 6; ++i) {
    const auto& prism = std::get<Prism>(out.scene.objects[i].object.shape);
    CHECK(prism.height == heights[i]);
    CHECK(prism.vertices.size() == 4);
    CHECK(out.scene.objects[i].object.is_static);
    CHECK(out.scene.objects[i].object.id == i);
  }
  CHECK(out.scene.objects[0].name == "church");
  CHECK(!out.scene.bounds);  // derived, so that cells begin at the ground
  REQUIRE(out.notes.size() == 2);
  CHECK(out.notes[0] == "1 features that are no polygons: skipped");
  CHECK(out.notes[1] == "3 buildings without a height: 7 m");
}

// Who stands in a yard is not inside the house, and does not see out of it.
TEST_CASE("a hole stays a hole") {
  const Imported out = import(collection(feature("Polygon", yard)), {.metres = true});
  CHECK(out.scene.dimension == 2);
  const Object& house = out.scene.objects.at(0).object;
  const auto holds = [&](double x, double y) { return interior_holds(house.shape, house.pose, {x, y, 0}); };
  CHECK(!holds(15, 15));
  CHECK(holds(5, 15));
  CHECK(holds(25, 25));
  CHECK(holds(5, 3));
  CHECK(!holds(31, 15));
  Object person;
  person.id = 9;
  person.shape = Disc{0.5};
  View inside;
  inside.viewer = 1;
  inside.pose.position = {15, 15, 0};
  for (const auto& [x, seen] : {std::pair{18.0, true}, std::pair{35.0, false}}) {
    person.pose.position = {x, 15, 0};
    const std::vector<Object> world{house, person};
    const std::vector<ObjectId> visible = exact_visible_2d(world, inside).visible;
    CHECK((std::find(visible.begin(), visible.end(), 9u) != visible.end()) == seen);
  }
}

// A degree of latitude at 52 degrees is 111,266 m, one of longitude 68,678 m (WGS 84).
TEST_CASE("polygons of nothing are left out") {
  for (const char* empty : {"[]", "[[]]", "[[[1, 2]]]"}) {
    CAPTURE(empty);
    const Imported out =
        import(collection(feature("Polygon", empty) + "," + feature("MultiPolygon", "[" + std::string(empty) + "]") +
                          "," + feature("Polygon", square, R"({"building:levels": 1e9})")),
               {.height = 7.0, .metres = true});
    REQUIRE(out.scene.objects.size() == 1);
    CHECK(std::get<Prism>(out.scene.objects[0].object.shape).height == 7.0);
  }
}

TEST_CASE("degrees become metres") {
  const Imported out =
      import(collection(feature("Polygon", "[[[10, 52], [10.001, 52], [10.001, 52.001], [10, 52.001], [10, 52]]]")),
             {.origin = Vec2{10, 52}});
  const Object& object = out.scene.objects.at(0).object;
  const auto outline = world_outline(object.shape, object.pose);
  REQUIRE(outline.size() == 4);
  CHECK(std::fabs(outline[2].x - 68.678) < 0.01);
  CHECK(std::fabs(outline[2].y - 111.266) < 0.01);
  CHECK(outline[0] == Vec2(0, 0));
}

TEST_CASE("bad files are refused by place") {
  for (const auto& [text, word] :
       {std::pair<std::string, std::string>{"[]", "expected"},
        {R"({"type": "Topology"})", "/type: expected \"FeatureCollection\" or \"Feature\""},
        {collection(R"({"type": "Feature"})"), "/features/0"},
        {collection(feature("Polygon", "[[[0]]]")), "/features/0/geometry/coordinates/0/0: expected a position"},
        {collection(feature("Polygon", "[[[500000, 5700000]]]")), "--metres"},
        {collection(feature("Polygon", "[[[\"a\", 1]]]")), "/features/0/geometry/coordinates/0/0/0"}}) {
    CAPTURE(text);
    try {
      (void)import(text);
      FAIL("it was taken");
    } catch (const Error& error) {
      CHECK(std::string(error.what()).find(word) != std::string::npos);
    }
  }
  const Imported thin = import(collection(feature("Polygon", "[[[0, 0], [1, 1], [0, 0]]]")), {.metres = true});
  CHECK(thin.scene.objects.empty());
  CHECK(thin.notes.size() == 1);
}

}  // namespace
}  // namespace gridcull::test
