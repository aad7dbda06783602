// Claim. The pixels of a map with a depth of at most its plane's distance D1 are in the umbra of the occluders, so that
// together they are a flat occluder at D1 (appendix B, property 3: a subset of an umbra shadows inside it). A point P
// of a plane at D2 > D1 is hidden from the cell by it when every Q on V-P with w = D1 lies in such pixels, V in the
// cell.
//
// The paper convolves the map with the inverse image of a flat "equivalent cell", so that the kernel is the same
// everywhere. We keep the cell as it is: with k = (D1 - w(V)) / (D2 - w(V)), Q = V + k (P - V), each coordinate of Q is
// bilinear in V and P and fractional linear in w(V), so for a whole pixel of P its range has its ends at corners. The
// two ranges make up a rectangle of pixels that holds all Q; a summed-area table tells whether all of it is covered,
// which is the convolution's "black" for a kernel of that size. The sections being rectangles of covered pixels, they
// are convex, and improved projections hold behind D1 (extended_plane.h).
//
// Rounding: ranges grow by 1e-13 of the numbers in them, some hundred times what ten roundings do.
#include "gridcull/methods/extended_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridcull::extended {

void Sweep::count(const Plane& near, const DepthMap& map) {
  const auto side = static_cast<std::size_t>(map.resolution()) + 1;
  sums_.assign(side * side, 0);
  // Depths were rounded up, and a cut at the plane itself must count.
  const float limit = std::nextafter(static_cast<float>(near.distance * (1.0 + 1e-9)), DepthMap::uncovered);
  for (std::size_t y = 1; y < side; ++y) {
    std::uint32_t row = 0;
    for (std::size_t x = 1; x < side; ++x) {
      row += map.at(static_cast<int>(x) - 1, static_cast<int>(y) - 1) > limit;
      sums_[y * side + x] = sums_[(y - 1) * side + x] + row;
    }
  }
}

void Sweep::find_runs(const Plane& near, const Plane& far, int axis, std::vector<Run>& runs) const {
  const double half = near.half[axis], pixel = near.pixel()[axis], step = far.pixel()[axis];
  runs.assign(static_cast<std::size_t>(far.resolution), {});
  for (int i = 0; i < far.resolution; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double w : {-near.half.z, near.half.z}) {
      const double k = (near.distance - w) / (far.distance - w);
      for (const double p : {i * step - far.extent[axis], (i + 1) * step - far.extent[axis]}) {
        low = std::min(low, -half + k * (p + half));
        high = std::max(high, half + k * (p - half));
      }
    }
    const double grow = 1e-13 * (std::fabs(low) + std::fabs(high) + half + near.extent[axis] + far.extent[axis]);
    const double first = (low - grow + near.extent[axis]) / pixel, last = (high + grow + near.extent[axis]) / pixel;
    if (!(first >= 0.0 && last < near.resolution)) continue;
    runs[static_cast<std::size_t>(i)] = {static_cast<int>(std::floor(first)), static_cast<int>(std::floor(last))};
  }
}

void Sweep::carry(const Plane& near, const DepthMap& map, const Plane& far, DepthMap& out) {
  count(near, map);
  find_runs(near, far, 0, columns_);
  find_runs(near, far, 1, rows_);
  const auto side = static_cast<std::size_t>(map.resolution()) + 1;
  const double exact = near.distance * (1.0 + 1e-9);
  const float depth = std::nextafter(static_cast<float>(exact), DepthMap::uncovered);
  for (std::size_t y = 0; y < rows_.size(); ++y) {
    if (rows_[y].first > rows_[y].last) continue;
    const std::uint32_t* below = &sums_[static_cast<std::size_t>(rows_[y].first) * side];
    const std::uint32_t* above = &sums_[(static_cast<std::size_t>(rows_[y].last) + 1) * side];
    for (std::size_t x = 0; x < columns_.size(); ++x) {
      const Run& c = columns_[x];
      if (c.first > c.last) continue;
      const auto left = static_cast<std::size_t>(c.first), right = static_cast<std::size_t>(c.last) + 1;
      if (above[right] - above[left] - below[right] + below[left] == 0) {
        out.cover(static_cast<int>(y), static_cast<int>(x), static_cast<int>(x), depth);
      }
    }
  }
}

}  // namespace gridcull::extended
