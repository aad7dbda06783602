#include "gridcull/grid/hollow_tbv.h"

#include <algorithm>

namespace gridcull {

HollowTbv::HollowTbv(const Lattice& lattice) : lattice_(lattice) {
  if (lattice.dimension() == 2) {
    lists_.emplace_back(lattice.brick_count());
  } else {
    for (const CubePlane plane : {CubePlane::xy, CubePlane::xz, CubePlane::yz}) {
      lists_.emplace_back(planar_brick_count(lattice, plane));
    }
  }
}

void HollowTbv::reserve(std::size_t slots) {
  if (slots > places_.size()) places_.resize(slots, none);
  for (MaskLists& list : lists_) list.reserve(slots);
}

bool HollowTbv::encloses(const Member& member, const Cell& cell) const {
  return lattice_.dimension() == 2 ? circle_encloses(member.circle, cell) : cube_encloses(member.cube, cell);
}

bool HollowTbv::insert(Slot slot, const TbvMatrix::Ball& ball, std::span<const Cell> viewers) {
  Member member{slot, {}, {}};
  if (lattice_.dimension() == 2) {
    member.circle = circle_outline(lattice_, ball.centre, ball.radius);
  } else {
    member.cube = cube_cells(lattice_, ball.centre, ball.radius);
  }
  const auto inside = [&](const Cell& cell) { return encloses(member, cell); };
  if (std::any_of(viewers.begin(), viewers.end(), inside)) return false;
  if (lattice_.dimension() == 2 ? !enter_circle(member) : !enter_cube(member)) return false;
  places_[slot] = static_cast<std::uint32_t>(members_.size());
  members_.push_back(member);
  return true;
}

bool HollowTbv::enter_circle(const Member& member) {
  if (!member.circle.whole) return false;
  cover_circle_outline(lattice_, member.circle, circle_cells_);
  for (const BrickCover& b : circle_cells_.bricks) lists_[0].insert(member.slot, b.brick, b.touched);
  return true;
}

bool HollowTbv::enter_cube(const Member& member) {
  if (!member.cube.whole) return false;
  cover_cube_outline(lattice_, member.cube, cube_outline_);
  for (std::size_t k = 0; k < 3; ++k) {
    for (const PlanarBrick& b : cube_outline_.plane[k]) lists_[k].insert(member.slot, b.brick, b.mask);
  }
  return true;
}

void HollowTbv::erase(Slot slot) {
  for (MaskLists& list : lists_) list.erase(slot);
  const std::uint32_t place = places_[slot];
  members_[place] = members_.back();
  places_[members_[place].slot] = place;
  members_.pop_back();
  places_[slot] = none;
}

void HollowTbv::enclosing(std::span<const Cell> viewers, std::vector<Slot>& out) const {
  for (const Member& member : members_) {
    const auto inside = [&](const Cell& cell) { return encloses(member, cell); };
    if (std::any_of(viewers.begin(), viewers.end(), inside)) out.push_back(member.slot);
  }
}

std::array<std::uint32_t, 3> HollowTbv::planar_bricks(std::size_t brick) const {
  const Cell corner = lattice_.brick_corner(brick);
  const int s = lattice_.brick_shift();
  const Cell b{corner.x >> s, corner.y >> s, corner.z >> s};
  const auto index = [&](CubePlane plane) {
    return static_cast<std::uint32_t>(planar_brick_index(lattice_, plane, b));
  };
  return {index(CubePlane::xy), index(CubePlane::xz), index(CubePlane::yz)};
}

bool HollowTbv::may_touch(std::size_t brick) const {
  if (members_.empty()) return false;
  if (lattice_.dimension() == 2) return lists_[0].any(brick);
  const std::array<std::uint32_t, 3> plane = planar_bricks(brick);
  const int met = lists_[0].any(plane[0]) + lists_[1].any(plane[1]) + lists_[2].any(plane[2]);
  return met >= 2;
}

std::uint64_t HollowTbv::matrix_bytes() const {
  std::uint64_t bytes = 0;
  for (const MaskLists& list : lists_) bytes += list.matrix_bytes();
  return bytes;
}

std::uint64_t HollowTbv::entry_bytes() const {
  std::uint64_t bytes = members_.capacity() * sizeof(Member) + places_.capacity() * sizeof(std::uint32_t);
  for (const MaskLists& list : lists_) bytes += list.entry_bytes();
  return bytes;
}

}  // namespace gridcull
