// A field of floats over a lattice of points: what a level set or a fog volume is, sparse.
//
// Between the lattice's points the field is their trilinear interpolant, outside what is stored it is the background
// everywhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/vec3.hpp>

#include "gridcull/core/pose.h"

namespace gridcull {

using LatticePoint = glm::ivec3;

/// 8 x 8 x 8 values from `origin` (a multiple of 8 in each axis) on; z runs fastest, x slowest.
struct FieldBlock {
  static constexpr int side = 8;
  LatticePoint origin{0};
  std::array<float, 512> values{};

  static std::size_t at(const LatticePoint& p) {
    return static_cast<std::size_t>((p.x & 7) << 6 | (p.y & 7) << 3 | (p.z & 7));
  }
};

/// One value for `side`^3 points from `origin` (a multiple of `side`) on; `side` is 8 times a power of two.
struct FieldTile {
  LatticePoint origin{0};
  int side = FieldBlock::side;
  float value = 0.0f;
};

/// Where a field's lattice lies: point p is at to_world(pose, rotation_of(pose.orientation), voxel * p), in an
/// object's local coordinates, metres.
struct FieldFrame {
  double voxel = 1.0;  ///< > 0
  Pose pose{};
};

class ScalarField {
 public:
  /// Greatest magnitude of a stored point's coordinates.
  static constexpr int greatest_index = 1 << 22;

  /// Throws Error(bad_scene) when a value is not finite, the voxel is not positive or above 1e9, the frame is not
  /// finite, an origin is out of line or above greatest_index, or two blocks or tiles overlap.
  ScalarField(const FieldFrame& frame, float background, std::vector<FieldBlock> blocks,
              std::vector<FieldTile> tiles = {});

  /// The same in other units: distances times `scale` (> 0).
  ScalarField scaled(double scale) &&;

  const FieldFrame& frame() const { return frame_; }
  float background() const { return background_; }
  /// Ascending by origin (x first), whatever the order they came in.
  const std::vector<FieldBlock>& blocks() const { return blocks_; }
  /// Ascending by side, then by origin.
  const std::vector<FieldTile>& tiles() const { return tiles_; }

  /// The value at a lattice point: its block's or its tile's, else the background.
  float at(const LatticePoint& p) const;

  /// Bytes that a field of so many blocks and tiles takes, about.
  static std::uint64_t memory_of(std::uint64_t blocks, std::uint64_t tiles);

 private:
  using Slots = std::unordered_map<std::uint64_t, std::uint32_t>;
  struct Level {
    int shift;  ///< the tiles' side is 1 << shift
    Slots slots;
  };

  void index_blocks();
  void index_tiles();
  void take_in(const LatticePoint& origin, int side);

  FieldFrame frame_;
  float background_;
  std::vector<FieldBlock> blocks_;
  std::vector<FieldTile> tiles_;
  Slots block_slots_;
  std::vector<Level> levels_;
  LatticePoint first_{0}, last_{-1};  ///< all that is stored, both ends inclusive
};

}  // namespace gridcull
