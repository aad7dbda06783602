// Stable hash of answers (FNV-1a, 64 bits): the same on every machine and in every version.
#pragma once

#include <cstdint>

#include "gridcull/core/culler.h"

namespace gridcull {

class StableHash {
 public:
  void add(std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) {
      state_ ^= (word >> shift) & 0xFFu;
      state_ *= 0x0000'0100'0000'01B3ull;
    }
  }
  /// Low word first.
  void add64(std::uint64_t value) {
    add(static_cast<std::uint32_t>(value));
    add(static_cast<std::uint32_t>(value >> 32));
  }
  /// Viewer, number of ids, ids.
  void add(const Answer& answer) {
    add(answer.viewer);
    add(static_cast<std::uint32_t>(answer.visible.size()));
    for (const ObjectId id : answer.visible) add(id);
  }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xCBF2'9CE4'8422'2325ull;
};

}  // namespace gridcull
