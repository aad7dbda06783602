// Moves in bulk: byte strings of little-endian numbers beside each other, in CBOR messages only (FORMATS, "Service").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/ids.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/json_tree.h"

namespace gridcull {

/// The keys of a frame that bulk moves take.
inline constexpr const char *set_ids = "set_ids", *set_positions = "set_positions",
                            *set_positions64 = "set_positions64", *set_headings = "set_headings",
                            *set_headings64 = "set_headings64", *set_orientations = "set_orientations",
                            *set_orientations64 = "set_orientations64";

/// The moves that `frame` has in bulk; none where it has none. Throws Error(bad_frame).
std::vector<ObjectMove> read_bulk_moves(const JsonRef& frame, int dimension);

/// Ids as u32, little-endian.
std::vector<std::uint8_t> bulk_ids(const std::vector<ObjectId>& ids);

}  // namespace gridcull
