#include "random_meshes.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

namespace gridcull::test {
namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
std::uint32_t below(std::mt19937_64& random, std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); }

void add_quad(Faces& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

/// A surface over a grid that closes both ways round.
Faces ring(std::mt19937_64& random, double reach) {
  const std::uint32_t around = 3 + below(random, 5), across = 3 + below(random, 4);
  const double thick = reach * (0.15 + 0.2 * unit(random)), wide = reach - thick;
  Faces mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    for (std::uint32_t j = 0; j < across; ++j) {
      const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * j / across;
      const double r = wide + thick * std::cos(v);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), thick * std::sin(v));
      const std::uint32_t i2 = (i + 1) % around, j2 = (j + 1) % across;
      add_quad(mesh, i * across + j, i2 * across + j, i2 * across + j2, i * across + j2);
    }
  }
  return mesh;
}

/// Belts of vertices between two poles, each at its own distance.
Faces lumpy_ball(std::mt19937_64& random, double reach) {
  const std::uint32_t around = 3 + below(random, 5), belts = 1 + below(random, 3);
  const auto distance = [&] { return reach * (0.35 + 0.65 * unit(random)); };
  Faces mesh;
  for (std::uint32_t belt = 0; belt < belts; ++belt) {
    const double up = std::numbers::pi * ((belt + 1.0) / (belts + 1.0) - 0.5);
    for (std::uint32_t i = 0; i < around; ++i) {
      const double u = 2.0 * std::numbers::pi * i / around;
      mesh.vertices.push_back(distance() * Vec3(std::cos(u) * std::cos(up), std::sin(u) * std::cos(up), std::sin(up)));
    }
  }
  const auto south = static_cast<std::uint32_t>(mesh.vertices.size()), north = south + 1;
  mesh.vertices.emplace_back(0.0, 0.0, -distance());
  mesh.vertices.emplace_back(0.0, 0.0, distance());
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t next = (i + 1) % around, last = (belts - 1) * around;
    mesh.triangles.push_back({south, next, i});
    mesh.triangles.push_back({north, last + i, last + next});
    for (std::uint32_t belt = 0; belt + 1 < belts; ++belt) {
      const std::uint32_t a = belt * around, b = a + around;
      add_quad(mesh, a + i, a + next, b + next, b + i);
    }
  }
  return mesh;
}

/// The surface between the cubes that `full` names and the others.
Faces surface_of(const std::function<bool(const std::array<int, 3>&)>& full, int size, double cube) {
  Faces mesh;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = numbers.try_emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
    const double middle = 0.5 * size;
    if (is_new) mesh.vertices.push_back(cube * Vec3(at[0] - middle, at[1] - middle, at[2] - middle));
    return place->second;
  };
  for (int number = 0; number < size * size * size; ++number) {
    const std::array<int, 3> c{number % size, number / size % size, number / size / size};
    if (!full(c)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beside = c;
        beside[axis] += side == 1 ? 1 : -1;
        if (full(beside)) continue;
        std::array<std::uint32_t, 4> corners{};
        for (std::size_t k = 0; k < 4; ++k) {  // counter-clockwise seen along the axis from above
          std::array<int, 3> p = c;
          p[axis] += side;
          p[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
          p[(axis + 2) % 3] += k >= 2 ? 1 : 0;
          corners[k] = vertex(p);
        }
        if (side == 0) std::swap(corners[1], corners[3]);
        add_quad(mesh, corners[0], corners[1], corners[2], corners[3]);
      }
    }
  }
  return mesh;
}

Faces heap(std::mt19937_64& random, double reach) {
  const int size = 2 + static_cast<int>(below(random, 2));
  std::set<std::array<int, 3>> cubes{{0, 0, 0}};
  for (int i = 0; i < 3 * size; ++i) {
    const auto any = [&] { return static_cast<int>(below(random, static_cast<std::uint32_t>(size))); };
    cubes.insert({any(), any(), any()});
  }
  const double cube = 2.0 * reach / (std::sqrt(3.0) * size);
  return surface_of([&](const auto& c) { return cubes.contains(c); }, size, cube >= 1.0 ? std::floor(cube) : cube);
}

Faces hollow_box(double reach) {
  const auto full = [](const std::array<int, 3>& c) {
    for (const int i : c) {
      if (i < 0 || i > 2) return false;
    }
    return c != std::array<int, 3>{1, 1, 1};
  };
  return surface_of(full, 3, reach * 0.38);
}

}  // namespace

Faces random_mesh(std::mt19937_64& random, double reach) {
  Faces mesh;
  switch (random() % 5) {
    case 0: mesh = ring(random, reach); break;
    case 1: mesh = hollow_box(reach); break;
    case 2: mesh = heap(random, reach); break;
    default: mesh = lumpy_ball(random, reach); break;
  }
  mesh.closed = true;
  return mesh;
}

}  // namespace gridcull::test
