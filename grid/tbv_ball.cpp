#include "gridcull/grid/tbv_ball.h"

#include <array>
#include <bit>
#include <limits>

namespace gridcull {
namespace {

/// The cells of a brick that `bits` (not 0) touches along each axis, as bits 0 .. edge - 1.
std::array<unsigned, 3> shadows(std::uint64_t bits, bool solid) {
  // Rows folded on one another; then the rows that hold anything, one bit each, folded likewise.
  std::uint64_t x = bits | bits >> 32, rows = bits;
  x |= x >> 16;
  x |= x >> 8;
  if (!solid) {
    for (const int step : {4, 2, 1}) rows |= rows >> step;
    // Bits 0, 8, 16, ... to the top byte: the products land on distinct bits.
    const std::uint64_t y = ((rows & 0x0101'0101'0101'0101ull) * 0x0102'0408'1020'4080ull) >> 56;
    return {static_cast<unsigned>(x & 0xFF), static_cast<unsigned>(y), 1};
  }
  x |= x >> 4;
  rows |= rows >> 2;
  rows = (rows | rows >> 1) & 0x1111'1111'1111'1111ull;
  std::uint64_t y = rows | rows >> 32;
  y |= y >> 16;
  const auto four = [](std::uint64_t v) { return static_cast<unsigned>((v & 0x1111u) * 0x1248u >> 12 & 0xFu); };
  unsigned z = 0;
  for (int layer = 0; layer < 4; ++layer) z |= ((rows >> (16 * layer) & 0xFFFFu) != 0 ? 1u : 0u) << layer;
  return {static_cast<unsigned>(x & 0xF), four(y), z};
}

}  // namespace

BrickCells::BrickCells(const Lattice& lattice, std::size_t brick, std::uint64_t bits)
    : lattice_(lattice),
      bits_(bits),
      corner_(lattice.brick_corner(brick)),
      low_(-std::numeric_limits<double>::infinity()),
      high_(std::numeric_limits<double>::infinity()) {
  // Twice the margin of the ball test, so that the filter never says no to what that would find.
  const std::array<unsigned, 3> along = shadows(bits, lattice.dimension() == 3);
  const std::array<std::int64_t, 3> first{corner_.x, corner_.y, corner_.z};
  for (int k = 0; k < lattice.dimension(); ++k) {
    const auto axis = static_cast<std::size_t>(k);
    low_[k] = lattice.boundary(k, first[axis] + std::countr_zero(along[axis])) - 2.0 * lattice.margin();
    high_[k] = lattice.boundary(k, first[axis] + std::bit_width(along[axis])) + 2.0 * lattice.margin();
  }
}

bool BrickCells::touch(const TbvBall& ball) const {
  const auto edge = static_cast<std::size_t>(lattice_.brick_edge());
  const double r = ball.radius + lattice_.margin();
  const std::array<std::int64_t, 3> first{corner_.x, corner_.y, corner_.z};
  // Squared distance of the centre to cell i along an axis.
  const auto square = [&](int axis, std::size_t i) {
    const std::int64_t at = first[static_cast<std::size_t>(axis)] + static_cast<std::int64_t>(i);
    const double c = ball.centre[axis];
    const double gap = std::max({lattice_.boundary(axis, at) - c, c - lattice_.boundary(axis, at + 1), 0.0});
    return gap * gap;
  };
  std::array<double, 8> squares_x{}, squares_y{};
  for (std::size_t i = 0; i < edge; ++i) squares_x[i] = square(0, i), squares_y[i] = square(1, i);
  const std::size_t layers = lattice_.dimension() == 3 ? edge : 1;
  const std::uint64_t row_mask = (std::uint64_t{1} << edge) - 1;
  for (std::size_t z = 0; z < layers; ++z) {
    const double rest = r * r - (layers > 1 ? square(2, z) : 0.0);
    for (std::size_t y = 0; y < edge; ++y) {
      const std::uint64_t row = (bits_ >> ((z * edge + y) * edge)) & row_mask;
      if (row == 0) continue;
      std::uint64_t met = 0;
      for (std::size_t x = 0; x < edge; ++x) met |= std::uint64_t{squares_x[x] <= rest - squares_y[y]} << x;
      if ((met & row) != 0) return true;
    }
  }
  return false;
}

}  // namespace gridcull
