// The static store: O_s, "built once", and the lists of static objects in I (Batagelo and Wu 2002, section 3), by brick
// of 64 cells. What keeps them may be chosen: an array as big as the lattice, or OpenVDB's tree, which grows with the
// world's surface. The engine asks and writes through this contract only, so that answers have the same bits with
// either.
//
// Threads: any number may read while nobody writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "gridcull/grid/lattice.h"

namespace gridcull {

class StaticStore {
 public:
  /// A list's end: no entry.
  static constexpr std::uint32_t nobody = 0xFFFF'FFFFu;

  virtual ~StaticStore() = default;

  /// O_s: the brick's cells that lie wholly inside one static occluder.
  virtual std::uint64_t opaque(std::size_t brick) const = 0;
  /// O_s of neighbours along x, the first `brick`: out[i] |= opaque(brick + i). All lie in one row of the lattice.
  virtual void add_opaque_row(std::size_t brick, std::span<std::uint64_t> out) const = 0;
  /// First entry of the brick's static objects (IdentifierMatrix::entry), or `nobody`.
  virtual std::uint32_t first(std::size_t brick) const = 0;

  virtual void set_opaque(std::size_t brick, std::uint64_t cells) = 0;
  virtual void set_first(std::size_t brick, std::uint32_t entry) = 0;

  /// Bytes in use.
  virtual std::uint64_t bytes() const = 0;
};

enum class StoreKind {
  dense,   ///< a word and a list's head for every brick
  openvdb  ///< trees (Museth 2013); needs a gridcull with OpenVDB
};

/// "dense", "openvdb".
std::string_view name_of(StoreKind kind);

/// Whether this gridcull has it.
bool has_store(StoreKind kind);

/// An empty store for the lattice, which must stay where it is. Throws Error(usage) where has_store(kind) is false.
std::unique_ptr<StaticStore> make_static_store(StoreKind kind, const Lattice& lattice);

}  // namespace gridcull
