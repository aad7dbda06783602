// Moves in bulk: byte strings of little-endian numbers beside each other, in CBOR messages only (FORMATS, "Service").
#pragma once

#include <span>
#include <string>

#include "gridcull/core/ids.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/json_tree.h"

namespace gridcull {

/// The keys of a frame that bulk moves take.
inline constexpr const char *set_ids = "set_ids", *set_positions = "set_positions",
                            *set_positions64 = "set_positions64", *set_headings = "set_headings",
                            *set_headings64 = "set_headings64", *set_orientations = "set_orientations",
                            *set_orientations64 = "set_orientations64";

/// Reads the moves that `frame` has in bulk; none where it has none. `out` is reused. Whether an object is there, and
/// none twice, is the world's to say. Throws Error(bad_frame).
void read_bulk_moves(const JsonRef& frame, int dimension, BulkMoves& out);

/// Appends ids as u32, little-endian.
void append_bulk_ids(std::span<const ObjectId> ids, std::string& out);

}  // namespace gridcull
