// The parts of a five-dimensional tree's payload.
#pragma once

#include <string_view>

#include "gridcull/methods/bytes.h"
#include "gridcull/methods/five_d_code.h"

namespace gridcull {

void write_space(ByteWriter& out, const FiveDSpace& space);
/// Throws Error(bad_scene) for one that no tree can be about.
FiveDSpace read_space(ByteReader& in);

/// In the shortest of the three codings.
void write_tree(ByteWriter& out, const FiveDTree& tree, const FiveDSpace& space);
FiveDTree read_tree(ByteReader& in, const FiveDSpace& space, std::string_view name);

}  // namespace gridcull
