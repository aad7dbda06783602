// The matrix T of hollow temporal bounding volumes (Batagelo and Wu 2002, sections 4.1 and 5.2): circles of
// cells in 2D; in 3D the faces of cubes, kept as outlines in the three projected matrices T_xy, T_xz, T_yz.
//
// Claim: an object behind an outline that no viewer has crossed is found in time. While the viewer's cell lies
// outside the outline, a line of sight to the object passes an outline cell (outline_cells.h); that cell
// holds a visible point, so it is in view, never hidden, hence visited, and the volume is revealed. A viewer
// whose path is 8-connected cannot get inside without standing in an outline cell in some frame, and its own
// cell is always visited, which reveals the volume to everybody but a viewer that rides on that very object. Viewers
// that jump, are new, or ride on another object than before are checked against every outline.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/grid/mask_lists.h"
#include "gridcull/grid/outline_cells.h"
#include "gridcull/grid/tbv_matrix.h"

namespace gridcull {

class HollowTbv {
 public:
  explicit HollowTbv(const Lattice& lattice);

  void reserve(std::size_t slots);

  /// Enters the outline around the ball; false (and nothing happens) when it does not lie wholly in the
  /// lattice or one of `viewers` is inside or on it.
  bool insert(Slot slot, const TbvMatrix::Ball& ball, std::span<const Cell> viewers);
  void erase(Slot slot);
  std::uint64_t size() const { return members_.size(); }

  /// Appends the slots whose outline has one of `viewers` inside or on it.
  void enclosing(std::span<const Cell> viewers, std::vector<Slot>& out) const;

  bool may_touch(std::size_t brick) const;

  /// Calls f(slot) for every outline with one of the cells `bits` of the brick and for which wanted(slot).
  /// Returns the number of outlines looked at.
  template <class W, class F>
  std::uint64_t touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f) const;

  std::uint64_t matrix_bytes() const;
  std::uint64_t entry_bytes() const;

 private:
  struct Member {
    Slot slot;
    CircleOutline circle;  // 2D
    CubeCells cube;        // 3D
  };
  bool encloses(const Member& member, const Cell& cell) const;
  /// Whether the cube and the brick whose lowest cell is `corner` have a cell in common.
  static bool reaches(const CubeCells& cube, const Cell& corner) {
    return cube.low.x <= corner.x + 3 && cube.high.x >= corner.x && cube.low.y <= corner.y + 3 &&
           cube.high.y >= corner.y && cube.low.z <= corner.z + 3 && cube.high.z >= corner.z;
  }
  bool enter_circle(const Member& member);
  bool enter_cube(const Member& member);
  std::array<std::uint32_t, 3> planar_bricks(std::size_t brick) const;

  const Lattice& lattice_;
  std::vector<MaskLists> lists_;  // 2D: one over the bricks; 3D: T_xy, T_xz, T_yz
  std::vector<Member> members_;
  std::vector<std::uint32_t> places_;  // per slot: its place in members_
  Cover circle_cells_;
  CubeOutline cube_outline_;
};

template <class W, class F>
std::uint64_t HollowTbv::touching(std::size_t brick, std::uint64_t bits, W&& wanted, F&& f) const {
  std::uint64_t looked = 0;
  if (lattice_.dimension() == 2) {
    const MaskLists& list = lists_[0];
    for (std::uint32_t i = list.first(brick); i != none; i = list.entry(i).after) {
      ++looked;
      if ((list.entry(i).bits & bits) != 0 && wanted(list.entry(i).slot)) f(list.entry(i).slot);
    }
    return looked;
  }
  // A cell of a face lies on at least two of the three projections, so its id is in T_xy or in T_xz.
  const std::array<std::uint32_t, 3> plane = planar_bricks(brick);
  const Cell corner = lattice_.brick_corner(brick);
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::uint32_t i = lists_[k].first(plane[k]); i != none; i = lists_[k].entry(i).after) {
      const Slot slot = lists_[k].entry(i).slot;
      ++looked;
      // Most ids of a projection belong to cubes before or behind the brick.
      if (!reaches(members_[places_[slot]].cube, corner) || !wanted(slot)) continue;
      const std::uint64_t other = lists_[1 - k].bits(slot, plane[1 - k]);
      if (k == 1 && other != 0) continue;  // met in T_xy already
      const std::uint64_t here = lists_[k].entry(i).bits, yz = lists_[2].bits(slot, plane[2]);
      const std::uint64_t faces =
          cells_on_faces(static_cast<std::uint16_t>(k == 0 ? here : other),
                         static_cast<std::uint16_t>(k == 0 ? other : here), static_cast<std::uint16_t>(yz));
      if ((faces & bits) != 0) f(slot);
    }
  }
  return looked;
}

}  // namespace gridcull
