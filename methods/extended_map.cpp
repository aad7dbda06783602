// Pyramid: N. Greene, M. Kass, G. Miller, "Hierarchical Z-buffer visibility", SIGGRAPH 1993; the least depths beside
// the greatest tell at once where nothing is covered, which ends the search at "fully visible" nodes (section 6.1).
#include "gridcull/methods/extended_map.h"

#include <algorithm>

namespace gridcull::extended {

void DepthMap::reset(int resolution) {
  if (size_ != resolution) {
    size_ = resolution;
    levels_.clear();
    std::size_t start = 0;
    for (int size = resolution;; size = (size + 1) / 2) {
      levels_.push_back({size, start});
      start += static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
      if (size == 1) break;
    }
    farthest_.resize(start);
    nearest_.resize(start);
  }
  const auto pixels = static_cast<std::ptrdiff_t>(size_) * size_;
  std::fill(farthest_.begin(), farthest_.begin() + pixels, uncovered);
}

std::uint64_t DepthMap::bytes_for(int resolution) {
  std::uint64_t pixels = 0;
  for (int size = resolution;; size = (size + 1) / 2) {
    pixels += static_cast<std::uint64_t>(size) * static_cast<std::uint64_t>(size);
    if (size == 1) return pixels * (sizeof(float) + sizeof(float));
  }
}

void DepthMap::cover(int row, int left, int right, float depth) {
  float* pixel = &farthest_[index(0, left, row)];
  for (int x = left; x <= right; ++x, ++pixel) *pixel = std::min(*pixel, depth);
}

std::uint64_t DepthMap::covered_pixels() const {
  const auto pixels = static_cast<std::ptrdiff_t>(size_) * size_;
  return static_cast<std::uint64_t>(
      std::count_if(farthest_.begin(), farthest_.begin() + pixels, [](float depth) { return depth < uncovered; }));
}

void DepthMap::build() {
  const auto pixels = static_cast<std::ptrdiff_t>(size_) * size_;
  std::copy(farthest_.begin(), farthest_.begin() + pixels, nearest_.begin());
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const int size = levels_[l].size, below = levels_[l - 1].size;
    for (int y = 0; y < size; ++y) {
      const int y0 = 2 * y, y1 = std::min(2 * y + 1, below - 1);
      for (int x = 0; x < size; ++x) {
        const int x0 = 2 * x, x1 = std::min(2 * x + 1, below - 1);
        const std::size_t a = index(l - 1, x0, y0), b = index(l - 1, x1, y0);
        const std::size_t c = index(l - 1, x0, y1), d = index(l - 1, x1, y1);
        farthest_[index(l, x, y)] =
            std::max(std::max(farthest_[a], farthest_[b]), std::max(farthest_[c], farthest_[d]));
        nearest_[index(l, x, y)] = std::min(std::min(nearest_[a], nearest_[b]), std::min(nearest_[c], nearest_[d]));
      }
    }
  }
}

namespace {

/// Whether pixel (x, y) of a level lies wholly beside the range, or wholly inside.
struct Place {
  bool beside, inside;
  Place(std::size_t level, int x, int y, const PixelRange& r) {
    const int left = x << level, bottom = y << level, last = (1 << level) - 1;
    beside = left > r.right || left + last < r.left || bottom > r.top || bottom + last < r.bottom;
    inside = left >= r.left && left + last <= r.right && bottom >= r.bottom && bottom + last <= r.top;
  }
};

/// The level at which the range meets at most two pixels each way.
std::size_t start_level(const PixelRange& r, std::size_t levels) {
  std::size_t level = 0;
  while (level + 1 < levels &&
         ((r.right >> level) - (r.left >> level) > 1 || (r.top >> level) - (r.bottom >> level) > 1))
    ++level;
  return level;
}

}  // namespace

bool DepthMap::all_before(std::size_t level, int x, int y, const PixelRange& range, float depth,
                          std::uint64_t& read) const {
  if (x >= levels_[level].size || y >= levels_[level].size) return true;
  const Place place(level, x, y, range);
  if (place.beside) return true;
  ++read;
  const std::size_t i = index(level, x, y);
  if (farthest_[i] <= depth) return true;
  const float nearest = level == 0 ? farthest_[i] : nearest_[i];
  if (level == 0 || place.inside || nearest > depth) return false;
  for (const int k : {0, 1, 2, 3}) {
    if (!all_before(level - 1, 2 * x + (k & 1), 2 * y + (k >> 1), range, depth, read)) return false;
  }
  return true;
}

/// `none` is judged on the few coarse pixels about the range: it ends searches, and a search more is no fault.
Cover DepthMap::look(const PixelRange& range, float depth, std::uint64_t& looked_at) const {
  const std::size_t level = start_level(range, levels_.size());
  bool all = true, none = true;
  for (int y = range.bottom >> level; y <= range.top >> level; ++y) {
    for (int x = range.left >> level; x <= range.right >> level; ++x) {
      const std::size_t i = index(level, x, y);
      none = none && (level == 0 ? farthest_[i] : nearest_[i]) == uncovered;
      all = all && all_before(level, x, y, range, depth, looked_at);
      if (!all && !none) return Cover::some;
    }
  }
  return all ? Cover::all : Cover::none;
}

}  // namespace gridcull::extended
