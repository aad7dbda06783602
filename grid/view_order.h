// The order in which the views of a frame are answered: along a Z-curve through their places, so that a viewer finds
// its surroundings in the caches, where its neighbour left them. Answers do not depend on it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/view.h"

namespace gridcull {

class ViewOrder {
 public:
  /// Views by their numbers; those outside the box (metres) count as at its border. Valid until the next call.
  std::span<const std::uint32_t> sort(std::span<const View> views, const Bounds& box);

 private:
  struct Item {
    std::uint32_t place, view;
  };
  std::vector<Item> items_;
  std::vector<std::uint32_t> order_;
};

}  // namespace gridcull
