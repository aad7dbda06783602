// Nested depth sections of an occluder: a long wall hides what is behind its near end before its far end is reached.
#pragma once

#include <span>

#include "gridcull/grid/piece_silhouette.h"

namespace gridcull {

/// Every ray strictly inside the outline meets the piece's interior (flat: crosses it) no later than at `key`, the
/// distance at which it may enter the mask; metres.
struct Section {
  Outline outline;
  double key = 0.0;
};

inline constexpr int max_sections = 4;

/// Sections with ascending keys, each inside the next; the last is the whole silhouette, and alone where more would not
/// pay (its nearest and farthest distance are alike). Returns how many, at most out.size() and max_sections; 0 when the
/// piece cannot be used from there.
int sections(const PlacedPiece& placed, std::span<Section> out);

}  // namespace gridcull
