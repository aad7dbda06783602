// Rays of the five-dimensional tree: cast from a cell at its members, kept, and handed on to the cell's parts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/methods/five_d_scene.h"

namespace gridcull {

/// One ray from a free point of a cell to a point of a member.
struct KeptRay {
  std::array<float, view_axes> at;  ///< its place in view space
  std::uint32_t member;
  bool hit;  ///< the member is the first that it meets
};

/// A cell that is being worked on, and what is known of it.
struct CellWork {
  ViewCell cell{};
  std::uint64_t seed = 0;       ///< of its random numbers: the tree does not depend on who works when
  std::uint32_t budget = 1;     ///< cells in position that it may become
  double share = 1.0;           ///< of the whole, for progress
  std::vector<KeptRay> rays{};  ///< by ascending member
};

/// Casts rays from one cell.
class CellRays {
 public:
  CellRays(const FiveDScene& scene, const ViewCell& cell, std::uint64_t seed, FiveDScene::Scratch& scratch);

  /// No free point was found: the cell lies inside occluders, or nearly so.
  bool solid() const { return origins_.empty(); }

  /// Which eighths of a turn, bit by bit, some line of sight from the cell to the member may take.
  unsigned eighths(std::uint32_t member) const;

  /// One line of sight to the member, not yet cast. False where it leaves the cell's angles.
  bool aim(std::uint32_t member, KeptRay& ray);
  /// Casts the ray that was aimed last.
  void cast(KeptRay& ray);

  std::uint64_t cast_count() const { return count_; }

 private:
  const FiveDScene& scene_;
  const ViewCell& cell_;
  FiveDScene::Scratch& scratch_;
  Random random_;
  bool turns_, rises_;  ///< whether the cell's angles are limited
  std::vector<Vec3> origins_{};
  std::size_t next_ = 0;
  Vec3 from_{0.0}, to_{0.0};
  std::uint64_t count_ = 0;
};

}  // namespace gridcull
