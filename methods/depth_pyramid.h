// A hierarchical depth buffer (N. Greene, M. Kass and G. Miller, "Hierarchical z-buffer visibility", SIGGRAPH 1993):
// each coarser pixel holds the greatest depth of the four below it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gridcull {

/// Pixels, inclusive.
struct PixelBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

class DepthPyramid {
 public:
  /// Makes room; storage is reused. 1 .. 8192 pixels along each side.
  void resize(int width, int height);
  /// What resize() allocates.
  static std::uint64_t bytes_for(int width, int height);
  /// The finest level, row by row, to be filled before build().
  std::span<float> pixels() { return {depths_.data(), levels_[0].size()}; }
  void build();

  /// Whether some pixel of the box is at least as deep as `depth`. The box lies within the picture. `looked_at` grows
  /// by the pixels of all levels that were read.
  bool may_show(const PixelBox& box, float depth, std::uint64_t& looked_at) const;

  int width() const { return levels_[0].width; }
  int height() const { return levels_[0].height; }

 private:
  struct Level {
    int width = 0, height = 0;
    std::size_t start = 0;
    std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    std::size_t at(int x, int y) const {
      return start + static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
  };
  bool shows(std::size_t level, int x, int y, const PixelBox& box, float depth, std::uint64_t& looked_at) const;

  std::vector<Level> levels_{};
  std::vector<float> depths_{};
};

}  // namespace gridcull
