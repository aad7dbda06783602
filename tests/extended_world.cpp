#include "extended_world.h"

#include <random>

#include "gridcull/core/bounds.h"
#include "gridcull/core/error.h"
#include "random_solids.h"

namespace gridcull::test {
namespace {

Vec3 in_cube(Random& random) { return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; }

Quat random_turn(Random& random) {
  switch (random.below(4)) {
    case 0: return turn_about_z(random.uniform(-3, 3));
    case 1: {
      const Vec3 v = in_cube(random);
      return normalised({random.uniform(0.1, 1), v.x, v.y, v.z});
    }
    default: return {};
  }
}

Shape occluder_shape(Random& random, double size) {
  switch (random.below(8)) {
    case 0: return Sphere{0.5 * size};
    case 1: {
      Convex convex;
      for (std::uint32_t i = 0; i < 6 + random.below(10); ++i) convex.vertices.push_back(0.6 * size * in_cube(random));
      return convex;
    }
    case 2: {
      std::mt19937_64 bits(random.bits());
      std::vector<Vec2> outline = random_outline(bits);
      for (Vec2& p : outline) p *= 0.15 * size;
      return Prism{outline, size * random.uniform(0.3, 1.0)};
    }
    case 3: {
      const double h = 0.5 * size;
      return Faces{{{0, -h, -h}, {0, h, -h}, {0, h, h}, {0, -h, h}, {h, 0, 0}}, {{0, 1, 2}, {0, 2, 3}, {1, 2, 4}}};
    }
    case 4: return Cuboid{{0.1 * size, size, size}};
    default: return Cuboid{size * Vec3(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.3, 1))};
  }
}

double world_height(const Shape& shape) {
  Bounds box;
  if (const auto* sphere = std::get_if<Sphere>(&shape)) return 2.0 * sphere->radius;
  for (const Vec3& p : world_vertices(shape, {})) box.add(p);
  return box.size().z;
}

bool is_valid(const Shape& shape) {
  try {
    validate(shape);
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace

std::vector<const Object*> ExtendedWorld::pointers() const {
  std::vector<const Object*> out;
  for (const Object& object : objects) out.push_back(&object);
  return out;
}

ExtendedWorld random_extended_world(std::uint64_t seed) {
  Random random(seed);
  ExtendedWorld out;
  static constexpr double scales[] = {1.0, 1.0, 0.01, 300.0};
  const double scale = scales[random.below(4)];
  const Vec3 origin = random.below(3) == 0 ? 1e5 * scale * in_cube(random) : Vec3(0.0);
  const bool whole = random.below(2) == 0;  // whole numbers: touching, abutting, aligned
  out.cell.centre = origin;
  out.cell.half =
      scale * (whole ? Vec3(1, 1 + random.below(3), 1) : Vec3(random.uniform(0.2, 2), random.uniform(0.2, 4), 1));
  if (seed % 3 == 0) out.cell.axes = rotation_of(random_turn(random));
  // Every fourth world is a town: blocks that stand on the ground, and a cell on it.
  const bool town = seed % 4 == 1;
  if (town && seed % 3 == 0) out.cell.axes = {};
  const double ground = out.cell.centre.z - out.cell.half.z;
  const auto place = [&](Shape shape, const Vec3& at, bool occluder) {
    if (!is_valid(shape)) return;
    Object o;
    o.id = static_cast<ObjectId>(out.objects.size());
    o.pose.position = origin + scale * (whole ? glm::round(at) : at);
    if (!whole) o.pose.orientation = town ? turn_about_z(at.x) : random_turn(random);
    const double low = std::holds_alternative<Prism>(shape) ? 0.0 : -0.5 * world_height(shape);
    if (town) o.pose.position.z = ground - low;
    o.shape = std::move(shape);
    o.occluder = occluder;
    o.is_static = true;
    out.objects.push_back(std::move(o));
  };
  const std::uint32_t occluders = 3 + random.below(18), occludees = 12;
  for (std::uint32_t i = 0; i < occluders; ++i) {
    const double size = whole ? 2.0 * (1 + random.below(12)) : random.uniform(4, 24);
    // Mostly in front of the cell by about their size, so that they hide a good part of what is far.
    const Vec3 away = glm::normalize(in_cube(random));
    const Vec3 at = random.below(8) == 0 ? 3.0 * in_cube(random) : (3.0 + 0.5 * size + random.uniform(0, 6)) * away;
    place(occluder_shape(random, scale * size), at, random.below(10) != 0);
  }
  for (std::uint32_t i = 0; i < occludees; ++i) {
    const double size = scale * random.uniform(0.2, 4);
    const Vec3 at = (random.below(3) == 0 ? 14.0 : 50.0) * in_cube(random);
    place(random.below(3) == 0 ? Shape(Sphere{0.5 * size}) : Shape(Cuboid{Vec3(size, 0.5 * size, size)}), at,
          random.below(2) == 0);
  }
  return out;
}

Vec3 random_viewpoint(const extended::ViewCell& cell, Random& random) {
  Vec3 p = in_cube(random);
  for (int k = 0; k < 3; ++k) {
    if (random.below(2) == 0) p[k] = p[k] < 0.0 ? -1.0 : 1.0;
  }
  // Drawn in by far more than the roundings of this very line, by less than anything a test could tell.
  return cell.centre + cell.axes * ((1.0 - 1e-9) * p * cell.half);
}

}  // namespace gridcull::test
