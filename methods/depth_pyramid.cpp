#include "gridcull/methods/depth_pyramid.h"

#include <algorithm>

namespace gridcull {

void DepthPyramid::resize(int width, int height) {
  if (!levels_.empty() && width == this->width() && height == this->height()) return;
  levels_.clear();
  std::size_t start = 0;
  for (;;) {
    levels_.push_back({width, height, start});
    start += levels_.back().size();
    if (width == 1 && height == 1) break;
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
  depths_.resize(start);
}

std::uint64_t DepthPyramid::bytes_for(int width, int height) {
  std::uint64_t pixels = 0;
  for (;; width = (width + 1) / 2, height = (height + 1) / 2) {
    pixels += static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    if (width == 1 && height == 1) return pixels * sizeof(float);
  }
}

void DepthPyramid::build() {
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    const Level &fine = levels_[i - 1], &coarse = levels_[i];
    for (int y = 0; y < coarse.height; ++y) {
      const int top = 2 * y, bottom = std::min(2 * y + 1, fine.height - 1);
      for (int x = 0; x < coarse.width; ++x) {
        const int left = 2 * x, right = std::min(2 * x + 1, fine.width - 1);
        depths_[coarse.at(x, y)] = std::max(std::max(depths_[fine.at(left, top)], depths_[fine.at(right, top)]),
                                            std::max(depths_[fine.at(left, bottom)], depths_[fine.at(right, bottom)]));
      }
    }
  }
}

bool DepthPyramid::may_show(const PixelBox& box, float depth, std::uint64_t& looked_at) const {
  // Begin where the box is at most two pixels wide and high.
  std::size_t level = 0;
  while (level + 1 < levels_.size() &&
         ((box.right >> level) - (box.left >> level) > 1 || (box.bottom >> level) - (box.top >> level) > 1)) {
    ++level;
  }
  for (int y = box.top >> level; y <= box.bottom >> level; ++y) {
    for (int x = box.left >> level; x <= box.right >> level; ++x) {
      if (shows(level, x, y, box, depth, looked_at)) return true;
    }
  }
  return false;
}

bool DepthPyramid::shows(std::size_t level, int x, int y, const PixelBox& box, float depth,
                         std::uint64_t& looked_at) const {
  ++looked_at;
  if (depths_[levels_[level].at(x, y)] < depth) return false;
  if (level == 0) return true;
  const Level& fine = levels_[level - 1];
  const std::size_t down = level - 1;
  for (int v = std::max(2 * y, box.top >> down); v <= std::min({2 * y + 1, fine.height - 1, box.bottom >> down}); ++v) {
    for (int u = std::max(2 * x, box.left >> down); u <= std::min({2 * x + 1, fine.width - 1, box.right >> down});
         ++u) {
      if (shows(down, u, v, box, depth, looked_at)) return true;
    }
  }
  return false;
}

}  // namespace gridcull
