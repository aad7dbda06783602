// Range queries on a five-dimensional tree (Gotsman, Sudarsky, Fayman 1999, section 7).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/view_volume.h"
#include "gridcull/methods/five_d_code.h"

namespace gridcull {

/// The part of view space that a view may look along: a box about its viewpoint and a box of angles that holds its
/// view volume's. One range of angles, two where it runs over +x.
class ViewRange {
 public:
  /// `around`: half the viewpoint box's edge, metres, >= 0.
  ViewRange(const View& view, const ViewVolume& volume, int dimension, double around);

  std::span<const ViewCell> parts() const { return {parts_.data(), static_cast<std::size_t>(count_)}; }

 private:
  void set_turns(double from, double to);
  void look_flat(const View& view);
  void look_in_frustum(const View& view, const ViewVolume& volume);

  std::array<ViewCell, 2> parts_{};
  int count_ = 1;
};

/// Sets `members` (space.words() words) to the union of the sets of all leaves that the range overlaps; `nodes` grows
/// by the nodes visited. `stack` is overwritten.
void find_members(const FiveDTree& tree, const FiveDSpace& space, const ViewRange& range,
                  std::span<std::uint64_t> members, std::vector<std::uint32_t>& stack, std::uint64_t& nodes);

}  // namespace gridcull
