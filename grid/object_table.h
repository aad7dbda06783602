// What the engine knows of each object, by slot; slots of removed objects are used again.
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

struct ObjectState {
  ObjectId id = no_id;
  Place place = Place::gone;
  bool occluder = true;
  bool is_static = false;
  bool round = false;                  ///< a disc or ball: its reach is its radius
  bool stale = false;                  ///< active: the pose changed since it was discretised
  bool outside = false;                ///< active: reaches beyond the lattice; hidden: its volume does
  bool hollow = false;                 ///< hidden: its volume is entered as an outline
  bool jumped = false;                 ///< announced for the frame to come
  bool known = false;                  ///< static: its cells here are among GridOptions::static_cells
  bool tiled = false;                  ///< static: its cells come from GridWorld::tiles
  std::uint8_t patience = 0;           ///< active: frames it may still be unseen before it is hidden again
  std::uint32_t active_place = none;   ///< active and moving: its place in the engine's list
  std::uint32_t outside_place = none;  ///< outside: its place in GridWorld::outside
  std::uint32_t entries = none;        ///< chain in the identifier matrix
  std::uint32_t renewals = 0;          ///< volumes given so far, for the jitter
  std::uint32_t pushed_frame = 0;      ///< frame (low 32 bits) for which the old position of a pushed move is kept
  std::uint32_t read_frame = 0;        ///< frame (low 32 bits) in which the pose was last read
  double max_speed = -1.0;             ///< metres a second; below 0: unknown
  double reach = 0.0;                  ///< metres: reach_of(shape), kept beside what is read with it
  float term = 0.0F;                   ///< seconds: the next volume's longest validity
  Pose pose{};
  std::optional<PreparedShape> shape;

  bool moves() const { return !is_static; }
  bool may_hide() const { return !is_static && max_speed >= 0.0; }
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
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    slots_.insert(id, slot);
    states_[slot] = ObjectState{};
    states_[slot].id = id;
    return slot;
  }
  void remove(Slot slot) {
    slots_.erase(states_[slot].id);
    states_[slot] = ObjectState{};
    free_.push_back(slot);
  }

  /// The slot of an id, or `none`.
  Slot find(ObjectId id) const { return slots_.find(id); }
  ObjectState& operator[](Slot slot) { return states_[slot]; }
  const ObjectState& operator[](Slot slot) const { return states_[slot]; }
  std::size_t size() const { return states_.size(); }
  void prefetch(Slot slot) const {
    const auto* state = reinterpret_cast<const char*>(&states_[slot]);
    for (std::size_t byte = 0; byte < sizeof(ObjectState); byte += 64) __builtin_prefetch(state + byte);
  }

  std::uint64_t bytes() const { return states_.capacity() * sizeof(ObjectState) + slots_.bytes(); }

 private:
  std::vector<ObjectState> states_;
  IdSlots slots_;
  std::vector<Slot> free_;
};

}  // namespace gridcull
