// Volumes: where a field of floats is below or above a value.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "gridcull/core/pose.h"
#include "gridcull/core/shape.h"
#include "gridcull/core/volume_body.h"

namespace gridcull {

/// A volume with its body. Throws Error(bad_scene) when iso is not finite, nothing is inside, the background is (the
/// volume would have no end), or a coordinate's magnitude would be above 1e9.
Volume make_volume(std::shared_ptr<const ScalarField> field, double iso, bool inside_below);

/// Which points of a field's lattice are inside. Between eight neighbours the trilinear interpolant lies within their
/// values: a closed cell with eight inside ones lies in the interior, one with none has no point of the volume.
class InsidePoints {
 public:
  /// The background is outside.
  InsidePoints(const ScalarField& field, double iso, bool inside_below);

  /// All inside points lie in it; empty without any.
  const LatticeBox& bounds() const { return bounds_; }
  bool holds(const LatticePoint& p) const;
  /// Whether one of the box's points is inside; all of them. The box is not empty, and within an int of the origin.
  bool any(const LatticeBox& box) const;
  bool all(const LatticeBox& box) const;
  /// Calls f(block's origin, bits) for every block of 8 points an edge with an inside one, in no order: bits[x] has
  /// bit 8 y + z. Blocks within larger tiles are left out; for those f_tile(LatticeBox).
  template <class F, class G>
  void for_each_block(F&& f, G&& f_tile) const;

  std::uint64_t bytes() const;

 private:
  using Bits = std::array<std::uint64_t, 8>;
  struct Level {
    int shift;
    std::unordered_map<std::uint64_t, LatticePoint> tiles;  ///< wholly inside, by key, with their origins
  };

  bool all_below(const LatticeBox& box, std::size_t levels) const;
  bool all_in_blocks(const LatticeBox& box) const;
  bool any_tile(const LatticeBox& box) const;
  void take_in(const LatticeBox& box);

  std::unordered_map<std::uint64_t, std::uint32_t> slots_;  ///< of blocks with an inside point
  std::vector<LatticePoint> origins_;
  std::vector<Bits> bits_;
  std::vector<Level> levels_;  ///< tiles larger than a block, by size
  LatticeBox bounds_;
};

template <class F, class G>
void InsidePoints::for_each_block(F&& f, G&& f_tile) const {
  for (std::size_t i = 0; i < bits_.size(); ++i) f(origins_[i], bits_[i]);
  for (const Level& level : levels_) {
    for (const auto& [key, origin] : level.tiles)
      f_tile(LatticeBox{origin, origin + LatticePoint((1 << level.shift) - 1)});
  }
}

/// Between world points and lattice coordinates (a point of the lattice has whole ones) for a volume at a pose: the
/// world point of lattice coordinates q is to_world(pose, to_world(frame.pose, voxel * q)), the volume's truth.
class LatticeMap {
 public:
  LatticeMap(const FieldFrame& frame, const Pose& pose);

  Vec3 to_lattice(const Vec3& world) const {
    const Vec3 d = world - origin_;
    return {glm::dot(rows_[0], d), glm::dot(rows_[1], d), glm::dot(rows_[2], d)};
  }
  Vec3 to_world(const Vec3& lattice) const {
    return origin_ + lattice.x * columns_[0] + lattice.y * columns_[1] + lattice.z * columns_[2];
  }
  /// Half the edges of the lattice-aligned box about a world-aligned one with these half edges.
  Vec3 half_in_lattice(const Vec3& half) const;
  /// Greatest magnitude that a coordinate has on the way, metres: each is good to some 2^-49 of it.
  double magnitude() const { return magnitude_; }

 private:
  Vec3 origin_;
  std::array<Vec3, 3> columns_, rows_;
  double magnitude_;
};

/// The field at a point, less iso, turned round where inside is above: below 0 inside, exactly so in a cell whose
/// corners are all inside, and not below 0 where none is.
double depth_at(const Volume& volume, const Vec3& lattice);

/// Bytes on the heap, of which objects of one shape may share some.
std::uint64_t bytes_of(const Volume& volume);

/// A box of lattice cells in the object's local axes, its corners by bits (1: +x, 2: +y, 4: +z of the lattice), pulled
/// in so that rounding leaves them inside the box.
std::array<Vec3, 8> inner_corners(const Volume& volume, const LatticeBox& box);

}  // namespace gridcull
