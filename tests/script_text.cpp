// Scripts as C++ source.
#include <cmath>
#include <cstdio>

#include "gridcull/core/volume_body.h"
#include "shrink.h"

namespace gridcull::test {
namespace {

std::string text(double v) {
  if (std::isinf(v)) return v > 0 ? "inf" : "-inf";
  char buffer[32];
  for (const int digits : {6, 15, 16, 17}) {
    std::snprintf(buffer, sizeof buffer, "%.*g", digits, v);
    double back = 0.0;
    if (std::sscanf(buffer, "%lf", &back) == 1 && back == v) break;
  }
  return buffer;
}
std::string text(const Vec2& p) { return "{" + text(p.x) + ", " + text(p.y) + "}"; }
std::string text(const Vec3& p) { return "{" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + "}"; }
std::string text(const Pose& p) {
  const Quat& q = p.orientation;
  const bool straight = q.w == 1.0 && q.x == 0.0 && q.y == 0.0 && q.z == 0.0;
  if (straight) return "{" + text(p.position) + "}";
  return "{" + text(p.position) + ", {" + text(q.w) + ", " + text(q.x) + ", " + text(q.y) + ", " + text(q.z) + "}}";
}
std::string text(std::uint32_t id) { return id == no_id ? "no_id" : std::to_string(id) + "u"; }
std::string text(bool b) { return b ? "true" : "false"; }

template <class List, class Text>
std::string listed(const List& list, Text&& one) {
  std::string out;
  for (const auto& item : list) out += (out.empty() ? "" : ", ") + one(item);
  return out;
}

template <class V>
std::string points(const std::vector<V>& list) {
  const std::string type = V::length() == 2 ? "Vec2" : "Vec3";
  return "std::vector<" + type + ">{" + listed(list, [&](const V& p) { return type + text(p); }) + "}";
}

std::string text(const Shape& shape) {
  struct Visitor {
    std::string operator()(const Disc& s) const { return "Disc{" + text(s.radius) + "}"; }
    std::string operator()(const Rectangle& s) const { return "Rectangle{" + text(s.size) + "}"; }
    std::string operator()(const Polygon& s) const { return "Polygon{" + points(s.vertices) + "}"; }
    std::string operator()(const Polyline& s) const { return "Polyline{" + points(s.vertices) + "}"; }
    std::string operator()(const Sphere& s) const { return "Sphere{" + text(s.radius) + "}"; }
    std::string operator()(const Cuboid& s) const { return "Cuboid{" + text(s.size) + "}"; }
    std::string operator()(const Prism& s) const { return "Prism{" + points(s.vertices) + ", " + text(s.height) + "}"; }
    std::string operator()(const Convex& s) const { return "Convex{" + points(s.vertices) + "}"; }
    std::string operator()(const Faces& s) const {
      const std::string triangles = listed(s.triangles, [](const auto& t) {
        return "std::array<std::uint32_t, 3>{" + text(t[0]) + ", " + text(t[1]) + ", " + text(t[2]) + "}";
      });
      return "Faces{" + points(s.vertices) + ", {" + triangles + "}}";
    }
    std::string operator()(const Volume& s) const {
      return "Sphere{1} /* a volume about " + points(s.body->outer) + ": run the seed */";
    }
  };
  return std::visit(Visitor{}, shape);
}

std::string text(const Object& o) {
  const std::string speed = o.max_speed ? "std::optional<double>{" + text(*o.max_speed) + "}" : "std::nullopt";
  return "Object{" + text(o.id) + ", " + text(o.shape) + ", " + text(o.pose) + ", " + speed + ", " + text(o.occluder) +
         ", " + text(o.is_static) + "}";
}

std::string text(const View& v) {
  std::string frustum = "std::nullopt";
  if (v.frustum) {
    const Frustum& f = *v.frustum;
    frustum = "Frustum{" + text(f.fov_y) + ", " + text(f.aspect) + ", " + text(f.near) + ", " + text(f.far) + "}";
  }
  return "View{" + text(v.viewer) + ", " + text(v.pose) + ", " + text(v.range) + ", " + text(v.fov) + ", " + frustum +
         ", " + text(v.rides) + "}";
}

std::string text(const ScriptFrame& f) {
  const auto any = [](const auto& item) { return text(item); };
  const auto move = [](const ScriptMove& m) { return "ScriptMove{" + text(m.id) + ", " + text(m.pose) + "}"; };
  return "ScriptFrame{" + text(f.time) + ",\n   {" + listed(f.remove, any) + "},\n   {" + listed(f.add, any) +
         "},\n   {" + listed(f.moves, move) + "},\n   {" + listed(f.views, any) + "}}";
}

}  // namespace

std::string to_cpp(const WorldScript& s) {
  std::string out = "WorldScript{" + std::to_string(s.dimension) + ", {" + text(s.bounds.min) + ", " +
                    text(s.bounds.max) + "}, " + text(s.cell) + ", \"" + s.tbv + "\", " + std::to_string(s.threads) +
                    ",\n {";
  for (const Object& o : s.objects) out += text(o) + ",\n  ";
  out += "},\n {";
  for (const ScriptFrame& f : s.frames) out += text(f) + ",\n  ";
  return out + "}}";
}

}  // namespace gridcull::test
