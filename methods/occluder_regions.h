// Occluders that promise something from a region of space: the preprocess of Hudson et al. 1997, section 4.1.
//
// The static objects' box is divided uniformly. A region lists the static parts that cover more than a threshold from
// somewhere in it: from within a sphere about a solid part, from within the two lobes of a flat one (the paper's
// ellipsoid), and of these the most_parts that may cover most. The share of the static world that each hides is then
// sampled: a few viewpoints in the region, a shadow frustum from each, the objects wholly in it counted in the
// hierarchy. Changed: a region is worked out when a viewer is first in it, not all of them in advance, so that only
// what is visited costs; its viewpoints depend on the region only, so the result does not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/methods/shadow_frustum.h"
#include "gridcull/methods/shadow_world.h"

namespace gridcull {

class OccluderRegions {
 public:
  static constexpr std::size_t most_parts = 64;
  static constexpr int samples = 4;
  static constexpr int most_along_an_axis = 32;

  struct Promise {
    std::uint32_t entry = 0;  ///< of the world's static entries
    double hidden = 0.0;      ///< share of the static objects hidden, mean of the samples; 0 .. 1
  };

  /// Forgets everything when static objects have changed. Call once a frame.
  void begin_frame(const ShadowWorld& world);

  /// What promises something at the viewpoint, by entry. Outside the static objects' box nothing is known: nullptr.
  const std::vector<Promise>* at(const ShadowWorld& world, const Vec3& eye);

  /// Regions worked out so far, and parts in their lists.
  std::size_t region_count() const { return worked_out_; }

 private:
  struct Region {
    bool known = false;
    std::vector<Promise> promises{};
  };

  void work_out(const ShadowWorld& world, std::size_t number, const Bounds& box);
  double sampled(const ShadowWorld& world, const PartEntry& entry, std::span<const Vec3> viewpoints);

  Bounds box_{};
  int cells_[3] = {1, 1, 1};
  std::vector<Region> regions_{};
  std::size_t worked_out_ = 0;
  std::uint64_t static_version_ = 0;
  ShadowFrustum frustum_{};
};

/// Greatest area-angle that any viewpoint in the box may see the part under, roughly. Infinite where the part may be
/// at hand.
double greatest_area_angle(const ShadowWorld& world, const PartEntry& entry, const Bounds& box);

/// Objects of the tree that lie wholly in the frustum, by their boxes.
std::uint64_t count_hidden(const BoxTree& tree, std::span<const Bounds> boxes, const ShadowFrustum& frustum,
                           const Vec3& eye);

}  // namespace gridcull
