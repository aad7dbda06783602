// The static world as a bake sees it: occluders, and occludees in a hierarchy of boxes (paper section 2.4).
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "gridcull/methods/extended_choice.h"
#include "gridcull/methods/extended_pieces.h"

namespace gridcull::extended {

/// Boxes halved at the middle of their longest side.
class BoxTree {
 public:
  struct Node {
    Bounds box{};
    std::uint32_t first = 0, count = 0;  ///< items; all of the subtree's
    std::uint32_t left = 0;              ///< children are left and left + 1; 0: a leaf
  };
  void build(std::span<const Bounds> boxes);
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Places in the boxes given to build().
  std::span<const std::uint32_t> items(const Node& node) const { return {items_.data() + node.first, node.count}; }

 private:
  void split(std::uint32_t node, std::span<const Bounds> boxes);
  std::vector<Node> nodes_{};
  std::vector<std::uint32_t> items_{};
};

/// The floor. Segments between points at or above a height stay there, so below it occluders may be as large as we
/// like. Those that stand on it are drawn reaching below it: otherwise a viewpoint on the floor would look under them,
/// by the part of a pixel that is left between a wall's foot and the next row. Answers then hold for viewpoints and
/// occludees at or above the floor only.
struct Floor {
  double height = -std::numeric_limits<double>::infinity();  ///< z, metres: where most upright occluders stand
  double depth = 0.0;                                        ///< how far down they are drawn, metres
};

struct StaticScene {
  Floor floor{};
  std::vector<Occluder> occluders{};  ///< by ascending id
  std::vector<Occludee> occludees{};  ///< by ascending id; occluders too
  BoxTree tree{};                     ///< of the occludees
  ChoiceTree worth{};                 ///< of the occluders
};

/// From the static ones among `objects`, in any order. `least_angle`: steradians; smaller occluders are not worth it.
StaticScene make_static_scene(std::span<const Object* const> objects, double least_angle);

}  // namespace gridcull::extended
