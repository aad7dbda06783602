#include "gridcull/service/svg_cells.h"

#include <algorithm>

namespace gridcull {
namespace {

using Run = std::pair<std::int64_t, std::int64_t>;

/// Sorted runs with overlapping and abutting ones joined.
std::vector<Run> joined(std::vector<Run> runs) {
  std::sort(runs.begin(), runs.end());
  std::vector<Run> out;
  for (const Run& run : runs) {
    if (!out.empty() && run.first <= out.back().second) {
      out.back().second = std::max(out.back().second, run.second);
    } else {
      out.push_back(run);
    }
  }
  return out;
}

}  // namespace

void CellPlane::add(const CellRect& rect) {
  if (rect.x0 >= rect.x1) return;
  for (std::int64_t y = rect.y0; y < rect.y1; ++y) rows_[y].push_back({rect.x0, rect.x1});
}

std::vector<CellRect> CellPlane::merged() const {
  std::vector<CellRect> done;
  std::map<Run, std::int64_t> open;  // run -> row where it began
  std::int64_t next = 0;             // the row after the last one
  const auto close = [&](const Run& run, std::int64_t from) { done.push_back({run.first, from, run.second, next}); };
  for (const auto& [y, row] : rows_) {
    std::map<Run, std::int64_t> still;
    for (const Run& run : joined(row)) {
      const auto before = y == next ? open.find(run) : open.end();
      still[run] = before == open.end() ? y : before->second;
    }
    for (const auto& [run, from] : open) {
      const auto goes_on = still.find(run);
      if (goes_on == still.end() || goes_on->second != from) close(run, from);
    }
    open = std::move(still);
    next = y + 1;
  }
  for (const auto& [run, from] : open) close(run, from);
  return done;
}

std::string path_of(const std::vector<CellRect>& rects) {
  std::string path;
  for (const CellRect& r : rects) {
    const std::string width = std::to_string(r.x1 - r.x0);
    path += "M" + std::to_string(r.x0) + " " + std::to_string(r.y0) + "h" + width + "v" + std::to_string(r.y1 - r.y0) +
            "h-" + width + "z";
  }
  return path;
}

}  // namespace gridcull
