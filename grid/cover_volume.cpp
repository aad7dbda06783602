// Volumes in cells: a box about each cell in the volume's own lattice, which may be finer, coarser or turned.
//
// Claim. A closed cell grown by the margin lies in the box that is compared: the map into the lattice is affine, so the
// box about the images of a cell's corners has half edges |row| . half; its rounding is less than the margin moved
// (LatticeMap::magnitude() is part of what the margin is taken of). The lattice points from the box's floor to one
// above its upper floor are the corners of all lattice cells that it meets. Where all of them are inside, so is the
// cell (opaque); where none is, no point of the volume is in it (not touched).
// Where it is neither, and meets few lattice cells, those are looked at more closely: the interpolant in a part of one
// that is a box along its axes is that of the part's own corners, and lies between their values. A value is a sum of
// eight products, off by less than 2^-48 of the greatest difference: only what is clearer than that is believed.
//
// A turned cell's box is up to 3^(3/2) times as large as the cell: there 2^3 to 4^3 parts of the cell are looked at one
// by one.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "gridcull/core/volume.h"
#include "gridcull/core/world_points.h"
#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_kernels.h"

namespace gridcull::covering {
namespace {

struct Part {
  bool touched, opaque;
};

class VolumeCells {
 public:
  VolumeCells(const Lattice& lattice, const Volume& volume, const Pose& pose, const Bounds& bounds)
      : lattice_(lattice), volume_(volume), points_(*volume.body->points), map_(volume.field->frame(), pose) {
    margin_ = lattice.margin(std::max(magnitude_of(bounds), map_.magnitude()));
    const Vec3 half = map_.half_in_lattice(Vec3(0.5 * lattice.cell()));
    const double across = lattice.cell() / volume.field->frame().voxel;
    const bool turned = half.x + half.y + half.z > 1.5 * across * (1.0 + 1e-9);
    if (turned) cuts_ = static_cast<int>(std::clamp(std::ceil(across), 2.0, 4.0));
  }

  double margin() const { return margin_; }
  /// A cube of cells `first` .. `first + count - 1` along each axis.
  Part cube(const Cell& first, int count) const { return part(centre_of(first, count), 0.5 * count * lattice_.cell()); }
  Part cell(const Cell& c) const {
    const Part whole = cube(c, 1);
    if (!whole.touched || whole.opaque || cuts_ == 1) return whole;
    const double half = 0.5 * lattice_.cell() / cuts_;
    const Vec3 low = centre_of(c, 1) - Vec3((cuts_ - 1) * half);
    Part sum{false, true};
    for (int i = 0; i < cuts_ * cuts_ * cuts_; ++i) {
      const Vec3 step(i % cuts_, i / cuts_ % cuts_, i / cuts_ / cuts_);
      const Part one = part(low + 2.0 * half * step, half);
      sum = {sum.touched || one.touched, sum.opaque && one.opaque};
    }
    return sum;
  }

 private:
  Vec3 centre_of(const Cell& first, int count) const {
    const auto middle = [&](int axis, std::int64_t i) {
      return 0.5 * (lattice_.boundary(axis, i) + lattice_.boundary(axis, i + count));
    };
    return {middle(0, first.x), middle(1, first.y), middle(2, first.z)};
  }
  Part part(const Vec3& centre, double half) const {
    // No inside point is farther out than this.
    constexpr double far = 2.0 * ScalarField::greatest_index;
    const Vec3 c = map_.to_lattice(centre), h = map_.half_in_lattice(Vec3(half + margin_));
    const Vec3 low = glm::clamp(c - h, -far, far), high = glm::clamp(c + h, -far, far);
    const LatticeBox box{LatticePoint(glm::floor(low)), LatticePoint(glm::floor(high)) + LatticePoint(1)};
    if (!points_.any(box)) return {false, false};
    if (points_.all(box)) return {true, true};
    return is_few(box) ? closer(low, high, box) : Part{true, false};
  }
  static bool is_few(const LatticeBox& box) {
    const LatticePoint cells = box.last - box.first;
    return cells.x <= 3 && cells.y <= 3 && cells.z <= 3;
  }
  /// The box low .. high by the lattice cells that it meets.
  Part closer(const Vec3& low, const Vec3& high, const LatticeBox& box) const {
    Part sum{false, true};
    LatticePoint c;
    for (c.x = box.first.x; c.x < box.last.x; ++c.x) {
      for (c.y = box.first.y; c.y < box.last.y; ++c.y) {
        for (c.z = box.first.z; c.z < box.last.z; ++c.z) {
          const Part one = in_cell(c, glm::clamp(low - Vec3(c), 0.0, 1.0), glm::clamp(high - Vec3(c), 0.0, 1.0));
          sum = {sum.touched || one.touched, sum.opaque && one.opaque};
        }
      }
    }
    return sum;
  }
  /// The part from .. to (0 .. 1) of a lattice cell.
  Part in_cell(const LatticePoint& cell, const Vec3& from, const Vec3& to) const {
    std::array<double, 8> depths;
    double greatest = 0.0;
    for (int i = 0; i < 8; ++i) {
      const double value = volume_.field->at(cell + LatticePoint(i & 1, i >> 1 & 1, i >> 2 & 1));
      const double depth = volume_.inside_below ? value - volume_.iso : volume_.iso - value;
      depths[static_cast<std::size_t>(i)] = depth;
      greatest = std::max(greatest, std::fabs(depth));
    }
    if (std::none_of(depths.begin(), depths.end(), [](double d) { return d < 0.0; })) return {false, false};
    const double blur = 0x1p-48 * greatest;
    Part sum{false, true};
    for (int i = 0; i < 8; ++i) {
      const Vec3 at((i & 1) ? to.x : from.x, (i & 2) ? to.y : from.y, (i & 4) ? to.z : from.z);
      double depth = 0.0;
      for (int k = 0; k < 8; ++k) {
        depth += ((k & 1) ? at.x : 1.0 - at.x) * ((k & 2) ? at.y : 1.0 - at.y) * ((k & 4) ? at.z : 1.0 - at.z) *
                 depths[static_cast<std::size_t>(k)];
      }
      sum = {sum.touched || depth <= blur, sum.opaque && depth < -blur};
    }
    return sum;
  }

  const Lattice& lattice_;
  const Volume& volume_;
  const InsidePoints& points_;
  LatticeMap map_;
  double margin_;
  int cuts_ = 1;
};

/// The brick's cells that lie in the ranges.
BrickCover cover_brick(const Lattice& lattice, const VolumeCells& cells, const Cell& brick, const Range& x,
                       const Range& y, const Range& z) {
  constexpr int edge = 1 << Lattice::brick_shift_3d;
  const Cell first{brick.x * edge, brick.y * edge, brick.z * edge};
  BrickCover out{static_cast<std::uint32_t>(lattice.brick_index(brick)), 0, 0};
  const Part whole = cells.cube(first, edge);
  if (!whole.touched) return out;
  Cell c;
  for (c.z = std::max(first.z, z.first); c.z <= std::min(first.z + edge - 1, z.last); ++c.z) {
    for (c.y = std::max(first.y, y.first); c.y <= std::min(first.y + edge - 1, y.last); ++c.y) {
      for (c.x = std::max(first.x, x.first); c.x <= std::min(first.x + edge - 1, x.last); ++c.x) {
        const Part part = whole.opaque ? whole : cells.cell(c);
        const std::uint64_t bit = std::uint64_t{1} << lattice.bit_of(c);
        if (part.touched) out.touched |= bit;
        if (part.opaque) out.opaque |= bit;
      }
    }
  }
  return out;
}

}  // namespace

void volume(const Lattice& lattice, const Volume& shape, const Pose& pose, Cover& out) {
  Bounds bounds;
  for_each_world_point(shape, pose, [&](const Vec3& p) { bounds.add(p); });
  const VolumeCells cells(lattice, shape, pose, bounds);
  const auto touched = [&](int axis) {
    const double margin = cells.margin();
    return Axis(lattice, axis).touched(bounds.min[axis] - margin, bounds.max[axis] + margin, out.outside);
  };
  const Range x = touched(0), y = touched(1), z = touched(2);
  if (x.empty() || y.empty() || z.empty()) return;
  constexpr int shift = Lattice::brick_shift_3d;
  Cell brick;
  for (brick.z = z.first >> shift; brick.z <= z.last >> shift; ++brick.z) {
    for (brick.y = y.first >> shift; brick.y <= y.last >> shift; ++brick.y) {
      for (brick.x = x.first >> shift; brick.x <= x.last >> shift; ++brick.x) {
        const BrickCover cover = cover_brick(lattice, cells, brick, x, y, z);
        if (cover.touched != 0) out.bricks.push_back(cover);
      }
    }
  }
}

}  // namespace gridcull::covering
