// The cells of a static world, discretised once and kept: what `gridcull bake static` writes and what the engine takes
// instead of discretising again.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "gridcull/core/ids.h"
#include "gridcull/core/object.h"
#include "gridcull/grid/cover_scratch.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

/// What a static object covers of one brick.
struct MemberBrick {
  std::uint32_t member;  ///< index into StaticCells::members
  BrickCover cover;
};

struct StaticCells {
  /// The lattice they are cells of.
  int dimension = 2;
  Vec3 origin{0.0};
  double cell = 1.0;  ///< metres
  Cell cells{};

  std::uint64_t world = 0;  ///< static_world_hash() of the objects
  struct Member {
    ObjectId id = no_id;
    std::uint64_t hash = 0;   ///< object_hash()
    std::uint64_t first = 0;  ///< in `bricks`
    std::uint64_t count = 0;
    bool outside = false;  ///< the shape may reach beyond the lattice
  };
  std::vector<Member> members;     ///< ids ascend
  std::vector<BrickCover> bricks;  ///< of each member, ascending

  /// Whether these are cells of that lattice, the same to the bit.
  bool fit(const Lattice& lattice) const;
  /// The member that this very object is: nullptr where its shape, pose or anything else that counts is another.
  const Member* find(const Object& object) const;
  const Member* find_id(ObjectId id) const;
  std::span<const BrickCover> of(const Member& member) const {
    return std::span(bricks).subspan(member.first, member.count);
  }
  std::uint64_t bytes() const { return members.capacity() * sizeof(Member) + bricks.capacity() * sizeof(BrickCover); }
};

/// Bounds that give their lattice, the same to the bit.
Bounds bounds_of(const StaticCells& cells);
/// Their lattice. Throws as Lattice does.
Lattice lattice_of(const StaticCells& cells, std::uint64_t max_memory, Room room);

/// Discretises the static ones among `objects`. `progress` is told of the share done and stops the work by false: then
/// nothing is returned. Throws Error(limit) when the result needs more than `max_memory` bytes.
std::optional<StaticCells> discretise_static(const Lattice& lattice, std::span<const Object> objects,
                                             std::uint64_t max_memory, const std::function<bool(double)>& progress);

/// Throws Error(limit), which names the option.
[[noreturn]] void refuse_memory(std::uint64_t max_memory);
/// Throws Error(limit) when that many bricks need more than `max_memory` bytes.
void check_brick_memory(std::uint64_t bricks, std::uint64_t max_memory);

}  // namespace gridcull
