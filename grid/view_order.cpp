#include "gridcull/grid/view_order.h"

#include <algorithm>

namespace gridcull {
namespace {

/// Cells of the curve along an axis.
constexpr std::uint32_t cells = 1024;

std::uint32_t cell_along(double x, double low, double high) {
  const double t = (x - low) / (high - low) * cells;
  return t > 0.0 ? static_cast<std::uint32_t>(std::min(t, cells - 1.0)) : 0;
}

/// Ten bits, each followed by two zeros.
std::uint32_t spread(std::uint32_t v) {
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
}

}  // namespace

std::span<const std::uint32_t> ViewOrder::sort(std::span<const View> views, const Bounds& box) {
  items_.clear();
  for (std::uint32_t i = 0; i < views.size(); ++i) {
    const Vec3& p = views[i].pose.position;
    const std::uint32_t x = cell_along(p.x, box.min.x, box.max.x), y = cell_along(p.y, box.min.y, box.max.y),
                        z = cell_along(p.z, box.min.z, box.max.z);
    items_.push_back({spread(x) | spread(y) << 1 | spread(z) << 2, i});
  }
  std::sort(items_.begin(), items_.end(),
            [](const Item& a, const Item& b) { return a.place != b.place ? a.place < b.place : a.view < b.view; });
  order_.clear();
  for (const Item& item : items_) order_.push_back(item.view);
  return order_;
}

}  // namespace gridcull
