// The polyhedron about a volume: the k-DOP with k = 26 in lattice axes (core/slabs.h) about the parts of cells that may
// be inside.
//
// Claim. In a cell let m0 and m1 be the least of the four depths at its lower and upper end along an axis (depth: below
// 0 inside). The interpolant at x of the way along is at least (1 - x) m0 + x m1, so where only m0 is below 0 the
// inside has x < m0 / (m0 - m1), and where only m1 is, x > m0 / (m0 - m1). The box that these leave of each axis holds
// the cell's part of the volume. Cells without an inside corner hold nothing of it, those with eight are never the
// last along a direction: the next one has inside corners too.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gridcull/core/bounds.h"
#include "gridcull/core/slabs.h"
#include "gridcull/core/volume_parts.h"

namespace gridcull {
namespace {

using Depths = std::array<double, 8>;  ///< of a cell's corners by bits: 1 = +x, 2 = +y, 4 = +z

/// The part of a unit cell that may be inside. At least one corner is.
Bounds inside_part(const Depths& g) {
  Bounds part{Vec3(0.0), Vec3(1.0)};
  for (int k = 0; k < 3; ++k) {
    double m0 = std::numeric_limits<double>::infinity(), m1 = m0;
    for (unsigned i = 0; i < 8; ++i) {
      double& side = (i >> k & 1) != 0 ? m1 : m0;
      side = std::min(side, g[i]);
    }
    if (m0 < 0.0 && m1 < 0.0) continue;
    const double x = m0 / (m0 - m1);
    (m0 < 0.0 ? part.max : part.min)[k] = std::clamp(x, 0.0, 1.0);
  }
  return part;
}

/// Collects intervals along slab_directions, about a middle.
class Intervals {
 public:
  explicit Intervals(const LatticePoint& middle) : middle_(middle) {
    slabs_.kind = BoundKind::dop26;
    slabs_.low.fill(std::numeric_limits<double>::infinity());
    slabs_.high.fill(-std::numeric_limits<double>::infinity());
  }

  /// Lattice coordinates.
  void add(const Bounds& box) {
    const Vec3 low = box.min - Vec3(middle_), high = box.max - Vec3(middle_);
    for (std::size_t j = 0; j < slab_directions.size(); ++j) {
      const auto [from, to] = along(j, low, high);
      slabs_.low[j] = std::min(slabs_.low[j], from);
      slabs_.high[j] = std::max(slabs_.high[j], to);
    }
    for (const Vec3& p : {low, high}) {
      slabs_.size = std::max(slabs_.size, 2.0 * (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z)));
    }
  }
  bool hold(const Bounds& box) const {
    const Vec3 low = box.min - Vec3(middle_), high = box.max - Vec3(middle_);
    for (std::size_t j = 0; j < slab_directions.size(); ++j) {
      const auto [from, to] = along(j, low, high);
      if (from < slabs_.low[j] || to > slabs_.high[j]) return false;
    }
    return true;
  }
  const Slabs& slabs() const { return slabs_; }

 private:
  static std::pair<double, double> along(std::size_t direction, const Vec3& low, const Vec3& high) {
    const SlabDirection& d = slab_directions[direction];
    double from = 0.0, to = 0.0;
    const std::array<int, 3> parts{d.x, d.y, d.z};
    for (int k = 0; k < 3; ++k) {
      const int part = parts[static_cast<std::size_t>(k)];
      if (part == 0) continue;
      from += part > 0 ? low[k] : -high[k];
      to += part > 0 ? high[k] : -low[k];
    }
    return {from, to};
  }

  LatticePoint middle_;
  Slabs slabs_;
};

/// Depths of the points about a block of 8 and one more on every side.
class Neighbourhood {
 public:
  Neighbourhood(const Volume& volume, const LatticePoint& block) : first_(block - LatticePoint(1)) {
    std::size_t i = 0;
    LatticePoint p;
    for (p.x = 0; p.x < edge; ++p.x) {
      for (p.y = 0; p.y < edge; ++p.y) {
        for (p.z = 0; p.z < edge; ++p.z) {
          const double value = volume.field->at(first_ + p);
          depths_[i++] = volume.inside_below ? value - volume.iso : volume.iso - value;
        }
      }
    }
  }

  /// Calls f(part of the cell that may be inside) for the 9^3 cells about the block that have an inside corner and an
  /// outside one.
  template <class F>
  void for_each_part(F&& f) const {
    LatticePoint c;
    for (c.x = 0; c.x + 1 < edge; ++c.x) {
      for (c.y = 0; c.y + 1 < edge; ++c.y) {
        for (c.z = 0; c.z + 1 < edge; ++c.z) {
          const Depths g = corners(c);
          const auto inside = std::count_if(g.begin(), g.end(), [](double d) { return d < 0.0; });
          if (inside == 0 || inside == 8) continue;
          const Bounds part = inside_part(g);
          const Vec3 base(first_ + c);
          f(Bounds{base + part.min, base + part.max});
        }
      }
    }
  }

 private:
  static constexpr int edge = 10;

  Depths corners(const LatticePoint& c) const {
    Depths g;
    for (int i = 0; i < 8; ++i) {
      const int x = c.x + (i & 1), y = c.y + (i >> 1 & 1), z = c.z + (i >> 2 & 1);
      g[static_cast<std::size_t>(i)] = depths_[static_cast<std::size_t>((x * edge + y) * edge + z)];
    }
    return g;
  }

  LatticePoint first_;
  std::array<double, 1000> depths_;
};

}  // namespace

double rounding_in_lattice(const ScalarField& field, const LatticeBox& box) {
  const Vec3& p = field.frame().pose.position;
  double sum = (std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z)) / field.frame().voxel;
  for (int k = 0; k < 3; ++k) sum += std::max(std::abs(box.first[k]), std::abs(box.last[k])) + 1.0;
  return 0x1p-46 * sum;
}

// Rounding: the slabs are grown by 2^6 times what it may be, and slab_boundary() pays for its own.
std::vector<Vec3> corners_about(const Volume& volume) {
  const InsidePoints& points = *volume.body->points;
  const LatticeBox all = points.bounds();
  const LatticePoint middle = all.first + (all.last - all.first) / 2;
  Intervals held(middle);
  const auto add_tile = [&](const LatticeBox& tile) { held.add({Vec3(tile.first) - 1.0, Vec3(tile.last) + 1.0}); };
  // First what lies inside for certain: blocks that cannot reach beyond it are then passed over.
  points.for_each_block(
      [&](const LatticePoint& origin, const std::array<std::uint64_t, 8>& bits) {
        for (int i = 0; i < 512; ++i) {
          if ((bits[static_cast<std::size_t>(i >> 6)] >> (i & 63) & 1) == 0) continue;
          const Vec3 p(origin + LatticePoint(i >> 6, i >> 3 & 7, i & 7));
          held.add({p, p});
        }
      },
      add_tile);
  points.for_each_block(
      [&](const LatticePoint& origin, const auto&) {
        if (held.hold({Vec3(origin) - 1.0, Vec3(origin) + 8.0})) return;
        Neighbourhood(volume, origin).for_each_part([&](const Bounds& part) { held.add(part); });
      },
      [](const LatticeBox&) {});
  ConvexBoundary boundary;
  slab_boundary(held.slabs(), 64.0 * rounding_in_lattice(*volume.field, all), boundary);
  const FieldFrame& frame = volume.field->frame();
  const Rotation r = rotation_of(frame.pose.orientation);
  std::vector<Vec3> out;
  for (const Vec3& v : boundary.vertices) out.push_back(to_world(frame.pose, r, frame.voxel * (Vec3(middle) + v)));
  return out;
}

}  // namespace gridcull
