// A field's volume for the reference: where a ray's line runs inside it, by the cubic that the trilinear interpolant is
// along the line in each cell. Shares nothing with what the methods make of a volume (core/volume.h).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/exact_3d_solids.h"
#include "gridcull/core/scalar_field.h"
#include "gridcull/core/shape.h"

namespace gridcull::exact {

class RayVolume {
 public:
  RayVolume(const Volume& volume, const Pose& pose);

  /// Appends the stretches of the ray's line, ascending. Those that touch but for rounding are one.
  void add_stretches(const Vec3& eye, const Vec3& ray, std::vector<Stretch>& out) const;
  /// By the value at the point: inside by more than rounding could make of it.
  bool surely_inside(const Vec3& point) const;
  /// Some points of the lattice that are inside, world axes.
  const std::vector<Vec3>& inside_points() const { return inside_points_; }
  /// Holds the volume.
  const Bounds& world_box() const { return world_box_; }

 private:
  /// The ray in lattice coordinates, t in metres along it.
  struct Line {
    Vec3 from, along;
    Vec3 at(double t) const { return from + t * along; }
  };
  struct Window {
    double begin, end;
  };
  /// Of a block of points.
  enum class Side : std::uint8_t { outside, mixed, inside };
  using Corners = std::array<double, 8>;  ///< below 0 inside; by bits: 1 = +x, 2 = +y, 4 = +z

  double depth(double value) const { return below_ ? value - iso_ : iso_ - value; }
  void read_blocks();
  void take_in(const LatticePoint& first, const LatticePoint& last);
  void find_world_box(double magnitude);
  void find_inside_points();
  Vec3 to_lattice(const Vec3& direction) const;
  Side side_of_block(const LatticePoint& origin) const;
  Side side_of_brick(const LatticePoint& brick) const;
  Corners corners_of(const LatticePoint& cell) const;
  void add_brick(const Line& line, const Window& part, const LatticePoint& brick, std::vector<Stretch>& out) const;
  void add_cell(const Line& line, const Window& part, const LatticePoint& cell, std::vector<Stretch>& out) const;
  void add(const Stretch& stretch, std::vector<Stretch>& out) const;

  std::shared_ptr<const ScalarField> field_;
  double iso_;
  bool below_;
  Vec3 origin_;                      ///< world: of the lattice's point 0
  std::array<Vec3, 3> step_, rows_;  ///< world: a step along each axis of the lattice; and the inverse
  std::unordered_map<std::uint64_t, Side> blocks_;
  LatticePoint first_{0}, last_{-1};  ///< all inside points lie in between, inclusive
  std::vector<Vec3> inside_points_;
  Bounds world_box_;
  double blur_;  ///< metres: what rounding may do to a place
};

}  // namespace gridcull::exact
