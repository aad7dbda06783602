// Turns the slots of an answer into ascending ids.
#pragma once

#include <cstdint>
#include <vector>

#include "gridcull/core/ids.h"
#include "gridcull/grid/object_table.h"

namespace gridcull {

class AnswerIds {
 public:
  /// Appends the ids of `seen` (each slot once) to the empty `ids`, ascending.
  void list(const ObjectTable& objects, const std::vector<Slot>& seen, std::vector<ObjectId>& ids);

 private:
  std::vector<std::uint64_t> bits_;  // slots of the answer, all 0 between calls
};

}  // namespace gridcull
