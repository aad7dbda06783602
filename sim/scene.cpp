#include "gridcull/sim/scene.h"

#include <algorithm>
#include <cmath>

#include "gridcull/sim/json_text.h"
#include "gridcull/sim/mesh_shelf.h"
#include "gridcull/sim/scene_json.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

constexpr std::string_view format = "gridcull.scene/1";

Bounds read_bounds(const JsonRef& json, int dimension) {
  json.only_keys({"min", "max"});
  const Bounds out{json.at("min").point(dimension), json.at("max").point(dimension)};
  for (int axis = 0; axis < dimension; ++axis) {
    if (!(out.max[axis] > out.min[axis])) json.at("max").refuse_with("expected more than \"min\" on every axis");
  }
  return out;
}

void read_objects(const JsonRef& json, MeshShelf* meshes, Scene& scene) {
  const std::vector<JsonRef> list = json.items();
  std::vector<std::uint32_t> ids;
  for (const JsonRef& item : list) {
    scene.objects.push_back(read_object(item, scene.dimension, meshes));
    ids.push_back(scene.objects.back().object.id);
  }
  refuse_repeated(list, ids);
}

void read_viewers(const JsonRef& json, Scene& scene) {
  std::vector<std::uint32_t> objects;
  for (const SceneObject& object : scene.objects) objects.push_back(object.object.id);
  std::sort(objects.begin(), objects.end());
  const std::vector<JsonRef> list = json.items();
  std::vector<std::uint32_t> ids;
  for (const JsonRef& item : list) {
    const ViewerUpdate update = read_viewer(item, scene.dimension);
    const std::string fault = fault_of(nullptr, update);
    if (!fault.empty()) item.refuse_with(fault);
    if (update.follows && !std::binary_search(objects.begin(), objects.end(), *update.follows)) {
      item.at("follows").refuse("the id of an object of the scene");
    }
    update_viewer(scene.viewers.emplace_back(), update);
    ids.push_back(update.id);
  }
  refuse_repeated(list, ids);
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& source_name, MeshShelf* meshes) {
  const JsonTree tree(text, source_name, ErrorCode::bad_scene);
  return read_scene(tree.root(), meshes);
}

Scene read_scene(const JsonRef& root, MeshShelf* meshes) {
  // The format first: an unknown key of a later version is then explained by its version.
  root.at("format").expect_format(format);
  root.only_keys({"format", "dimension", "bounds", "grid", "objects", "viewers", "static_volume"});
  Scene scene;
  const JsonRef dimension = root.at("dimension");
  scene.dimension = static_cast<int>(dimension.within(2.0, 3.0, "2 or 3"));
  if (scene.dimension != dimension.number()) dimension.refuse("2 or 3");
  if (const auto bounds = root.find("bounds")) scene.bounds = read_bounds(*bounds, scene.dimension);
  if (const auto grid = root.find("grid")) {
    grid->only_keys({"cell"});
    scene.cell = grid->at("cell").positive();
  }
  if (const auto volume = root.find("static_volume")) {
    if (meshes == nullptr) volume->refuse_with("files are not taken here: a static volume belongs into a scene file");
    volume->only_keys({"file"});
    scene.static_volume = volume->at("file").string();
    if (scene.static_volume.empty()) volume->at("file").refuse("the name of a file");
  }
  read_objects(root.at("objects"), meshes, scene);
  read_viewers(root.at("viewers"), scene);
  return scene;
}

Scene read_scene(const std::string& path, std::uint64_t max_mesh_memory, const FieldReader& read_field) {
  MeshShelf meshes(path, max_mesh_memory, read_field);
  return parse_scene(read_text(path), path == "-" ? "standard input" : path, &meshes);
}

std::string scene_text(const Scene& scene) {
  const int n = scene.dimension;
  std::string out = "{ \"format\": \"" + std::string(format) + "\", \"dimension\": " + std::to_string(n);
  if (scene.bounds) {
    out += ",\n  \"bounds\": {";
    append_key(out, "min");
    append_point(out, scene.bounds->min, n);
    append_key(out, "max");
    append_point(out, scene.bounds->max, n);
    out += '}';
  }
  if (scene.cell) {
    out += ",\n  \"grid\": {\"cell\": ";
    append_number(out, *scene.cell);
    out += '}';
  }
  if (!scene.static_volume.empty()) {
    out += ",\n  \"static_volume\": {\"file\": ";
    append_string(out, scene.static_volume);
    out += '}';
  }
  const char* separator = "\n    ";
  out += ",\n  \"objects\": [";
  for (const SceneObject& object : scene.objects) {
    out += separator;
    append_object(out, object, n);
    separator = ",\n    ";
  }
  separator = "\n    ";
  out += " ],\n  \"viewers\": [";
  for (const SceneViewer& viewer : scene.viewers) {
    out += separator;
    append_viewer(out, update_of(viewer), n);
    separator = ",\n    ";
  }
  return out + " ]\n}\n";
}

void write_scene(const std::string& path, const Scene& scene) { write_text(path, scene_text(scene)); }

}  // namespace gridcull
