#include "bounds_models.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "gridcull/core/trigonometry.h"
#include "gridcull/sim/random.h"

namespace gridcull::bench {
namespace {

constexpr double pi = std::numbers::pi;

Part prism(const std::vector<Vec2>& outline, double height, bool convex) {
  Part part;
  part.convex = convex;
  const auto n = static_cast<std::uint32_t>(outline.size());
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (const Vec2& p : outline) part.vertices.emplace_back(p, z);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    part.triangles.push_back({i, j, n + j});
    part.triangles.push_back({i, n + j, n + i});
    if (i == 0 || j == 0) continue;
    part.triangles.push_back({0, j, i});
    part.triangles.push_back({n, n + i, n + j});
  }
  return part;
}

Part box(const Vec3& size) {
  const Vec2 h = 0.5 * Vec2(size);
  return prism({{-h.x, -h.y}, {h.x, -h.y}, {h.x, h.y}, {-h.x, h.y}}, size.z, true);
}

std::vector<Vec2> circle(int count, double radius) {
  std::vector<Vec2> out;
  for (int i = 0; i < count; ++i) {
    const SinCos a = stable_sincos(2.0 * pi * i / count);
    out.emplace_back(radius * a.cos, radius * a.sin);
  }
  return out;
}

Part cylinder(double radius, double height) { return prism(circle(14, radius), height, true); }

/// A reflex corner at the first point: the fan over the ends stays inside.
Part bracket(double size, double height) {
  const double a = 0.25 * size, b = size;
  return prism({{a, a}, {a, b}, {0, b}, {0, 0}, {b, 0}, {b, a}}, height, false);
}

Part cone(double radius, double height) {
  Part part;
  for (const Vec2& p : circle(14, radius)) part.vertices.emplace_back(p, -0.5 * height);
  part.vertices.emplace_back(0.0, 0.0, 0.5 * height);
  for (std::uint32_t i = 0; i < 14; ++i) part.triangles.push_back({i, (i + 1) % 14, 14});
  for (std::uint32_t i = 1; i + 1 < 14; ++i) part.triangles.push_back({0, i + 1, i});
  return part;
}

Part ring(double radius, double thickness) {
  Part part;
  part.convex = false;
  constexpr std::uint32_t around = 16, across = 8;
  for (std::uint32_t i = 0; i < around; ++i) {
    const SinCos a = stable_sincos(2.0 * pi * i / around);
    for (std::uint32_t k = 0; k < across; ++k) {
      const SinCos b = stable_sincos(2.0 * pi * k / across);
      const double r = radius + thickness * b.cos;
      part.vertices.emplace_back(r * a.cos, r * a.sin, thickness * b.sin);
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const std::uint32_t a = i * across + k, b = ((i + 1) % around) * across + k;
      const std::uint32_t c = ((i + 1) % around) * across + (k + 1) % across, d = i * across + (k + 1) % across;
      part.triangles.push_back({a, b, c});
      part.triangles.push_back({a, c, d});
    }
  }
  return part;
}

Part moved(Part part, const Rotation& turn, const Vec3& to) {
  for (Vec3& v : part.vertices) v = to + turn * v;
  return part;
}

Rotation any_turn(Random& random) {
  return rotation_of(normalised({random.normal(), random.normal(), random.normal(), random.normal()}));
}

/// A quarter turn that takes z to x, y or z.
Rotation axis_turn(Random& random) {
  switch (random.below(3)) {
    case 0: return {};
    case 1: return {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    default: return {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
  }
}

Part any_part(Random& random, double size) {
  const double length = size * random.uniform(0.6, 2.0);
  switch (random.below(6)) {
    case 0: return cylinder(0.3 * size, length);
    case 1: return cone(0.5 * size, length);
    case 2: return box({size, 0.4 * size, length});
    case 3: return bracket(size, 0.5 * length);
    case 4: return ring(0.5 * size, 0.12 * size);
    default: return cylinder(0.12 * size, 2.0 * length);
  }
}

template <class Inside>
bool all_inside(const Part& part, const Inside& inside) {
  for (const Vec3& v : part.vertices) {
    if (!inside(v)) return false;
  }
  return true;
}

View looking(const Vec3& eye, const Vec3& at, double fov_degrees) {
  View view;
  view.viewer = 1;
  const Vec3 x = glm::normalize(at - eye);
  const double heading = std::atan2(x.y, x.x), pitch = -std::asin(x.z);
  const SinCos half = stable_sincos(0.5 * pitch);
  view.pose = {eye, normalised(turn_about_z(heading) * Quat{half.cos, 0.0, half.sin, 0.0})};
  view.frustum = Frustum{fov_degrees * pi / 180.0, 4.0 / 3.0, 0.0, std::numeric_limits<double>::infinity()};
  return view;
}

void add_orbit(Model& model, double radius, double height) {
  for (int i = 0; i < 60; ++i) {
    const SinCos a = stable_sincos(2.0 * pi * i / 60);
    model.views.push_back(looking({radius * a.cos, radius * a.sin, height * a.sin}, Vec3(0.0), 45.0));
  }
}

}  // namespace

Model make_tool() {
  Model model{"tool", {}, {}};
  Random random(1);
  constexpr int plates = 20, rows = 4;
  const double radius = 1.0, length = 4.0, wide = 2.0 * radius * std::tan(pi / plates);
  for (int i = 0; i < plates; ++i) {
    for (int row = 0; row < rows; ++row) {
      if ((i == 3 && row == 1) || (i == 12 && row == 2)) continue;  // windows
      const Rotation turn = rotation_of(turn_about_z(2.0 * pi * i / plates));
      const Vec3 at(radius + 0.01, 0.0, length * ((row + 0.5) / rows - 0.5));
      model.parts.push_back(moved(box({0.02, wide * 1.02, length / rows}), turn, turn * at));
    }
  }
  for (const double z : {-0.5, 0.5}) {
    model.parts.push_back(moved(cylinder(1.04 * radius, 0.02), {}, {0, 0, z * (length + 0.02)}));
  }
  const double inside = radius - 0.005, half = 0.5 * length - 0.005;
  while (model.parts.size() < 500) {
    const Part part = any_part(random, random.uniform(0.05, 0.5));
    const Vec3 at(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-2, 2));
    const Part placed = moved(part, any_turn(random), at);
    if (all_inside(placed, [&](const Vec3& v) { return glm::length(Vec2(v)) < inside && std::fabs(v.z) < half; })) {
      model.parts.push_back(placed);
    }
  }
  add_orbit(model, 6.0, 3.0);
  return model;
}

Model make_radio() {
  Model model{"radio", {}, {}};
  Random random(2);
  const Vec3 half(2.0, 0.7, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      // Each side as 4 x 4 plates, one left out.
      for (int i = 0; i < 16; ++i) {
        if (i == 5) continue;
        Vec3 size = 0.5 * half, at = half * Vec3((i % 4 - 1.5) * 0.5, (i % 4 - 1.5) * 0.5, (i / 4 - 1.5) * 0.5);
        if (axis == 2) at.y = half.y * (i / 4 - 1.5) * 0.5;
        size[axis] = 0.02;
        at[axis] = side * (half[axis] + 0.01);
        model.parts.push_back(moved(box(size), {}, at));
      }
    }
  }
  while (model.parts.size() < 500) {
    const Part part = any_part(random, random.uniform(0.05, 0.5));
    const Vec3 at = half * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Part placed = moved(part, axis_turn(random), at);
    const auto inside = [&](const Vec3& v) {
      return std::fabs(v.x) < half.x && std::fabs(v.y) < half.y && std::fabs(v.z) < half.z;
    };
    if (all_inside(placed, inside)) model.parts.push_back(placed);
  }
  add_orbit(model, 6.0, 3.0);
  return model;
}

namespace {

/// Walls, and a roof over them that juts out; a door is left open in the front.
Part house(double length, double width, double height, double ridge) {
  const double x = 0.5 * length, y = 0.5 * width, d = 0.5;
  Part part;
  part.convex = false;
  part.vertices = {{-x, -y, 0},
                   {-d, -y, 0},
                   {d, -y, 0},
                   {x, -y, 0},
                   {x, y, 0},
                   {-x, y, 0},
                   {-x, -y, height},
                   {-d, -y, height},
                   {d, -y, height},
                   {x, -y, height},
                   {x, y, height},
                   {-x, y, height},
                   {-x, 0, height + ridge},
                   {x, 0, height + ridge},
                   {-d, -y, 2},
                   {d, -y, 2}};
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t e) {
    part.triangles.push_back({a, b, c});
    part.triangles.push_back({a, c, e});
  };
  quad(0, 1, 7, 6), quad(2, 3, 9, 8), quad(14, 15, 8, 7);  // front
  quad(3, 4, 10, 9), quad(4, 5, 11, 10), quad(5, 0, 6, 11);
  quad(6, 9, 13, 12), quad(10, 11, 12, 13);  // roof
  part.triangles.push_back({9, 10, 13});
  part.triangles.push_back({11, 6, 12});
  return part;
}

void add_house(Model& model, Random& random, const Vec3& at) {
  const double length = random.uniform(8, 12), width = random.uniform(6, 9), height = random.uniform(3, 7);
  const double ridge = random.uniform(2, 4);
  const Rotation turn = rotation_of(turn_about_z(random.uniform(-pi, pi)));
  model.parts.push_back(moved(house(length, width, height, ridge), turn, at));
  // A chimney on the roof, furniture and beams within; a hand's breadth from walls and roof.
  model.parts.push_back(moved(box({0.6, 0.6, 1.5}), turn, at + turn * Vec3(0.2 * length, 0.1 * width, height + ridge)));
  for (int tries = 0, made = 0; tries < 200 && made < 8; ++tries) {
    const Part part = any_part(random, random.uniform(0.5, 2.0));
    const Vec3 local(random.uniform(-0.5, 0.5) * length, random.uniform(-0.5, 0.5) * width,
                     random.uniform(0, height + ridge));
    const Rotation own = random.below(3) == 0 ? any_turn(random) : rotation_of(turn_about_z(random.uniform(-pi, pi)));
    const Part placed = moved(part, own, local);
    const auto inside = [&](const Vec3& v) {
      const double roof = height + ridge * (1.0 - std::fabs(v.y) / (0.5 * width));
      return std::fabs(v.x) < 0.5 * length - 0.1 && std::fabs(v.y) < 0.5 * width - 0.1 && v.z > 0.0 && v.z < roof - 0.2;
    };
    if (!all_inside(placed, inside)) continue;
    model.parts.push_back(moved(placed, turn, at));
    ++made;
  }
}

}  // namespace

Model make_houses() {
  Model model{"houses", {}, {}};
  Random random(3);
  for (int i = -5; i <= 5; ++i) {
    for (int k = -5; k <= 5; ++k) {
      if (i == 0) continue;  // the street
      add_house(model, random, {16.0 * i + random.uniform(-1, 1), 16.0 * k + random.uniform(-1, 1), 0.0});
    }
  }
  for (int i = 0; i < 60; ++i) {
    const Vec3 eye(1.0, -75.0 + 2.0 * i, 1.7);
    const SinCos a = stable_sincos(0.5 * pi + 0.8 * stable_sincos(0.3 * i).sin);
    model.views.push_back(looking(eye, eye + Vec3(a.cos, a.sin, 0.05), 45.0));
  }
  return model;
}

Model turned(const Model& model) {
  // 22.5 degrees to either side of the axis.
  const SinCos half = stable_sincos(pi / 8.0);
  const double s = half.sin / std::sqrt(3.0);
  const Quat q = normalised({half.cos, s, s, s});
  Model out{model.name + ", turned", {}, model.views};
  for (const Part& part : model.parts) out.parts.push_back(moved(part, rotation_of(q), Vec3(0.0)));
  for (View& view : out.views) {
    view.pose = {rotation_of(q) * view.pose.position, normalised(q * view.pose.orientation)};
  }
  return out;
}

std::vector<Object> objects_of(const Model& model) {
  std::vector<Object> out;
  for (const Part& part : model.parts) {
    Object object;
    object.id = static_cast<ObjectId>(out.size());
    object.is_static = true;
    object.occluder = part.convex || part.triangles.size() <= 64;
    if (part.convex) {
      object.shape = Convex{part.vertices};
    } else {
      object.shape = Faces{part.vertices, part.triangles};
    }
    out.push_back(std::move(object));
  }
  return out;
}

std::size_t triangles_of(const Model& model) {
  std::size_t sum = 0;
  for (const Part& part : model.parts) sum += part.triangles.size();
  return sum;
}

}  // namespace gridcull::bench
