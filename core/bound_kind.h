// The bounding volumes there are, by the names the command line gives them (`--bounds`).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace gridcull {

/// D. Bartz, J. T. Klosowski, D. Staneker, "k-DOPs as tighter bounding volumes for better occlusion performance", 2005.
/// In 2D: box and obb are rectangles, sphere is a disc, the three k-DOPs are the one octagon that their directions
/// leave in the plane (k = 8), hull is the convex polygon.
enum class BoundKind {
  box,     ///< axis-aligned (the k-DOP with k = 6)
  sphere,  ///< ball
  obb,     ///< oriented box
  dop14,   ///< box and the eight corner planes
  dop18,   ///< box and the twelve edge planes
  dop26,   ///< all of these
  hull     ///< convex hull; of a ball the ball itself
};

inline constexpr std::array<BoundKind, 7> all_bound_kinds{BoundKind::box,   BoundKind::sphere, BoundKind::obb,
                                                          BoundKind::dop14, BoundKind::dop18,  BoundKind::dop26,
                                                          BoundKind::hull};

/// "box", "sphere", "obb", "14-dop", "18-dop", "26-dop", "hull".
std::string_view name_of(BoundKind kind);

/// The kind of that name; nothing where there is none.
std::optional<BoundKind> find_bound_kind(std::string_view name);

/// "box, sphere, obb, 14-dop, 18-dop, 26-dop or hull".
std::string bound_kind_names();

}  // namespace gridcull
