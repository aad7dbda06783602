// What the engine knows of each object, by slot; slots of removed objects are used again. What a pushed move needs
// stands apart, a cache line an object and 8 bytes, since of a crowd all may be told in every frame.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/grid/cover.h"
#include "gridcull/grid/id_slots.h"
#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

/// Where an object stands in the grid.
enum class Place : std::uint8_t {
  gone,     ///< free slot
  active,   ///< discretised in O and I: potentially visible to someone, static, or without a TBV
  waiting,  ///< to be discretised at the start of the next frame
  hidden    ///< has a temporal bounding volume
};

/// Where an object stands, and what a push of it needs to know.
struct alignas(64) Whereabouts {
  Pose pose{};
  /// Metres that it may go before its ball in the index must follow (SilhouetteWorld::Mark::is_loose), hidden: before
  /// it may be outside its volume; below 0: it may not, every move is looked at in full.
  float leash = -1.0F;
  std::uint16_t pushed = 0;  ///< the round of pushes (between two frames) for which its old position is kept
  std::uint8_t marks = 0;    ///< of its ball in the index, while it has a leash
  bool stale = false;        ///< active: the pose changed since it was discretised
};
static_assert(sizeof(Whereabouts) == 64);

struct ObjectState {
  ObjectId id = no_id;
  Place place = Place::gone;
  bool occluder = true;
  bool is_static = false;
  bool round = false;                  ///< a disc or ball: its reach is its radius
  bool outside = false;                ///< active: reaches beyond the lattice; hidden: its volume does
  bool hollow = false;                 ///< hidden: its volume is entered as an outline
  bool jumped = false;                 ///< announced for the frame to come
  bool known = false;                  ///< static: its cells here are among GridOptions::static_cells
  bool tiled = false;                  ///< static: its cells come from GridWorld::tiles
  bool may_hide = false;               ///< it moves, and how fast at most is known
  std::uint8_t patience = 0;           ///< active: frames it may still be unseen before it is hidden again
  std::uint32_t active_place = none;   ///< active and moving: its place in the engine's list
  std::uint32_t outside_place = none;  ///< outside: its place in GridWorld::outside
  std::uint32_t entries = none;        ///< chain in the identifier matrix
  std::uint32_t renewals = 0;          ///< volumes given so far, for the jitter
  std::uint32_t read_frame = 0;        ///< frame (low 32 bits) in which the pose was last read
  float term = 0.0F;                   ///< seconds: the next volume's longest validity
  double reach = 0.0;                  ///< metres: reach_of(shape), kept beside what is read with it
  std::optional<PreparedShape> shape;

  bool moves() const { return !is_static; }
};

/// Makes room for `count` elements in all, in steps of an eighth: half-empty tables would cost more than their
/// growing.
template <class T>
void grow(std::vector<T>& table, std::size_t count) {
  if (count > table.capacity()) table.reserve(count + count / 8);
  if (count > table.size()) table.resize(count);
}

class ObjectTable {
 public:
  Slot add(ObjectId id) {
    Slot slot;
    if (free_.empty()) {
      slot = static_cast<Slot>(states_.size());
      grow(states_, states_.size() + 1);
      grow(whereabouts_, states_.size());
      grow(max_speeds_, states_.size());
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    slots_.insert(id, slot);
    states_[slot].id = id;
    max_speeds_[slot] = -1.0;
    return slot;
  }
  void remove(Slot slot) {
    slots_.erase(states_[slot].id);
    states_[slot] = ObjectState{};
    whereabouts_[slot] = Whereabouts{};
    max_speeds_[slot] = -1.0;
    free_.push_back(slot);
  }

  /// The slot of an id, or `none`.
  Slot find(ObjectId id) const { return slots_.find(id); }
  ObjectState& operator[](Slot slot) { return states_[slot]; }
  const ObjectState& operator[](Slot slot) const { return states_[slot]; }
  Whereabouts& whereabouts(Slot slot) { return whereabouts_[slot]; }
  const Whereabouts& whereabouts(Slot slot) const { return whereabouts_[slot]; }
  const Pose& pose(Slot slot) const { return whereabouts_[slot].pose; }
  /// Metres a second; below 0: unknown.
  double max_speed(Slot slot) const { return max_speeds_[slot]; }
  void set_max_speed(Slot slot, double max_speed) { max_speeds_[slot] = max_speed; }
  /// No round of pushes keeps anybody's old position.
  void forget_pushes() {
    for (Whereabouts& where : whereabouts_) where.pushed = 0;
  }
  std::size_t size() const { return states_.size(); }
  void prefetch(Slot slot) const {
    const auto* state = reinterpret_cast<const char*>(&states_[slot]);
    for (std::size_t byte = 0; byte < sizeof(ObjectState); byte += 64) __builtin_prefetch(state + byte);
    prefetch_whereabouts(slot);
  }
  void prefetch_whereabouts(Slot slot) const { __builtin_prefetch(&whereabouts_[slot]); }

  std::uint64_t bytes() const {
    return states_.capacity() * sizeof(ObjectState) + whereabouts_.capacity() * sizeof(Whereabouts) +
           max_speeds_.capacity() * sizeof(double) + slots_.bytes();
  }

 private:
  std::vector<ObjectState> states_;
  std::vector<Whereabouts> whereabouts_;
  std::vector<double> max_speeds_;
  IdSlots slots_;
  std::vector<Slot> free_;
};

}  // namespace gridcull
