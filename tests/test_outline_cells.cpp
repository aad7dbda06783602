// Hollow outlines: barriers by flood fill, faces by brute force.
#include <cstdlib>
#include <deque>
#include <set>

#include "cover_check.h"
#include "gridcull/grid/outline_cells.h"

using namespace gridcull;
using cover_check::Random;

namespace {

/// Cells of a 2D lattice and `pad` cells around it.
class Field {
 public:
  Field(const Lattice& lattice, std::int64_t pad)
      : pad_(pad), width_(lattice.cells().x + 2 * pad), height_(lattice.cells().y + 2 * pad) {
    set_.resize(static_cast<std::size_t>(width_ * height_));
  }
  bool holds(const Cell& c) const {
    return c.x >= -pad_ && c.y >= -pad_ && c.x < width_ - pad_ && c.y < height_ - pad_;
  }
  std::vector<char>::reference at(const Cell& c) {
    return set_[static_cast<std::size_t>((c.y + pad_) * width_ + c.x + pad_)];
  }
  template <class F>
  void each(const F& f) {
    for (std::int64_t y = -pad_; y < height_ - pad_; ++y) {
      for (std::int64_t x = -pad_; x < width_ - pad_; ++x) f(Cell{x, y, 0});
    }
  }
  /// Cells reached from `start` by steps to neighbours (four or eight) for which `open` holds.
  template <class Open>
  void flood(const Cell& start, bool diagonal, const Open& open) {
    std::deque<Cell> queue{start};
    at(start) = 1;
    while (!queue.empty()) {
      const Cell c = queue.front();
      queue.pop_front();
      for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
          const Cell n{c.x + dx, c.y + dy, 0};
          if ((!diagonal && dx * dy != 0) || !holds(n) || at(n) || !open(n)) continue;
          at(n) = 1;
          queue.push_back(n);
        }
      }
    }
  }

 private:
  std::int64_t pad_, width_, height_;
  std::vector<char> set_;
};

bool has(const Cover& cover, const Lattice& lattice, const Cell& c) {
  if (!lattice.holds(c)) return false;
  for (const BrickCover& b : cover.bricks) {
    if (b.brick == lattice.brick_of(c)) return b.touched >> lattice.bit_of(c) & 1;
  }
  return false;
}

Lattice random_lattice(Random& random, int dimension) {
  const double cell = random.one_in(2) ? 1.0 : random.in(0.3, 3.0);
  const Vec3 low(random.coordinate(-20, 5), random.coordinate(-20, 5), random.coordinate(-20, 5));
  const int most = dimension == 2 ? 40 : 14;
  const Vec3 size = cell * Vec3(1 + random.below(most), 1 + random.below(most), 1 + random.below(most));
  return Lattice(dimension, {low, low + size}, cell, std::uint64_t{1} << 30);
}

/// A ball of up to a third of the lattice, mostly inside it.
std::pair<Vec3, double> random_ball(Random& random, const Lattice& lattice) {
  const Bounds box = lattice.box();
  Vec3 centre;
  for (int k = 0; k < 3; ++k) centre[k] = random.coordinate(box.min[k] - 0.5, box.max[k] + 0.5);
  if (lattice.dimension() == 2) centre.z = 0.0;
  const double most = 0.3 * std::fmax(box.size().x, box.size().y);
  return {centre, random.one_in(6) ? random.in(1e-6, 0.1) : random.in(0.0, most) + 0.01};
}

}  // namespace

TEST_CASE("a circle outline is a 4-connected barrier around every cell that the disc touches") {
  int whole = 0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    Random random(seed);
    const Lattice lattice = random_lattice(random, 2);
    const auto [centre, radius] = random_ball(random, lattice);
    const CircleOutline circle = circle_outline(lattice, centre, radius);
    Cover outline, disc;
    cover_circle_outline(lattice, centre, radius, outline);
    INFO("seed ", seed, ", radius ", circle.radius, " cells");
    CHECK(outline.outside == !circle.whole);
    cover_ball(lattice, centre, radius, disc);
    if (disc.outside) CHECK(!circle.whole);
    if (!circle.whole) {
      CHECK(outline.bricks.empty());
      continue;
    }
    ++whole;
    Field reached(lattice, 1);
    reached.flood({-1, -1, 0}, true, [&](const Cell& c) { return !has(outline, lattice, c); });
    bool barrier = true, encloses = true, holds_all = true;
    int cells = 0;
    Cell any;
    reached.each([&](const Cell& c) {
      const bool on = has(outline, lattice, c);
      if (on) any = c;
      cells += on;
      const bool touches = cover_truth::ball(centre, radius, cover_check::box_of(lattice, c), 2).touches;
      barrier = barrier && !(touches && reached.at(c));
      encloses = encloses && circle_encloses(circle, c) == !reached.at(c);
      holds_all = holds_all && (!touches || circle_encloses(lattice, centre, radius, c));
    });
    CHECK(barrier);
    CHECK(encloses);
    CHECK(holds_all);
    Field connected(lattice, 1);
    connected.flood(any, false, [&](const Cell& c) { return has(outline, lattice, c); });
    int met = 0;
    connected.each([&](const Cell& c) { met += connected.at(c); });
    CHECK(met == cells);
  }
  CHECK(whole > 300);
}

TEST_CASE("a circle outline is the least one about its centre") {
  int judged = 0;
  for (std::uint64_t seed = 5001; seed <= 5500; ++seed) {
    Random random(seed);
    const Lattice lattice = random_lattice(random, 2);
    const auto [centre, radius] = random_ball(random, lattice);
    const CircleOutline circle = circle_outline(lattice, centre, radius);
    if (!circle.whole || circle.radius == 0) continue;
    const CircleOutline smaller{circle.centre, circle.radius - 1, true};
    bool misses = false;
    Field(lattice, 0).each([&](const Cell& c) {
      const cover_truth::Box box = cover_check::box_of(lattice, c).grown(1e-9);
      misses = misses || (cover_truth::ball(centre, radius, box, 2).touches && !circle_encloses(smaller, c));
    });
    INFO("seed ", seed);
    CHECK(misses);
    ++judged;
  }
  CHECK(judged > 100);
}

TEST_CASE("every segment from outside a circle outline to the disc meets one of its cells") {
  int judged = 0;
  for (std::uint64_t seed = 6001; seed <= 6300; ++seed) {
    Random random(seed);
    const Lattice lattice = random_lattice(random, 2);
    const auto [centre, radius] = random_ball(random, lattice);
    const CircleOutline circle = circle_outline(lattice, centre, radius);
    if (!circle.whole) continue;
    Cover outline;
    cover_circle_outline(lattice, circle, outline);
    const Bounds box = lattice.box();
    for (int i = 0; i < 10; ++i) {
      const Vec3 from(random.coordinate(box.min.x - 5, box.max.x + 5), random.coordinate(box.min.y - 5, box.max.y + 5),
                      0);
      if (circle_encloses(circle, lattice.cell_of(from))) continue;
      const Vec3 way(random.in(-1, 1), random.in(-1, 1), 0);
      const Vec3 to = centre + random.in(0, 1) * radius * way / std::fmax(1.0, glm::length(way));
      bool met = false;
      Field(lattice, 0).each([&](const Cell& c) {
        if (!met && has(outline, lattice, c)) {
          met = cover_truth::meets({from, to}, cover_truth::planar_sides(cover_check::box_of(lattice, c)));
        }
      });
      INFO("seed ", seed, ", segment ", i);
      CHECK(met);
      ++judged;
    }
  }
  CHECK(judged > 300);
}

TEST_CASE("circles that are huge or far away are not whole, and enclose when in doubt") {
  const Lattice lattice(2, {{0, 0, 0}, {100, 100, 0}}, 1.0, 1 << 30);
  Cover out;
  cover_circle_outline(lattice, {50, 50, 0}, 1e9, out);
  CHECK(out.outside);
  CHECK(circle_encloses(lattice, {50, 50, 0}, 1e9, {3, 99, 0}));
  CHECK(circle_encloses(lattice, {1e9, 50, 0}, 1e9, {0, 50, 0}));
  CHECK_FALSE(circle_encloses(lattice, {1e9, 50, 0}, 1e8, {0, 50, 0}));
  cover_circle_outline(lattice, {1e9, 50, 0}, 2.0, out);
  CHECK(out.outside);
  CHECK(out.bricks.empty());
  cover_circle_outline(lattice, {50, 50, 0}, 48.0, out);
  CHECK_FALSE(out.outside);
  cover_circle_outline(lattice, {50, 50, 0}, 49.9, out);
  CHECK(out.outside);
}

TEST_CASE("the three projections of a cube give back exactly the cells of its faces") {
  int whole = 0, cells = 0;
  for (std::uint64_t seed = 7001; seed <= 7800; ++seed) {
    Random random(seed);
    const Lattice lattice = random_lattice(random, 3);
    const auto [centre, radius] = random_ball(random, lattice);
    const CubeCells cube = cube_cells(lattice, centre, radius);
    CubeOutline outline;
    cover_cube_outline(lattice, centre, radius, outline);
    INFO("seed ", seed);
    CHECK(outline.outside == !cube.whole);
    if (!cube.whole) continue;
    ++whole;
    std::array<std::vector<std::uint16_t>, 3> masks;
    for (int k = 0; k < 3; ++k) {
      const auto plane = static_cast<CubePlane>(k);
      masks[k].resize(planar_brick_count(lattice, plane));
      std::int64_t last = -1;
      for (const PlanarBrick& b : outline.plane[static_cast<std::size_t>(k)]) {
        CHECK(static_cast<std::int64_t>(b.brick) > last);
        CHECK(b.mask != 0);
        last = b.brick;
        masks[k].at(b.brick) = b.mask;
      }
    }
    const Cell n = lattice.bricks();
    bool faces = true, held = true;
    for (std::size_t brick = 0; brick < lattice.brick_count(); ++brick) {
      const auto i = static_cast<std::int64_t>(brick);
      const Cell b{i % n.x, i / n.x % n.y, i / (n.x * n.y)};
      const std::uint64_t bits = cells_on_faces(masks[0][planar_brick_index(lattice, CubePlane::xy, b)],
                                                masks[1][planar_brick_index(lattice, CubePlane::xz, b)],
                                                masks[2][planar_brick_index(lattice, CubePlane::yz, b)]);
      const Cell corner = lattice.brick_corner(brick);
      for (int bit = 0; bit < 64; ++bit) {
        const Cell c{corner.x + (bit & 3), corner.y + (bit >> 2 & 3), corner.z + (bit >> 4)};
        const bool in = cube_encloses(cube, c);
        const bool face = in && (c.x == cube.low.x || c.x == cube.high.x || c.y == cube.low.y || c.y == cube.high.y ||
                                 c.z == cube.low.z || c.z == cube.high.z);
        faces = faces && face == ((bits >> bit & 1) != 0);
        cells += face;
        if (lattice.holds(c) && cover_truth::ball(centre, radius, cover_check::box_of(lattice, c), 3).touches) {
          held = held && in;
        }
      }
    }
    CHECK(faces);
    CHECK(held);
  }
  CHECK(whole > 100);
  CHECK(cells > 2000);
}

TEST_CASE("a cube outline that reaches beyond the lattice is not used") {
  const Lattice lattice(3, {{0, 0, 0}, {20, 20, 20}}, 1.0, 1 << 30);
  CubeOutline outline;
  cover_cube_outline(lattice, {10, 10, 10}, 9.5, outline);
  CHECK_FALSE(outline.outside);
  cover_cube_outline(lattice, {10, 10, 10}, 10.5, outline);
  CHECK(outline.outside);
  CHECK(outline.plane[0].empty());
  cover_cube_outline(lattice, {10, 10, 1e9}, 1.0, outline);
  CHECK(outline.outside);
  CHECK(cube_encloses(cube_cells(lattice, {10, 10, 0}, 2.0), {10, 10, -3}));
  CHECK_FALSE(cube_encloses(cube_cells(lattice, {10, 10, 0}, 2.0), {10, 10, -4}));
}
