// Holds a cover against the truth of tests/cover_truth.h, cell by cell, over the whole lattice.
#pragma once

#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "cover_truth.h"
#include "gridcull/grid/cover.h"

namespace cover_check {

using namespace gridcull;

/// What one comparison found; empty() is right.
struct Findings {
  int missed = 0;        ///< the shape meets the cell, but it is not touched
  int loose = 0;         ///< touched, but farther than the tolerance
  int not_opaque = 0;    ///< inside by more than the tolerance, but not opaque
  int wrong_opaque = 0;  ///< opaque, but not inside
  int malformed = 0;     ///< bricks out of order, empty, or with bits outside the lattice; opaque not touched
  int touched = 0, opaque = 0;

  bool safe() const { return missed == 0 && wrong_opaque == 0 && malformed == 0; }
  bool tight() const { return loose == 0 && not_opaque == 0; }
  std::string text() const {
    return "missed " + std::to_string(missed) + ", loose " + std::to_string(loose) + ", wrongly opaque " +
           std::to_string(wrong_opaque) + ", not opaque " + std::to_string(not_opaque) + ", malformed " +
           std::to_string(malformed) + "; touched " + std::to_string(touched) + ", opaque " + std::to_string(opaque);
  }
};

inline cover_truth::Box box_of(const Lattice& lattice, const Cell& c) {
  const bool flat = lattice.dimension() == 2;
  return {{lattice.boundary(0, c.x), lattice.boundary(1, c.y), flat ? 0.0 : lattice.boundary(2, c.z)},
          {lattice.boundary(0, c.x + 1), lattice.boundary(1, c.y + 1), flat ? 0.0 : lattice.boundary(2, c.z + 1)}};
}

inline Findings compare(const Lattice& lattice, const Shape& shape, const Pose& pose, const Cover& cover,
                        double tolerance) {
  Findings f;
  std::vector<std::uint64_t> touched(lattice.brick_count()), opaque(lattice.brick_count());
  std::int64_t last = -1;
  for (const BrickCover& b : cover.bricks) {
    if (b.brick >= lattice.brick_count() || static_cast<std::int64_t>(b.brick) <= last || b.touched == 0 ||
        (b.touched & ~lattice.brick_cells(b.brick)) != 0 || (b.opaque & ~b.touched) != 0) {
      ++f.malformed;
      continue;
    }
    last = b.brick;
    touched[b.brick] = b.touched;
    opaque[b.brick] = b.opaque;
  }
  const cover_truth::Truth truth(shape, pose);
  const Cell n = lattice.cells();
  for (std::int64_t z = 0; z < n.z; ++z) {
    for (std::int64_t y = 0; y < n.y; ++y) {
      for (std::int64_t x = 0; x < n.x; ++x) {
        const Cell c{x, y, z};
        const bool t = touched[lattice.brick_of(c)] >> lattice.bit_of(c) & 1;
        const bool o = opaque[lattice.brick_of(c)] >> lattice.bit_of(c) & 1;
        f.touched += t;
        f.opaque += o;
        const cover_truth::Box box = box_of(lattice, c);
        const cover_truth::Verdict v = truth.judge(box);
        f.missed += v.touches && !t;
        f.wrong_opaque += o && !v.inside;
        if (!(t && !v.touches) && !(!o && v.inside)) continue;
        const cover_truth::Verdict wide = truth.judge(box.grown(tolerance));
        f.loose += t && !wide.touches;
        f.not_opaque += !o && wide.inside;
      }
    }
  }
  return f;
}

/// Whether the shape meets the space beyond the lattice, 10 km deep, its boundary moved outwards by `gap`.
inline bool reaches_beyond(const Lattice& lattice, const Shape& shape, const Pose& pose, double gap) {
  const cover_truth::Truth truth(shape, pose);
  const Bounds inner = lattice.box();
  const bool flat = lattice.dimension() == 2;
  const Vec3 deep(1e4, 1e4, flat ? 0.0 : 1e4);
  const cover_truth::Box outer{inner.min - deep, inner.max + deep};
  for (int k = 0; k < lattice.dimension(); ++k) {
    cover_truth::Box below = outer, above = outer;
    below.high[k] = inner.min[k] - gap;
    above.low[k] = inner.max[k] + gap;
    if (truth.judge(below).touches || truth.judge(above).touches) return true;
  }
  return false;
}

/// Random numbers by seed, the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }
  bool one_in(int n) { return below(n) == 0; }
  /// Often on a multiple of a quarter, where ties live.
  double coordinate(double low, double high) {
    const double v = in(low, high);
    return one_in(2) ? v : std::round(4.0 * v) / 4.0;
  }
  Quat turn() {
    if (one_in(4)) return Quat{};
    if (one_in(8)) return {0.0, 1.0, 0.0, 0.0};  // upside down
    if (one_in(3)) return turn_about_z(in(-4, 4));
    return normalised({in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1) + 1e-3});
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace cover_check
