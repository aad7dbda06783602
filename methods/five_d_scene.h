// The static world as the five-dimensional tree's rays meet it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/random.h"
#include "gridcull/methods/bucket_grid.h"
#include "gridcull/methods/five_d_options.h"
#include "gridcull/methods/five_d_space.h"
#include "gridcull/methods/flat_world.h"
#include "gridcull/methods/surface_points.h"

namespace gridcull {

/// What rays are cast at: the static objects by ascending id, then the motion boxes. Only static occluders block.
class FiveDScene {
 public:
  /// `bounds`: of the world. Moving objects among `objects` tell at what heights motion boxes are wanted.
  FiveDScene(std::span<const Object> objects, int dimension, const Bounds& bounds, const FiveDOptions& options);

  const FiveDSpace& space() const { return space_; }
  std::uint32_t members() const { return space_.members(); }
  /// World box of a member.
  const Bounds& box(std::uint32_t member) const { return boxes_[member]; }

  /// What one thread needs.
  struct Scratch {
    std::vector<std::uint32_t> near{}, holders{};
    std::vector<double> cuts{};
    std::uint32_t last = nobody;  ///< the occluder that blocked last
    std::uint64_t buckets = 0;
  };
  static constexpr std::uint32_t nobody = 0xFFFF'FFFFu;

  /// Whether no static occluder's interior holds the point.
  bool is_free(const Vec3& point, Scratch& scratch) const;
  /// A point of the member's surface, or anywhere within a motion box.
  Vec3 target(std::uint32_t member, Random& random) const;
  /// Whether a static occluder other than `member` blocks the open segment.
  bool blocked(const Vec3& from, const Vec3& to, std::uint32_t member, Scratch& scratch) const;

 private:
  void place_boxes(const Bounds& world, const Bounds& heights, int wanted);
  bool blocks(std::uint32_t i, const Vec3& from, const Vec3& along, Scratch& scratch) const;

  FlatWorld world_;
  FiveDSpace space_{};
  std::vector<Bounds> boxes_{};
  std::vector<SurfacePoints> surfaces_{};
  BucketGrid grid_{};
};

}  // namespace gridcull
