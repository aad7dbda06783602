// Static cells under a limit of memory: which tiles are held, and who stands in the others.
//
// Claim: answers stay conservative. A tile that is not held has no opaque cells, and fewer opaque cells hide less. Let
// p be a visible point of a static object X, in a cell of such a tile: the tile's box then meets the view volume, X is
// among the tile's members, and each_unheld() names X, whatever was found hidden there. Where p's cell is in a held
// tile, X is in its list as if all tiles were held. A viewer that stands in X finds it in each_unheld_at() or in the
// list of its own cell.
//
// Which tiles are held where a view reaches follows from this frame's views alone: those nearest to them, as many as
// fit. Others stay as long as there is room.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/view.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/cover.h"
#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/object_table.h"
#include "gridcull/grid/static_tiles.h"

namespace gridcull {

/// What a stream holds and did so far.
struct TileUse {
  std::size_t held = 0;         ///< tiles in memory
  std::uint64_t bytes = 0;      ///< their cells, at most what is allowed
  std::uint64_t directory = 0;  ///< bytes of what is known of all tiles
  std::uint64_t read = 0;       ///< tiles read
  std::uint64_t let_go = 0;     ///< tiles let go of
};

/// What a held tile takes: entries of I, words and heads of the store (OpenVDB's leaves, more than an array's part).
std::uint64_t tile_bytes(const StaticTile& tile);

class TileStream {
 public:
  /// `max_bytes`: of the cells held. The lattice must stay where it is. Throws Error(bad_scene) for tiles of another.
  TileStream(std::shared_ptr<TiledCells> cells, const Lattice& lattice, std::uint64_t max_bytes);

  /// Whether the object's cells come from the tiles from now on: it is one of theirs, the same to the bit, and no tile
  /// is held yet.
  bool adopt(const Object& object, Slot slot);
  /// They no longer do: the object was moved or removed.
  void release(ObjectId object);
  /// Whether an adopted object may reach beyond the lattice.
  bool reaches_outside(ObjectId object) const { return cells_->head().find_id(object)->outside; }

  /// Lets go of tiles and reads others, for these views. What TiledCells::read() throws leaves its tile not held.
  void follow(std::span<const View> views, ObjectTable& objects, IdentifierMatrix& matrix);

  /// Calls f(slot) for the objects of tiles that are not held and that the view volume may meet; for some repeatedly.
  template <class F>
  void each_unheld(const ViewVolume& volume, F&& f) const {
    for (const Stretch& tile : stretches_) {
      if (!tile.held && reaches(volume, tile)) each_member(tile, f);
    }
  }
  /// The same of the tile that a cell of the lattice is in.
  template <class F>
  void each_unheld_at(const Cell& cell, F&& f) const {
    const std::uint32_t at = stretch_of_[cells_->layout().tile_of(cell)];
    if (at != none && !stretches_[at].held) each_member(stretches_[at], f);
  }

  TileUse use() const;

 private:
  /// A tile that holds something.
  struct Stretch {
    std::size_t tile;
    Vec3 low, high, centre;  ///< metres
    double radius;
    std::uint64_t bytes;
    bool held = false;
    bool wanted = false;    ///< some view reaches it
    double distance = 0.0;  ///< metres, to the nearest view
  };

  template <class F>
  void each_member(const Stretch& tile, F&& f) const {
    for (const std::uint32_t member : cells_->tiles()[tile.tile].members) {
      if (slots_[member] != none) f(slots_[member]);
    }
  }
  /// Whether the view volume may meet the tile: only then is it wanted, too.
  static bool reaches(const ViewVolume& volume, const Stretch& tile);
  void measure(std::span<const View> views);
  /// The tiles to hold: into chosen_, of stretches_.
  void choose();
  void let_go(Stretch& tile, ObjectTable& objects, IdentifierMatrix& matrix);
  void read(Stretch& tile, ObjectTable& objects, IdentifierMatrix& matrix);
  /// Makes a member's cells of the tile those of covers_[first, last).
  void set_cells(const Stretch& tile, Slot slot, std::size_t first, std::size_t last, ObjectTable& objects,
                 IdentifierMatrix& matrix);

  std::shared_ptr<TiledCells> cells_;
  const Lattice& lattice_;
  std::uint64_t max_bytes_;
  std::vector<Stretch> stretches_;
  std::vector<std::uint32_t> stretch_of_;  ///< by tile; none: an empty one
  std::vector<Slot> slots_;                ///< by member; none: not adopted
  std::vector<std::uint32_t> order_;
  std::vector<std::uint8_t> chosen_;
  std::vector<MemberBrick> covers_;
  Cover cover_;
  TileUse use_;
};

}  // namespace gridcull
