// The Depth Map on a projection plane and its pyramid (paper sections 2.3 and 2.4).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace gridcull::extended {

/// Pixels, inclusive; empty where left > right or bottom > top.
struct PixelRange {
  int left = 0, bottom = 0, right = -1, top = -1;
};

/// What a map knows of a range of pixels.
enum class Cover {
  all,   ///< every pixel is covered in front of the depth asked for
  some,  ///< some pixel is covered at some depth
  none   ///< no occluder's projection touches the range: no part of it can be covered either
};

/// Square map of depths: for a pixel the least depth by which an occluder covers the whole of it. Depths grow away from
/// the cell; "uncovered" is infinity. Coarser levels hold the greatest and the least depth of the four pixels below.
class DepthMap {
 public:
  static constexpr float uncovered = std::numeric_limits<float>::infinity();

  /// Empties it; storage is reused. 1 .. 8192 pixels along a side.
  void reset(int resolution);
  /// What a map of this resolution takes.
  static std::uint64_t bytes_for(int resolution);
  int resolution() const { return size_; }
  bool empty() const { return size_ == 0; }

  /// Covers pixels left .. right of a row.
  void cover(int row, int left, int right, float depth);
  float at(int x, int y) const { return farthest_[index(0, x, y)]; }
  /// Of pixels that are covered at all.
  std::uint64_t covered_pixels() const;

  /// To be called after the last cover() and before look().
  void build();
  /// The range lies within the map and is not empty. `looked_at` grows by the pixels of all levels that were read.
  Cover look(const PixelRange& range, float depth, std::uint64_t& looked_at) const;

 private:
  struct Level {
    int size = 0;
    std::size_t start = 0;
  };
  std::size_t index(std::size_t level, int x, int y) const {
    const Level& l = levels_[level];
    return l.start + static_cast<std::size_t>(y) * static_cast<std::size_t>(l.size) + static_cast<std::size_t>(x);
  }
  bool all_before(std::size_t level, int x, int y, const PixelRange& range, float depth, std::uint64_t& read) const;

  int size_ = 0;
  std::vector<Level> levels_{};
  std::vector<float> farthest_{};
  std::vector<float> nearest_{};
};

}  // namespace gridcull::extended
