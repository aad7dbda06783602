// Whether two static worlds are the same, object by object and cell by cell.
#pragma once

#include <algorithm>

#include "gridcull/grid/static_cells.h"

namespace gridcull::test {

inline bool same(const StaticCells& a, const StaticCells& b) {
  if (a.members.size() != b.members.size()) return false;
  for (std::size_t i = 0; i < a.members.size(); ++i) {
    const auto x = a.of(a.members[i]), y = b.of(b.members[i]);
    const bool equal = std::equal(x.begin(), x.end(), y.begin(), y.end(), [](const BrickCover& p, const BrickCover& q) {
      return p.brick == q.brick && p.touched == q.touched && p.opaque == q.opaque;
    });
    if (!equal || a.members[i].id != b.members[i].id || a.members[i].hash != b.members[i].hash ||
        a.members[i].outside != b.members[i].outside)
      return false;
  }
  return true;
}

}  // namespace gridcull::test
