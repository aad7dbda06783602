// Volumes in scene files, with a reader that needs no files; and the scene that an import makes.
#include <cmath>
#include <filesystem>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/core/volume.h"
#include "gridcull/sim/import_volume.h"
#include "gridcull/sim/scene.h"
#include "random_volumes.h"
#include "sim_helpers.h"

using namespace gridcull;
using test::TemporaryFolder;

namespace {

/// A level set of a ball of 4 voxels; remembers what it was asked for.
struct Reader {
  std::vector<std::string> asked{};

  FieldReader function() {
    return [this](const std::string& path, const std::string& grid, std::uint64_t) {
      asked.push_back(std::filesystem::path(path).filename().string() + "|" + grid);
      if (grid == "none") throw Error(ErrorCode::io, path + ": cannot be read as a volume: expected a file");
      return test::field_of({0.5, {{1, 0, 0}}}, 1.0f, LatticePoint(-6), LatticePoint(6),
                            [](const LatticePoint& p) { return static_cast<float>(glm::length(Vec3(p)) - 4.0); });
    };
  }
};

std::string scene_with(const std::string& shape) {
  return R"({"format": "gridcull.scene/1", "dimension": 3, "objects": [{"id": 0, "shape": )" + shape +
         R"(, "position": [10, 0, 0]}, {"id": 1, "shape": )" + shape + R"(, "position": [20, 0, 0]}], "viewers": []})";
}

template <class F>
std::string refusal(ErrorCode code, F&& f) {
  try {
    f();
  } catch (const Error& fault) {
    const std::string line = fault.what();
    CAPTURE(line);
    CHECK(fault.code() == code);
    return line;
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a scene names volumes relative to itself, reads each once, and is written as it was") {
  const TemporaryFolder folder;
  Reader reader;
  const std::string path =
      folder.with("scene.json",
                  scene_with(R"({"type": "volume", "file": "ball.vdb", "grid": "d", "inside_below": -1, "scale": 2})"));
  const Scene scene = read_scene(path, 1 << 20, reader.function());
  CHECK(reader.asked == std::vector<std::string>{"ball.vdb|d"});
  const auto& volume = std::get<Volume>(scene.objects[0].object.shape);
  CHECK(volume.body == std::get<Volume>(scene.objects[1].object.shape).body);
  CHECK(volume.iso == -1.0);
  // Scaled: voxels of 1 m about (2, 0, 0), and so a ball of 3 m about (12, 0, 0).
  CHECK(volume.field->frame().voxel == 1.0);
  CHECK(interior_holds(volume, scene.objects[0].object.pose, {14.9, 0, 0}));
  CHECK_FALSE(interior_holds(volume, scene.objects[0].object.pose, {15.1, 0, 0}));
  const std::string text = scene_text(scene);
  CHECK(holds(text, R"("shape": {"type": "volume", "file": "ball.vdb", "grid": "d", "inside_below": -1, "scale": 2})"));
  const std::string again = folder.with("again.json", text);
  CHECK(scene_text(read_scene(again, 1 << 20, reader.function())) == text);
}

TEST_CASE("a scene's bad volumes are refused by pointer") {
  const TemporaryFolder folder;
  Reader reader;
  const auto line = [&](ErrorCode code, const std::string& shape) {
    const std::string path = folder.with("scene.json", scene_with(shape));
    return refusal(code, [&] { read_scene(path, 1 << 20, reader.function()); });
  };
  CHECK(holds(line(ErrorCode::io, R"({"type": "volume", "file": "a.vdb", "grid": "none", "inside_below": 0})"),
              "scene.json: /objects/0/shape/file: "));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "volume", "file": "a.vdb"})"),
              "/objects/0/shape: expected either \"inside_below\" or \"inside_above\", found neither"));
  CHECK(
      holds(line(ErrorCode::bad_scene, R"({"type": "volume", "file": "a.vdb", "inside_below": 0, "inside_above": 1})"),
            "found both"));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "volume", "file": "a.vdb", "inside_below": 2})"),
              "a.vdb: volume: expected the background outside"));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "volume", "file": "a.vdb", "inside_below": -9})"), "found none"));
  CHECK(
      holds(line(ErrorCode::bad_scene, R"({"type": "volume", "file": "a.vdb", "inside_below": "0"})"), "inside_below"));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "volume", "file": "a.vdb", "inside_below": 0, "scale": 0})"),
              "scale"));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "volume", "file": "a.vdb", "inside_below": 0, "group": ""})"),
              "group"));
  CHECK(holds(line(ErrorCode::bad_scene, R"({"type": "volume", "inside_below": 0})"), "file"));
  const std::string good = scene_with(R"({"type": "volume", "file": "a.vdb", "inside_below": 0})");
  CHECK(holds(refusal(ErrorCode::bad_scene, [&] { parse_scene(good, "wire"); }),
              "wire: /objects/0/shape/type: \"volume\" shapes stand in scene files only"));
  const std::string path = folder.with("scene.json", good);
  CHECK(holds(refusal(ErrorCode::bad_scene, [&] { read_scene(path); }), "a.vdb: volumes are not read here"));
}

TEST_CASE("an imported volume is a scene of one static object that names the file") {
  const TemporaryFolder folder;
  Reader reader;
  VolumeImportOptions options;
  options.file = folder.with("ball.vdb", "");
  options.out = folder.file("some/out");
  options.scale = 2.0;
  options.pose.position = {100, 0, 0};
  options.iso = -1.0;
  const Imported imported = import_volume(options, reader.function());
  REQUIRE(imported.scene.objects.size() == 1);
  const SceneObject& object = imported.scene.objects[0];
  CHECK(object.name == "ball");
  CHECK(object.object.is_static);
  CHECK(object.volume->file == "../../ball.vdb");
  CHECK(interior_holds(object.object.shape, object.object.pose, {104.9, 0, 0}));
  REQUIRE(imported.scene.bounds);
  CHECK(imported.scene.bounds->min.x <= 99.0);
  CHECK(imported.scene.bounds->max.x >= 105.0);
  CHECK(imported.notes.empty());
  options.pose.position = {1e9, 0, 0};
  CHECK(holds(refusal(ErrorCode::usage, [&] { import_volume(options, reader.function()); }), "at most 1e9"));
}
