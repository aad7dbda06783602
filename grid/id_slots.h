// From ids to slots. Ids mostly run from 0 without great gaps: those stand in a plain table, others in a hash
// table that is looked up only, never iterated.
#pragma once

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gridcull/core/ids.h"
#include "gridcull/grid/identifier_matrix.h"

namespace gridcull {

class IdSlots {
 public:
  /// The id must not be there.
  void insert(ObjectId id, Slot slot) {
    ++count_;
    if (id < dense_.size()) {
      dense_[id] = slot;
    } else if (id < 4 * count_ + 1024) {
      dense_.reserve(id + 1 + id / 8);
      dense_.resize(std::size_t{id} + 1, none);
      dense_[id] = slot;
      adopt();
    } else {
      sparse_.emplace(id, slot);
    }
  }
  void erase(ObjectId id) {
    --count_;
    if (id < dense_.size() && dense_[id] != none) {
      dense_[id] = none;
    } else {
      sparse_.erase(id);
    }
  }
  /// The slot, or `none`.
  Slot find(ObjectId id) const {
    if (id < dense_.size()) return dense_[id];
    const auto found = sparse_.find(id);
    return found == sparse_.end() ? none : found->second;
  }

  std::uint64_t bytes() const {
    // A node of the hash table: key, slot, next pointer and its share of the buckets.
    return dense_.capacity() * sizeof(Slot) + sparse_.size() * 32;
  }

 private:
  /// Ids that came before the table was long enough for them move into it.
  void adopt() {
    std::erase_if(sparse_, [&](const auto& pair) {
      if (pair.first >= dense_.size()) return false;
      dense_[pair.first] = pair.second;
      return true;
    });
  }

  std::vector<Slot> dense_;
  std::unordered_map<ObjectId, Slot> sparse_;
  std::size_t count_ = 0;
};

}  // namespace gridcull
