// What options ask for is held against the memory allowed before any of it is allocated.
#pragma once

#include <cstdint>
#include <string>

#include "gridcull/core/error.h"

namespace gridcull {

/// Throws Error(limit), with `what` in front, when `need` bytes are more than `allowed`; `hint` says what would fit.
inline void refuse_above(std::uint64_t allowed, std::uint64_t need, const std::string& what,
                         const std::string& hint = {}) {
  if (need <= allowed) return;
  throw Error(ErrorCode::limit, what + " " + std::to_string(need) + " bytes, more than the " + std::to_string(allowed) +
                                    " allowed" + (hint.empty() ? "" : "; " + hint));
}

/// The same for pictures of `resolution` pixels: half of them, and again, is tried for what would fit. `bytes_of` says
/// what a resolution needs and grows with it.
template <class BytesOf>
void refuse_resolution(std::uint64_t allowed, int resolution, const std::string& what, const BytesOf& bytes_of) {
  constexpr int least = 8;
  if (bytes_of(resolution) <= allowed) return;
  int fit = resolution / 2;
  while (fit >= least && bytes_of(fit) > allowed) fit /= 2;
  refuse_above(allowed, bytes_of(resolution),
               "resolution: " + std::to_string(resolution) + " pixels along a side: " + what,
               fit >= least ? std::to_string(fit) + " would fit" : "");
}

}  // namespace gridcull
