// Sets of cells in a plane, merged into few rectangles so that pictures stay small.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gridcull {

/// Cells x0 .. x1 by y0 .. y1, upper ends exclusive.
struct CellRect {
  std::int64_t x0, y0, x1, y1;
  bool operator==(const CellRect&) const = default;
};

/// A set of cells; any may be added twice.
class CellPlane {
 public:
  void add(const CellRect& rect);
  bool empty() const { return rows_.empty(); }
  /// Disjoint rectangles that cover the set and nothing else: runs along x, equal runs of adjacent rows joined.
  std::vector<CellRect> merged() const;

 private:
  std::map<std::int64_t, std::vector<std::pair<std::int64_t, std::int64_t>>> rows_{};
};

/// SVG path data of the rectangles, in cells.
std::string path_of(const std::vector<CellRect>& rects);

}  // namespace gridcull
