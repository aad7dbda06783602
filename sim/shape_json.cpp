#include "gridcull/sim/shape_json.h"

#include <array>

#include "gridcull/sim/json_text.h"

namespace gridcull {
namespace {

std::vector<Vec2> read_points_2d(const JsonRef& json) {
  std::vector<Vec2> out;
  for (const JsonRef& point : json.items()) out.emplace_back(point.point(2));
  return out;
}

std::vector<Vec3> read_points_3d(const JsonRef& json) {
  std::vector<Vec3> out;
  for (const JsonRef& point : json.items()) out.push_back(point.point(3));
  return out;
}

Vec3 read_size(const JsonRef& json, int dimension) {
  const Vec3 size = json.point(dimension);
  const std::vector<JsonRef> parts = json.items();
  for (int axis = 0; axis < dimension; ++axis) parts[static_cast<std::size_t>(axis)].positive();
  return size;
}

Faces read_faces(const JsonRef& json) {
  Faces out{read_points_3d(json.at("vertices")), {}};
  const std::string expected = "the number of one of the " + std::to_string(out.vertices.size()) + " vertices";
  for (const JsonRef& triangle : json.at("triangles").items()) {
    const std::vector<JsonRef> corners = triangle.items();
    if (corners.size() != 3) triangle.refuse("3 vertex numbers");
    std::array<std::uint32_t, 3> numbers{};
    for (std::size_t i = 0; i < 3; ++i) {
      numbers[i] = corners[i].whole(no_id, expected.c_str());
      if (numbers[i] >= out.vertices.size()) corners[i].refuse(expected);
    }
    out.triangles.push_back(numbers);
  }
  if (const auto closed = json.find("closed")) out.closed = closed->boolean();
  return out;
}

std::string read_file_name(const JsonRef& json) {
  if (json.string().empty()) json.refuse("a file name");
  return std::string(json.string());
}

/// A path that leads out of the scene's folder is as good as any: the file is only read.
Shape read_mesh_shape(const JsonRef& json, MeshShelf* meshes, std::optional<MeshSource>* source) {
  json.only_keys({"type", "file", "group"});
  if (meshes == nullptr) {
    json.at("type").refuse_with("\"mesh\" shapes stand in scene files only; give the triangles as \"faces\"");
  }
  MeshSource from{read_file_name(json.at("file")), {}};
  if (const auto group = json.find("group")) from.group = group->string();
  try {
    MeshGroup mesh = meshes->take(from.file, from.group);
    if (source != nullptr) *source = std::move(from);
    return std::move(mesh.faces);
  } catch (const Error& fault) {
    json.at("file").refuse_with(fault.code(), fault.what());
  }
}

Shape read_volume_shape(const JsonRef& json, MeshShelf* shelf, std::optional<VolumeSource>* source) {
  json.only_keys({"type", "file", "grid", "scale", "inside_below", "inside_above"});
  if (shelf == nullptr) json.at("type").refuse_with("\"volume\" shapes stand in scene files only");
  VolumeSource from{read_file_name(json.at("file"))};
  if (const auto grid = json.find("grid")) from.grid = grid->string();
  if (const auto scale = json.find("scale")) from.scale = scale->positive();
  const auto below = json.find("inside_below"), above = json.find("inside_above");
  if (below.has_value() == above.has_value()) {
    json.refuse_with("expected either \"inside_below\" or \"inside_above\", found " +
                     std::string(below ? "both" : "neither"));
  }
  const double iso = (below ? *below : *above).number();
  try {
    Volume volume = shelf->take(from, iso, below.has_value());
    if (source != nullptr) *source = std::move(from);
    return volume;
  } catch (const Error& fault) {
    json.at("file").refuse_with(fault.code(), fault.what());
  }
}

Shape read_2d(const JsonRef& json, std::string_view type) {
  if (type == "disc") {
    json.only_keys({"type", "radius"});
    return Disc{json.at("radius").positive()};
  }
  if (type == "box") {
    json.only_keys({"type", "size"});
    return Rectangle{Vec2(read_size(json.at("size"), 2))};
  }
  if (type == "polygon" || type == "polyline") {
    json.only_keys({"type", "vertices"});
    std::vector<Vec2> vertices = read_points_2d(json.at("vertices"));
    if (type == "polygon") return Polygon{std::move(vertices)};
    return Polyline{std::move(vertices)};
  }
  json.at("type").refuse("a 2D shape: disc, box, polygon or polyline");
}

Shape read_3d(const JsonRef& json, std::string_view type) {
  if (type == "sphere") {
    json.only_keys({"type", "radius"});
    return Sphere{json.at("radius").positive()};
  }
  if (type == "box") {
    json.only_keys({"type", "size"});
    return Cuboid{read_size(json.at("size"), 3)};
  }
  if (type == "prism") {
    json.only_keys({"type", "vertices", "height"});
    return Prism{read_points_2d(json.at("vertices")), json.at("height").positive()};
  }
  if (type == "convex") {
    json.only_keys({"type", "vertices"});
    return Convex{read_points_3d(json.at("vertices"))};
  }
  if (type == "faces") {
    json.only_keys({"type", "vertices", "triangles", "closed"});
    return read_faces(json);
  }
  json.at("type").refuse("a 3D shape: sphere, box, prism, convex, faces, mesh or volume");
}

void append_points(std::string& out, const std::vector<Vec2>& points) {
  append_key(out, "vertices");
  out += '[';
  for (const Vec2& p : points) {
    append_comma(out);
    append_point(out, {p.x, p.y, 0.0}, 2);
  }
  out += ']';
}

void append_points(std::string& out, const std::vector<Vec3>& points) {
  append_key(out, "vertices");
  out += '[';
  for (const Vec3& p : points) {
    append_comma(out);
    append_point(out, p, 3);
  }
  out += ']';
}

/// Writes the members behind "type".
struct Members {
  std::string& out;

  void radius(double value) const {
    append_key(out, "radius");
    append_number(out, value);
  }
  void size(const Vec3& value, int dimension) const {
    append_key(out, "size");
    append_point(out, value, dimension);
  }
  void operator()(const Disc& s) const { radius(s.radius); }
  void operator()(const Rectangle& s) const { size({s.size.x, s.size.y, 0.0}, 2); }
  void operator()(const Polygon& s) const { append_points(out, s.vertices); }
  void operator()(const Polyline& s) const { append_points(out, s.vertices); }
  void operator()(const Sphere& s) const { radius(s.radius); }
  void operator()(const Cuboid& s) const { size(s.size, 3); }
  void operator()(const Prism& s) const {
    append_points(out, s.vertices);
    append_key(out, "height");
    append_number(out, s.height);
  }
  void operator()(const Convex& s) const { append_points(out, s.vertices); }
  void operator()(const Faces& s) const {
    append_points(out, s.vertices);
    append_key(out, "triangles");
    out += '[';
    for (const auto& triangle : s.triangles) {
      append_comma(out);
      out += '[';
      for (const std::uint32_t corner : triangle) {
        append_comma(out);
        append_integer(out, corner);
      }
      out += ']';
    }
    out += ']';
    if (!s.closed) return;
    append_key(out, "closed");
    out += "true";
  }
  void operator()(const Volume&) const {
    throw Error(ErrorCode::bad_scene, "volume: expected one from a file, since only its name is written");
  }
};

}  // namespace

Shape read_shape(const JsonRef& json, int dimension, MeshShelf* meshes, std::optional<MeshSource>* mesh,
                 std::optional<VolumeSource>* volume) {
  const std::string_view type = json.at("type").string();
  Shape shape = dimension == 2     ? read_2d(json, type)
                : type == "mesh"   ? read_mesh_shape(json, meshes, mesh)
                : type == "volume" ? read_volume_shape(json, meshes, volume)
                                   : read_3d(json, type);
  try {
    validate(shape);
  } catch (const Error& fault) {
    json.refuse_with(fault.what());
  }
  return shape;
}

void append_shape(std::string& out, const Shape& shape) {
  out += '{';
  append_key(out, "type");
  append_string(out, std::holds_alternative<Faces>(shape) ? "faces" : name_of(shape));
  std::visit(Members{out}, shape);
  out += '}';
}

void append_mesh(std::string& out, const MeshSource& source) {
  out += '{';
  append_key(out, "type");
  append_string(out, "mesh");
  append_key(out, "file");
  append_string(out, source.file);
  if (!source.group.empty()) {
    append_key(out, "group");
    append_string(out, source.group);
  }
  out += '}';
}

void append_volume(std::string& out, const VolumeSource& source, const Volume& volume) {
  out += '{';
  append_key(out, "type");
  append_string(out, "volume");
  append_key(out, "file");
  append_string(out, source.file);
  if (!source.grid.empty()) {
    append_key(out, "grid");
    append_string(out, source.grid);
  }
  append_key(out, volume.inside_below ? "inside_below" : "inside_above");
  append_number(out, volume.iso);
  if (source.scale != 1.0) {
    append_key(out, "scale");
    append_number(out, source.scale);
  }
  out += '}';
}

}  // namespace gridcull
