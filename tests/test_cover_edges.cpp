// Discretisation where it is easy to go wrong: shapes on cell boundaries, without area, huge, far away.
#include <numbers>

#include "cover_check.h"

using namespace gridcull;
using cover_check::compare;
using cover_check::Findings;
using cover_check::Random;

namespace {

constexpr std::uint64_t plenty = std::uint64_t{1} << 32;

Findings covered(const Lattice& lattice, const Shape& shape, const Pose& pose, double tolerance = 1e-9) {
  CoverScratch scratch;
  Cover cover;
  PreparedShape(shape).cover(lattice, pose, scratch, cover);
  return compare(lattice, shape, pose, cover, tolerance);
}

/// Every shape, about the size of `size`.
std::vector<Shape> shapes(int dimension, double size) {
  const double s = size;
  if (dimension == 2) {
    return {Disc{s}, Rectangle{{2 * s, 2 * s}}, Polygon{{{-s, -s}, {s, -s}, {s, s}, {-s, s}}},
            Polyline{{{-s, -s}, {s, s}}}};
  }
  return {Sphere{s}, Cuboid{{2 * s, 2 * s, 2 * s}}, Prism{{{-s, -s}, {s, -s}, {s, s}, {-s, s}}, s},
          Convex{{{-s, -s, -s}, {s, -s, -s}, {0, s, -s}, {0, 0, s}}},
          Faces{{{-s, -s, -s}, {s, -s, -s}, {0, s, s}}, {{0, 1, 2}}}};
}

}  // namespace

TEST_CASE("a shape on cell boundaries touches the cells beside it and holds only the inner ones") {
  const Lattice lattice(2, {{-8, -8, 0}, {8, 8, 0}}, 1.0, plenty);
  for (const Shape& square : {Shape(Rectangle{{4, 4}}), Shape(Polygon{{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}})}) {
    for (const int quarter : {0, 1, 2, 3}) {
      const Pose pose{{1, -2, 0}, turn_about_z(0.5 * std::numbers::pi * quarter)};
      const Findings f = covered(lattice, square, pose);
      INFO(name_of(square), ": ", f.text());
      CHECK(f.safe());
      CHECK(f.touched == 36);
      CHECK(f.opaque == 4);
    }
  }
  const Findings disc = covered(lattice, Disc{2.0}, {});
  CHECK(disc.safe());
  CHECK(disc.touched == 4 * 4 + 8);  // the four neighbours in each direction are touched in one point
  CHECK(disc.opaque == 4);           // corners at sqrt 2; (2, 1) lies at sqrt 5
  const Lattice solid(3, {{-4, -4, -4}, {4, 4, 4}}, 1.0, plenty);
  const Findings cube = covered(solid, Cuboid{{4, 4, 4}}, {});
  CHECK(cube.safe());
  CHECK(cube.touched == 6 * 6 * 6);
  CHECK(cube.opaque == 8);
}

TEST_CASE("outlines without area hold nothing; a hole by the even-odd rule is open") {
  const Lattice lattice(2, {{-10, -10, 0}, {10, 10, 0}}, 1.0, plenty);
  const Findings flat = covered(lattice, Polygon{{{-7, -3}, {7, 4}, {0, 0.5}}}, {});
  CHECK(flat.safe());
  CHECK(flat.opaque == 0);
  CHECK(flat.touched > 14);
  // The same square twice: the second turn undoes the first.
  const Findings twice =
      covered(lattice, Polygon{{{-6, -6}, {6, -6}, {6, 6}, {-6, 6}, {-6, -6}, {6, -6}, {6, 6}, {-6, 6}}}, {});
  CHECK(twice.opaque == 0);
  // A square with a smaller one inside it, joined by a cut: the inner one is a hole.
  const Findings ring = covered(
      lattice, Polygon{{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}, {-8, -8}, {-3, -3}, {-3, 3}, {3, 3}, {3, -3}, {-3, -3}}},
      {});
  CHECK(ring.safe());
  CHECK(ring.tight());
  CHECK(ring.opaque > 80);
}

TEST_CASE("huge shapes cover the whole lattice and no more is done than that") {
  for (const int dimension : {2, 3}) {
    const Lattice lattice(dimension, {{0, 0, 0}, {9, 7, dimension == 3 ? 6.0 : 0.0}}, 1.0, plenty);
    for (const Shape& shape : shapes(dimension, 4e8)) {
      for (const double shift : {0.0, 3.25, 1e5}) {
        const Pose pose{{shift, -shift, dimension == 3 ? 0.5 * shift - 1e6 : 0.0}, turn_about_z(0.7)};
        const Findings f = covered(lattice, shape, pose, 1e-3);
        INFO(name_of(shape), " moved by ", shift, ": ", f.text());
        CHECK(f.safe());
        CHECK(f.tight());
        if (!is_thin(shape)) CHECK(f.opaque == static_cast<int>(lattice.cell_count()));
      }
    }
  }
}

TEST_CASE("shapes far away touch nothing and are outside") {
  for (const int dimension : {2, 3}) {
    const Lattice lattice(dimension, {{0, 0, 0}, {20, 20, dimension == 3 ? 20.0 : 0.0}}, 1.0, plenty);
    CoverScratch scratch;
    Cover cover;
    for (const Shape& shape : shapes(dimension, 2.0)) {
      for (const Vec3& where : {Vec3(1e9, 5, 5), Vec3(-1e9, -1e9, 5), Vec3(5, 23.5, 5), Vec3(-2.5, 5, 5)}) {
        PreparedShape(shape).cover(lattice, {{where.x, where.y, dimension == 3 ? where.z : 0.0}, {}}, scratch, cover);
        INFO(name_of(shape), " at ", where.x);
        CHECK(cover.bricks.empty());
        CHECK(cover.outside);
      }
      PreparedShape(shape).cover(lattice, {{10, 10, dimension == 3 ? 10.0 : 0.0}, {}}, scratch, cover);
      CHECK_FALSE(cover.bricks.empty());
      CHECK_FALSE(cover.outside);
      PreparedShape(shape).cover(lattice, {{19, 10, dimension == 3 ? 10.0 : 0.0}, {}}, scratch, cover);
      CHECK_FALSE(cover.bricks.empty());
      CHECK(cover.outside);
    }
  }
}

TEST_CASE("a lattice a billion metres out keeps the cells right to its margin") {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    Random random(seed);
    const int dimension = 2 + static_cast<int>(seed % 2);
    const Vec3 low(9e8 + random.coordinate(0, 50), -9e8, dimension == 3 ? 5e8 : 0.0);
    const Lattice lattice(dimension, {low, low + Vec3(9, 7, dimension == 3 ? 6 : 0)}, 0.5, plenty);
    for (const Shape& shape : shapes(dimension, random.coordinate(0.25, 4.0))) {
      Pose pose{low + Vec3(random.coordinate(-1, 10), random.coordinate(-1, 8), 0), turn_about_z(random.in(-3, 3))};
      if (dimension == 3) {
        pose.position.z += random.coordinate(-1, 7);
        if (!std::holds_alternative<Prism>(shape)) pose.orientation = random.turn();
      }
      const Findings f = covered(lattice, shape, pose, 1e-3);
      INFO("seed ", seed, ", ", name_of(shape), ": ", f.text());
      CHECK(f.safe());
      CHECK(f.tight());
    }
  }
}

TEST_CASE("slivers thinner than the rounding of their coordinates are touched and hold nothing") {
  const Lattice lattice(2, {{1000, 1000, 0}, {1030, 1030, 0}}, 1.0, plenty);
  for (const double width : {1e-9, 1e-12, 1e-15, 1e-200}) {
    for (const double heading : {0.0, 0.3, 1.5707963, 2.0}) {
      const Pose pose{{1015, 1014.5, 0}, turn_about_z(heading)};
      const double w = 0.5 * width;
      for (const Shape& shape : {Shape(Rectangle{{18, width}}), Shape(Polygon{{{-9, -w}, {9, -w}, {9, w}, {-9, w}}})}) {
        const Findings f = covered(lattice, shape, pose);
        INFO(name_of(shape), ", width ", width, ", heading ", heading, ": ", f.text());
        CHECK(f.safe());
        CHECK(f.tight());
        CHECK(f.touched >= 18);
        CHECK(f.opaque == 0);
      }
    }
  }
  const Lattice solid(3, {{0, 0, 0}, {12, 12, 12}}, 1.0, plenty);
  for (const double size : {1e-9, 1e-160}) {
    const Findings speck =
        covered(solid, Faces{{{0, 0, 0}, {size, 0, 0}, {0, size, size}}, {{0, 1, 2}}}, {{5.5, 5.5, 5.5}, {}});
    CHECK(speck.safe());
    CHECK(speck.touched == 1);
  }
}

TEST_CASE("a cover does not depend on what the scratch was used for before") {
  const Lattice lattice(3, {{-9, -9, -9}, {9, 9, 9}}, 1.0, plenty);
  CoverScratch used;
  Cover a, b;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    for (const Shape& shape : shapes(3, random.in(0.5, 6.0))) {
      const Pose pose{{random.in(-5, 5), random.in(-5, 5), random.in(-5, 5)}, random.turn()};
      const PreparedShape prepared(shape);
      CoverScratch fresh;
      prepared.cover(lattice, pose, used, a);
      prepared.cover(lattice, pose, fresh, b);
      bool same = a.outside == b.outside && a.bricks.size() == b.bricks.size();
      for (std::size_t i = 0; same && i < a.bricks.size(); ++i) {
        same = a.bricks[i].brick == b.bricks[i].brick && a.bricks[i].touched == b.bricks[i].touched &&
               a.bricks[i].opaque == b.bricks[i].opaque;
      }
      INFO("seed ", seed, ", ", name_of(shape));
      CHECK(same);
    }
  }
}
