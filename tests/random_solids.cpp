#include "random_solids.h"

#include <cmath>

namespace gridcull::test {
namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
double in(std::mt19937_64& random, double low, double high) { return low + (high - low) * unit(random); }
Vec3 cube(std::mt19937_64& random) { return {in(random, -1, 1), in(random, -1, 1), in(random, -1, 1)}; }

std::vector<Vec2> round_outline(std::mt19937_64& random, int count, double least) {
  std::vector<Vec2> out;
  for (int i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * (i + 0.8 * unit(random)) / count, r = in(random, least, 5.0);
    out.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  return out;
}

Shape random_faces(std::mt19937_64& random) {
  Faces faces;
  if (random() % 2 == 0) {
    for (int i = 0; i < 9; ++i) faces.vertices.push_back(3.0 * cube(random));
    for (std::uint32_t i = 0; i < 4; ++i) faces.triangles.push_back({i, i + 2, i + 5});
    return faces;
  }
  // A wall of quads in one plane, and one that leans.
  const Vec3 u(in(random, 1, 4), 0, 0), v(0, random() % 2 == 0 ? 0 : 1, in(random, 1, 3));
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) faces.vertices.push_back(static_cast<double>(i) * u + static_cast<double>(j) * v);
  }
  for (std::uint32_t j = 0; j < 2; ++j) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      const std::uint32_t a = 3 * j + i;
      faces.triangles.push_back({a, a + 1, a + 4});
      faces.triangles.push_back({a, a + 4, a + 3});
    }
  }
  return faces;
}

Shape random_shape(std::mt19937_64& random) {
  switch (random() % 5) {
    case 0: return Cuboid{{in(random, 0.2, 20), in(random, 0.2, 20), in(random, 0.2, 20)}};
    case 1: return Cuboid{{std::floor(in(random, 1, 6)), std::floor(in(random, 1, 6)), random() % 3 == 0 ? 0.01 : 4.0}};
    case 2: return Prism{random_outline(random), in(random, 0.5, 30)};
    case 3: {
      Convex convex;
      const std::uint64_t count = 4 + random() % 40;
      const bool lattice = random() % 2 == 0;
      for (std::uint64_t i = 0; i < count; ++i) {
        const Vec3 p = 4.0 * cube(random);
        convex.vertices.push_back(lattice ? Vec3(std::round(p.x), std::round(p.y), std::round(p.z)) : p);
      }
      convex.vertices.insert(convex.vertices.end(), {{4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {-4, -4, -4}});
      return convex;
    }
    default: return random_faces(random);
  }
}

}  // namespace

std::vector<Vec2> random_outline(std::mt19937_64& random) {
  switch (random() % 7) {
    case 0: return {{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 5}, {0, 5}};                  // L
    case 1: return {{0, 0}, {9, 0}, {9, 4}, {6, 4}, {6, 1}, {3, 1}, {3, 4}, {0, 4}};  // U
    case 2: return {{0, 0}, {4, 3}, {4, 0}, {0, 3}};                                  // bow tie
    case 3: return round_outline(random, 3 + static_cast<int>(random() % 12), 0.5 + 4 * unit(random));
    case 4: {  // anything
      std::vector<Vec2> out;
      for (std::uint64_t i = 0, n = 3 + random() % 8; i < n; ++i)
        out.emplace_back(in(random, -5, 5), in(random, -5, 5));
      return out;
    }
    case 5:  // a courtyard behind a bridge walked there and back, with repeated and collinear points
      return {{0, 0}, {3, 0}, {6, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}};
    default: {  // lattice points: ties of all kinds
      std::vector<Vec2> out;
      for (std::uint64_t i = 0, n = 4 + random() % 9; i < n; ++i) {
        out.emplace_back(static_cast<double>(random() % 6), static_cast<double>(random() % 6));
      }
      out.insert(out.end(), {{0, 0}, {5, 0}, {0, 5}});
      return out;
    }
  }
}

Placement random_placement(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Placement out{random_shape(random), {}, {}};
  const int size = static_cast<int>(random() % 4);
  const double far = size == 0 ? 0.0 : size == 1 ? 50.0 : size == 2 ? 3000.0 : 1e6;
  out.pose.position = far * cube(random);
  if (random() % 2 == 0) out.pose.position = glm::floor(out.pose.position);
  const int turn = static_cast<int>(random() % 3);
  if (turn == 1) out.pose.orientation = turn_about_z(in(random, -3, 3));
  if (turn == 2)
    out.pose.orientation = normalised({in(random, -1, 1), in(random, -1, 1), in(random, -1, 1), in(random, 0.1, 1)});
  const std::vector<Vec3> points = world_vertices(out.shape, out.pose);
  const Vec3 a = points[random() % points.size()], b = points[random() % points.size()];
  const Vec3 c = points[random() % points.size()];
  switch (random() % 6) {
    case 0: out.eye = out.pose.position + in(random, 5, 200) * cube(random); break;
    case 1: out.eye = out.pose.position + glm::floor(12.0 * cube(random)); break;
    case 2: out.eye = a + in(random, -3, 3) * (b - a); break;                                // on an edge's line, or so
    case 3: out.eye = a + in(random, -4, 4) * (b - a) + in(random, -4, 4) * (c - a); break;  // on a face plane, or so
    case 4: out.eye = 0.5 * (a + b) + std::pow(2.0, in(random, -40, 2)) * cube(random); break;  // close by
    default: out.eye = out.pose.position + 15.0 * cube(random); break;
  }
  return out;
}

}  // namespace gridcull::test
