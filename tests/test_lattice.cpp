// The lattice: metres and cells, bricks and bits, refusals.
#include <limits>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/grid/lattice.h"

using namespace gridcull;

namespace {

constexpr std::uint64_t plenty = std::uint64_t{4} << 30;

struct Refusal {
  ErrorCode code = ErrorCode::internal;
  std::string text;
};

Refusal refusal(int dimension, const Bounds& bounds, double cell, std::uint64_t memory) {
  try {
    Lattice(dimension, bounds, cell, memory);
  } catch (const Error& e) {
    return {e.code(), e.what()};
  }
  return {ErrorCode::internal, "accepted"};
}

double in(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
}

}  // namespace

TEST_CASE("a lattice has as many cells as cover the bounds, and at least one") {
  const Lattice a(2, {{0, 0, 0}, {10, 7.5, 0}}, 2.0, plenty);
  CHECK(a.cells() == Cell{5, 4, 1});
  CHECK(a.bricks() == Cell{1, 1, 1});
  CHECK(a.box().max == Vec3(10, 8, 0));
  const Lattice b(3, {{-5, -5, -5}, {4, 4.1, 8}}, 1.0, plenty);
  CHECK(b.cells() == Cell{9, 10, 13});
  CHECK(b.bricks() == Cell{3, 3, 4});
  CHECK(b.brick_count() == 36);
  CHECK(b.cell_count() == 1170);
  const Lattice point(3, {{1, 2, 3}, {1, 2, 3}}, 0.5, plenty);
  CHECK(point.cells() == Cell{1, 1, 1});
  CHECK(point.cell_of({1.2, 2.2, 3.2}) == Cell{0, 0, 0});
}

TEST_CASE("index() is the floor of boundary(), wherever the lattice lies") {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    std::mt19937_64 engine(seed);
    const double scale = std::pow(10.0, in(engine, -2, 8));
    const double cell = std::pow(10.0, in(engine, -2, 2));
    const Vec3 low(in(engine, -scale, scale), in(engine, -scale, scale), in(engine, -scale, scale));
    const Lattice lattice(3, {low, low + 9.0 * Vec3(cell)}, cell, plenty);
    INFO("seed ", seed);
    for (int i = 0; i < 20; ++i) {
      const int axis = i % 3;
      const std::int64_t k = static_cast<std::int64_t>(engine() % 40) - 20;
      const double edge = lattice.boundary(axis, k);
      for (const double x :
           {edge, std::nextafter(edge, -1e300), std::nextafter(edge, 1e300), edge + in(engine, -30, 30) * cell}) {
        const std::int64_t found = lattice.index(axis, x);
        CHECK(lattice.boundary(axis, found) <= x);
        CHECK(x < lattice.boundary(axis, found + 1));
      }
    }
  }
}

TEST_CASE("index() clamps beyond 2^40") {
  const Lattice lattice(2, {{0, 0, 0}, {4, 4, 0}}, 1e-3, plenty);
  CHECK(lattice.index(0, 1e300) == std::int64_t{1} << 40);
  CHECK(lattice.index(0, -1e300) == -(std::int64_t{1} << 40));
  CHECK(lattice.index(1, std::numeric_limits<double>::infinity()) == std::int64_t{1} << 40);
}

TEST_CASE("bricks, bits and cells go forth and back") {
  for (const int dimension : {2, 3}) {
    const Lattice lattice(dimension, {{0, 0, 0}, {13, 21, dimension == 3 ? 6.0 : 0.0}}, 1.0, plenty);
    const Cell n = lattice.cells();
    std::uint64_t cells = 0, bits = 0;
    for (std::int64_t z = 0; z < n.z; ++z) {
      for (std::int64_t y = 0; y < n.y; ++y) {
        for (std::int64_t x = 0; x < n.x; ++x) {
          const Cell c{x, y, z};
          const std::size_t brick = lattice.brick_of(c);
          const int bit = lattice.bit_of(c);
          const Cell low = lattice.brick_corner(brick);
          const int s = lattice.brick_shift(), e = lattice.brick_edge();
          CHECK(brick < lattice.brick_count());
          CHECK(lattice.brick_index({low.x >> s, low.y >> s, dimension == 3 ? low.z >> s : 0}) == brick);
          const Cell back{low.x + bit % e, low.y + bit / e % e, low.z + bit / (e * e)};
          CHECK(back == c);
          CHECK((lattice.brick_cells(brick) >> bit & 1) == 1);
          ++cells;
        }
      }
    }
    for (std::size_t b = 0; b < lattice.brick_count(); ++b) {
      for (std::uint64_t w = lattice.brick_cells(b); w != 0; w &= w - 1) ++bits;
    }
    CHECK(cells == lattice.cell_count());
    CHECK(bits == cells);
  }
}

TEST_CASE("the margin covers the rounding of boundaries and is far below a millimetre") {
  const Lattice town(2, {{0, 0, 0}, {5000, 3000, 0}}, 1.0, plenty);
  CHECK(town.margin() == 5000 * 0x1p-44);
  CHECK(town.margin(1e9) == 1e9 * 0x1p-44);
  CHECK(town.margin(1e9) < 1e-4);
  const Lattice far(2, {{-1e9, 0, 0}, {-1e9 + 100, 100, 0}}, 0.1, plenty);
  for (std::int64_t i = 0; i < 1000; ++i) {
    const long double exact = -1e9L + static_cast<long double>(i) * static_cast<long double>(0.1);
    CHECK(std::fabs(static_cast<double>(static_cast<long double>(far.boundary(0, i)) - exact)) < far.margin() / 100);
  }
}

TEST_CASE("bounds and cells that make no lattice are refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Bounds good{{0, 0, 0}, {10, 10, 10}};
  for (const double cell : {0.0, -1.0, nan, inf}) {
    CHECK(refusal(3, good, cell, plenty).code == ErrorCode::bad_scene);
    CHECK(refusal(3, good, cell, plenty).text.find("grid.cell") != std::string::npos);
  }
  const Bounds bad[] = {{},
                        {{0, 0, 0}, {inf, 1, 1}},
                        {{0, nan, 0}, {1, 1, 1}},
                        {{0, 0, 0}, {-1, 1, 1}},
                        {{0, 0, 0}, {1, -1, 1}},
                        {{0, 0, 0}, {1, 1, -1}},
                        {{-1e308, 0, 0}, {1e308, 1, 1}}};
  for (const Bounds& b : bad) CHECK(refusal(3, b, 1.0, plenty).code == ErrorCode::bad_scene);
}

TEST_CASE("a grid beyond the memory allowed is refused with a cell size that fits") {
  const auto proposed = [](const std::string& text) {
    const std::size_t at = text.find("a cell of ");
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + 10));
  };
  const Bounds cube{{0, 0, 0}, {1e4, 1e4, 1e4}};
  // Long and thin ones waste most bits of a brick; tiny budgets hold a few bricks.
  const Bounds thin{{0, 0, 0}, {1e9, 1, 1}};
  for (const Bounds& bounds : {cube, thin}) {
    for (const std::uint64_t memory : {std::uint64_t{200}, std::uint64_t{5000}, std::uint64_t{1} << 20, plenty}) {
      const Refusal r = refusal(3, bounds, 1e-2, memory);
      INFO(r.text);
      CHECK(r.code == ErrorCode::limit);
      const double cell = proposed(r.text);
      CHECK(cell > 1e-2);
      CHECK(refusal(3, bounds, cell, memory).text == "accepted");
      CHECK(refusal(3, bounds, cell / 2.6, memory).text != "accepted");
    }
  }
  CHECK(refusal(2, {{0, 0, 0}, {1e9, 1e9, 0}}, 1e-9, plenty).code == ErrorCode::limit);
  // Cells that the coordinates cannot tell apart.
  CHECK(refusal(2, {{1, 1, 0}, {1, 1, 0}}, 1e-30, plenty).code == ErrorCode::bad_scene);
  CHECK(refusal(2, {{0, 0, 0}, {1, 1, 0}}, 1.0, 47).code == ErrorCode::limit);
}

TEST_CASE("brick indices stay within 32 bits however much memory is allowed") {
  const std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
  CHECK(refusal(2, {{0, 0, 0}, {8.0 * 65536, 8.0 * 65536, 0}}, 1.0, all).code == ErrorCode::limit);
  const Lattice just(2, {{0, 0, 0}, {8.0 * 65535, 8.0 * 65536, 0}}, 1.0, all);
  CHECK(just.brick_count() == std::size_t{65535} * 65536);
}
