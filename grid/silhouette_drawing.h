// What a view by method `silhouette` hands to a drawing sink: the nodes of the index that its walk met, and in 2D the
// region that it sees, which the slope buffer knows exactly.
#pragma once

#include <vector>

#include "gridcull/core/drawing.h"
#include "gridcull/grid/box_lanes_2d.h"
#include "gridcull/grid/loose_index.h"
#include "gridcull/grid/slope_buffer.h"

namespace gridcull {

/// Nodes in the order in which the walk met them. Kept only while drawing.
struct WalkedNodes {
  std::vector<LooseIndex::NodeId> opened, hidden;
  std::vector<Box2D> opened_rows, hidden_rows;  ///< 2D: of static objects
  void clear() {
    opened.clear();
    hidden.clear();
    opened_rows.clear();
    hidden_rows.clear();
  }
};

/// The nodes' plain boxes, and the rows' tight ones. Of what was opened only where entries were met: nodes in which
/// something hangs, and those without a child in the list.
void draw_nodes(const LooseIndex& index, const WalkedNodes& nodes, DrawSink& sink);

/// What is in front of the buffer's edges and within `reach` metres of the eye.
std::vector<Vec2> seen_region(const SlopeBuffer& buffer, const Vec2& eye, double reach);

}  // namespace gridcull
