// What the engine knows of each object, by slot; slots of removed objects are used again.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/grid/cover.h"
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
  bool stale = false;            ///< active: the pose changed since it was discretised
  bool outside = false;          ///< active: reaches beyond the lattice; hidden: its volume does
  bool hollow = false;           ///< hidden: its volume is entered as an outline
  bool jumped = false;           ///< announced for the frame to come
  std::uint8_t patience = 0;     ///< active: frames it may still be unseen before it is hidden again
  std::uint32_t entries = none;  ///< chain in the identifier matrix
  std::uint32_t renewals = 0;    ///< volumes given so far, for the jitter
  std::uint64_t read_frame = 0;  ///< frame in which the pose was last read
  double max_speed = -1.0;       ///< metres a second; below 0: unknown
  double reach = 0.0;            ///< metres: reach_of(shape), kept beside what is read with it
  double term = 0.0;             ///< seconds: the next volume's longest validity
  Pose pose{};
  std::optional<PreparedShape> shape;

  bool moves() const { return !is_static; }
  bool may_hide() const { return !is_static && max_speed >= 0.0; }
};

class ObjectTable {
 public:
  Slot add(ObjectId id) {
    Slot slot;
    if (free_.empty()) {
      slot = static_cast<Slot>(states_.size());
      states_.emplace_back();
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    slots_.emplace(id, slot);
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
  Slot find(ObjectId id) const {
    const auto found = slots_.find(id);
    return found == slots_.end() ? none : found->second;
  }
  ObjectState& operator[](Slot slot) { return states_[slot]; }
  const ObjectState& operator[](Slot slot) const { return states_[slot]; }
  std::size_t size() const { return states_.size(); }
  std::size_t live() const { return slots_.size(); }

  std::uint64_t bytes() const {
    // A node of the id table: key, slot, next pointer and its share of the buckets.
    return states_.capacity() * sizeof(ObjectState) + slots_.size() * 32;
  }

 private:
  std::vector<ObjectState> states_;
  std::unordered_map<ObjectId, Slot> slots_;  // looked up only, never iterated
  std::vector<Slot> free_;
};

}  // namespace gridcull
