// Every test is loosened by `slack_` cells plus a relative part: the margin of the lattice, which covers the
// roundings of its boundaries and of the viewpoint, and 1e-6 for coordinates of up to 2^30 cells, where a double
// still resolves 2^-22 of a cell and a few operations stay far below that.
#include "gridcull/grid/view_cone.h"

#include <algorithm>

namespace gridcull {
namespace {

std::int64_t clamped(double value, const CellRange& within) {
  if (!(value > static_cast<double>(within.low))) return within.low;
  if (!(value < static_cast<double>(within.high))) return within.high;
  return static_cast<std::int64_t>(value);
}

}  // namespace

ViewCone::ViewCone(const Lattice& lattice, const ViewVolume& volume, const Cell& viewer)
    : dimension_(lattice.dimension()),
      convex_(volume.convex()),
      range_(volume.range() / lattice.cell()),
      slack_(1e-6 + lattice.margin() / lattice.cell()) {
  const std::array<std::int64_t, 3> cell{viewer.x, viewer.y, viewer.z};
  for (int k = 0; k < dimension_; ++k) {
    const auto i = static_cast<std::size_t>(k);
    offset_[i] = (lattice.boundary(k, cell[i]) - volume.apex()[k]) / lattice.cell() + 0.5;
  }
  for (const HalfSpace& h : volume) {
    Side& side = side_[static_cast<std::size_t>(sides_++)];
    side.normal = {h.normal.x, h.normal.y, h.normal.z};
    side.reach = 0.5 * (std::fabs(h.normal.x) + std::fabs(h.normal.y) + std::fabs(h.normal.z));
  }
}

CellRange ViewCone::inside(const Side& side, int axis, const std::array<double, 3>& centre,
                           const CellRange& within) const {
  double base = side.reach + slack_;
  double size = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    base += side.normal[i] * centre[i];
    size += std::fabs(side.normal[i] * centre[i]);
  }
  base += 1e-12 * size;
  const double slope = side.normal[static_cast<std::size_t>(axis)];
  // base + slope * t >= 0; centre holds t = 0 along the axis.
  if (std::fabs(slope) < 1e-12) {
    const double most = base + 1e-12 * static_cast<double>(std::max(std::abs(within.low), std::abs(within.high)));
    return most >= 0.0 ? within : CellRange{};
  }
  const double root = -base / slope;
  const double loose = slack_ + 1e-12 * std::fabs(root);
  if (slope > 0.0) return {clamped(std::ceil(root - loose), {within.low, within.high + 1}), within.high};
  return {within.low, clamped(std::floor(root + loose), {within.low - 1, within.high})};
}

CellRange ViewCone::in_range(int axis, const std::array<double, 3>& centre, const CellRange& within) const {
  if (!std::isfinite(range_)) return within;
  const double r = range_ * (1.0 + 1e-12) + slack_;
  double rest = r * r;
  for (int k = 0; k < dimension_; ++k) {
    if (k == axis) continue;
    const double gap = std::max(0.0, std::fabs(centre[static_cast<std::size_t>(k)]) - 0.5);
    rest -= gap * gap;
  }
  if (rest < 0.0) return {};
  const double half = std::sqrt(rest) + 0.5 + slack_;
  const double middle = -centre[static_cast<std::size_t>(axis)];
  return {clamped(std::ceil(middle - half), {within.low, within.high + 1}),
          clamped(std::floor(middle + half), {within.low - 1, within.high})};
}

RowView ViewCone::row(int axis, const Cell& at, const CellRange& within) const {
  std::array<double, 3> centre{static_cast<double>(at.x) + offset_[0], static_cast<double>(at.y) + offset_[1],
                               dimension_ == 3 ? static_cast<double>(at.z) + offset_[2] : 0.0};
  centre[static_cast<std::size_t>(axis)] = offset_[static_cast<std::size_t>(axis)];
  RowView view{in_range(axis, centre, within), {}};
  if (sides_ == 0 || view.range.empty()) return view;
  if (convex_) {
    for (int s = 0; s < sides_ && !view.range.empty(); ++s) {
      view.range = inside(side_[static_cast<std::size_t>(s)], axis, centre, view.range);
    }
    return view;
  }
  // Outside means outside both half-planes: the complement of two half-lines is one gap.
  const CellRange a = inside(side_[0], axis, centre, view.range);
  const CellRange b = inside(side_[1], axis, centre, view.range);
  const auto complement = [&](const CellRange& in) {
    if (in.empty()) return view.range;
    if (in.low > view.range.low) return CellRange{view.range.low, in.low - 1};
    return CellRange{in.high + 1, view.range.high};
  };
  view.gap = intersect(complement(a), complement(b));
  return view;
}

}  // namespace gridcull
