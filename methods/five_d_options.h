// What the five-dimensional tree is built with; names after the paper (methods/five_d_tree.cpp).
#pragma once

#include <cstdint>
#include <span>

#include "gridcull/methods/baking.h"

namespace gridcull {

struct FiveDOptions {
  double s_thresh = 0.01;         ///< section 5: the least visible share of an object's surface that counts
  double a = 50.0, b = 0.2;       ///< section 5: confidence that it is visible, invisible
  bool significant = false;       ///< section 5 to the letter: what a few rays hit is still invisible below s_thresh
  double effectiveness = 0.05;    ///< section 4: less effective partitions are not made
  int estimate_rays = 12;         ///< section 4: rays an object that an estimate is made from
  int cells = 2048;               ///< at most so many cells in position; 1 .. 2^20
  int intervals = 8;              ///< section 8: angular intervals of the last split, 1 (none) or 8
  int direction_planes = 0;       ///< candidates in each angle, besides the object planes; 0: none, as in section 8
  int bits = 12;                  ///< section 6: q, bits of a split position, 4 .. 20
  int boxes = 512;                ///< motion boxes, which stand for moving objects; 0: movers are only culled by view
  double low = -1e9, high = 1e9;  ///< 3D: heights of viewpoints; as they are: where something moves
  int threads = 1;                ///< of the bake; 1 .. 256
  std::uint64_t max_memory = std::uint64_t{4} << 30;  ///< bytes, of the leaves' sets
};

/// The settings of `gridcull bake`, and the options they make.
std::span<const BakeSetting> five_d_settings();
FiveDOptions five_d_options(const BakeSettings& values);

}  // namespace gridcull
