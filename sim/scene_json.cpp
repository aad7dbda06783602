#include "gridcull/sim/scene_json.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "gridcull/sim/json_text.h"
#include "gridcull/sim/shape_json.h"

namespace gridcull {
namespace {

Quat read_quaternion(const JsonRef& json) {
  const std::vector<JsonRef> parts = json.items();
  if (parts.size() != 4) json.refuse("a unit quaternion [w, x, y, z]");
  const Quat q{parts[0].number(), parts[1].number(), parts[2].number(), parts[3].number()};
  try {
    return settled(q);
  } catch (const Error&) {
    json.refuse_with("expected a unit quaternion [w, x, y, z], found one of length 0");
  }
}

struct Direction {
  std::optional<Quat> orientation{};
  std::optional<double> heading{};
};

Direction read_direction(const JsonRef& json, int dimension) {
  Direction out;
  if (const auto heading = json.find("heading")) {
    out.heading = heading->number();
    out.orientation = turn_about_z(*out.heading);
  }
  if (const auto orientation = json.find("orientation")) {
    if (dimension == 2) orientation->refuse_with("a 2D scene has \"heading\", not \"orientation\"");
    if (out.heading) orientation->refuse_with("expected either \"heading\" or \"orientation\", found both");
    out.orientation = read_quaternion(*orientation);
  }
  return out;
}

Frustum read_frustum(const JsonRef& json) {
  json.only_keys({"fov_y_degrees", "aspect", "near", "far"});
  Frustum out;
  const JsonRef fov = json.at("fov_y_degrees");
  const char* expected = "degrees above 0 and below 180";
  out.fov_y = radians_of(fov.within(0.0, 180.0, expected));
  if (!(out.fov_y > 0.0 && out.fov_y < std::numbers::pi)) fov.refuse(expected);
  out.aspect = json.at("aspect").within(1e-6, 1e6, "an aspect of 1e-6 to 1e6");
  if (const auto near = json.find("near")) out.near = near->not_negative();
  if (const auto far = json.find("far")) {
    out.far = far->positive();
    if (!(out.far > out.near)) far->refuse("a number above \"near\"");
  }
  return out;
}

void append_direction(std::string& out, const std::optional<Quat>& orientation, const std::optional<double>& heading,
                      int dimension) {
  if (!orientation) return;
  const Quat& q = *orientation;
  const auto is = [&](const Quat& o) { return o.w == q.w && o.x == q.x && o.y == q.y && o.z == q.z; };
  const bool as_given = heading && is(turn_about_z(*heading));
  if (as_given || dimension == 2) {
    append_key(out, "heading");
    append_number(out, as_given ? *heading : heading_of(q));
    return;
  }
  append_key(out, "orientation");
  out += '[';
  for (const double part : {q.w, q.x, q.y, q.z}) {
    append_comma(out);
    append_number(out, part);
  }
  out += ']';
}

void append_named(std::string& out, std::string_view key, double value) {
  append_key(out, key);
  append_number(out, value);
}

void append_place(std::string& out, std::string_view key, const Vec3& point, int dimension) {
  append_key(out, key);
  append_point(out, point, dimension);
}

void append_id(std::string& out, std::string_view key, std::uint32_t id) {
  append_key(out, key);
  append_integer(out, id);
}

void append_frustum(std::string& out, const Frustum& frustum) {
  append_key(out, "frustum");
  out += '{';
  append_named(out, "fov_y_degrees", degrees_of(frustum.fov_y));
  append_named(out, "aspect", frustum.aspect);
  if (frustum.near != 0.0) append_named(out, "near", frustum.near);
  if (std::isfinite(frustum.far)) append_named(out, "far", frustum.far);
  out += '}';
}

}  // namespace

Quat settled(Quat q) {
  for (int i = 0; i < 8; ++i) {
    const Quat next = normalised(q);
    const bool same = next.w == q.w && next.x == q.x && next.y == q.y && next.z == q.z;
    q = next;
    if (same) break;
  }
  return q;
}

double radians_of(double degrees) { return degrees * (std::numbers::pi / 180.0); }

double degrees_of(double radians) {
  const double nearest = radians * (180.0 / std::numbers::pi);
  for (const int digits : {6, 9, 12, 15}) {
    char text[32];
    const int size = std::snprintf(text, sizeof text, "%.*g", digits, nearest);
    double rounded = nearest;
    std::from_chars(text, text + size, rounded);
    if (radians_of(rounded) == radians) return rounded;
  }
  // One multiplication each way is off by at most a few units in the last place.
  for (const std::int64_t ulps : {0, 1, -1, 2, -2, 3, -3, 4, -4}) {
    const auto near = std::bit_cast<double>(std::bit_cast<std::int64_t>(nearest) + ulps);
    if (radians_of(near) == radians) return near;
  }
  return nearest;
}

std::optional<std::size_t> first_repeated(std::span<const std::uint32_t> ids) {
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end()) return std::nullopt;
  std::vector<std::uint32_t> order(ids.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return ids[a] != ids[b] ? ids[a] < ids[b] : a < b; });
  const auto same = [&](auto a, auto b) { return ids[a] == ids[b]; };
  const auto at = std::adjacent_find(order.begin(), order.end(), same);
  return at == order.end() ? std::nullopt : std::optional<std::size_t>(*(at + 1));
}

void refuse_repeated(const std::vector<JsonRef>& list, const std::vector<std::uint32_t>& ids) {
  if (const auto at = first_repeated(ids)) {
    list[*at].refuse_with("expected each id once, found " + std::to_string(ids[*at]) + " twice");
  }
}

SceneObject read_object(const JsonRef& json, int dimension, MeshShelf* meshes) {
  json.only_keys({"id", "name", "static", "shape", "position", "heading", "orientation", "max_speed", "occluder"});
  SceneObject out;
  out.object.id = json.at("id").id();
  if (const auto name = json.find("name")) out.name = name->string();
  if (const auto is_static = json.find("static")) out.object.is_static = is_static->boolean();
  out.object.shape = read_shape(json.at("shape"), dimension, meshes, &out.mesh, &out.volume);
  out.object.pose.position = json.at("position").point(dimension);
  const Direction direction = read_direction(json, dimension);
  if (direction.orientation) out.object.pose.orientation = *direction.orientation;
  out.heading = direction.heading;
  if (const auto speed = json.find("max_speed")) out.object.max_speed = speed->not_negative();
  if (const auto occluder = json.find("occluder")) out.object.occluder = occluder->boolean();
  return out;
}

ObjectMove read_move(const JsonRef& json, int dimension) {
  json.only_keys({"id", "position", "heading", "orientation"});
  ObjectMove out;
  out.id = json.at("id").id();
  if (const auto position = json.find("position")) out.position = position->point(dimension);
  const Direction direction = read_direction(json, dimension);
  out.orientation = direction.orientation;
  out.heading = direction.heading;
  return out;
}

ViewerUpdate read_viewer(const JsonRef& json, int dimension) {
  if (dimension == 2) {
    json.only_keys({"id", "follows", "offset", "position", "heading", "orientation", "range", "fov_degrees"});
  } else {
    json.only_keys({"id", "follows", "offset", "position", "heading", "orientation", "range", "frustum"});
  }
  ViewerUpdate out;
  out.id = json.at("id").id();
  if (const auto position = json.find("position")) out.position = position->point(dimension);
  if (const auto follows = json.find("follows")) out.follows = follows->id();
  if (const auto offset = json.find("offset")) out.offset = offset->point(dimension);
  const Direction direction = read_direction(json, dimension);
  out.orientation = direction.orientation;
  out.heading = direction.heading;
  if (const auto range = json.find("range")) out.range = range->positive();
  if (const auto fov = json.find("fov_degrees")) {
    const char* expected = "degrees above 0 and at most 360";
    out.fov = radians_of(fov->within(0.0, 360.0, expected));
    if (!(*out.fov > 0.0)) fov->refuse(expected);
  }
  if (const auto frustum = json.find("frustum")) out.frustum = read_frustum(*frustum);
  return out;
}

void append_object(std::string& out, const SceneObject& object, int dimension) {
  const Object& o = object.object;
  out += '{';
  append_id(out, "id", o.id);
  if (!object.name.empty()) {
    append_key(out, "name");
    append_string(out, object.name);
  }
  if (o.is_static) out += ", \"static\": true";
  append_key(out, "shape");
  if (object.mesh) {
    append_mesh(out, *object.mesh);
  } else if (object.volume) {
    append_volume(out, *object.volume, std::get<Volume>(o.shape));
  } else {
    append_shape(out, o.shape);
  }
  append_place(out, "position", o.pose.position, dimension);
  const Quat& q = o.pose.orientation;
  const bool turned = object.heading || q.w != 1.0 || q.x != 0.0 || q.y != 0.0 || q.z != 0.0;
  if (turned) append_direction(out, q, object.heading, dimension);
  if (o.max_speed) append_named(out, "max_speed", *o.max_speed);
  if (!o.occluder) out += ", \"occluder\": false";
  out += '}';
}

void append_move(std::string& out, const ObjectMove& move, int dimension) {
  out += '{';
  append_id(out, "id", move.id);
  if (move.position) append_place(out, "position", *move.position, dimension);
  append_direction(out, move.orientation, move.heading, dimension);
  out += '}';
}

void append_viewer(std::string& out, const ViewerUpdate& viewer, int dimension) {
  out += '{';
  append_id(out, "id", viewer.id);
  if (viewer.follows) append_id(out, "follows", *viewer.follows);
  if (viewer.offset) append_place(out, "offset", *viewer.offset, dimension);
  if (viewer.position) append_place(out, "position", *viewer.position, dimension);
  append_direction(out, viewer.orientation, viewer.heading, dimension);
  if (viewer.range) append_named(out, "range", *viewer.range);
  if (viewer.fov && dimension == 2) append_named(out, "fov_degrees", degrees_of(*viewer.fov));
  if (viewer.frustum && dimension == 3) append_frustum(out, *viewer.frustum);
  out += '}';
}

}  // namespace gridcull
