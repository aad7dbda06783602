// What is fuzzed: the readers of everything that comes from outside. Each takes any bytes and gives back normally,
// unless something is wrong: refusals (Error) are caught, everything else gets out.
#pragma once

#include <string_view>

namespace gridcull::fuzz {

/// A message of the wire, as JSON and as CBOR. Small worlds are opened and asked one frame; frames are applied to a
/// small world: a record of them replays to the same answers, and those that are refused change nothing.
void wire(std::string_view bytes);
/// A scene file; what is read is written and read again to the same text.
void scene(std::string_view bytes);
/// A line of a frames file, in 2D and 3D; likewise.
void frame(std::string_view bytes);

}  // namespace gridcull::fuzz
