// The traversal's half of a face: which cells of a plane are in view and not hidden. Caps are in cap_3d.cpp.
#include "gridcull/grid/face_3d.h"

#include <algorithm>

#include "gridcull/grid/division.h"

namespace gridcull {
namespace {

std::int64_t part(const Cell& c, int axis) { return axis == 0 ? c.x : axis == 1 ? c.y : c.z; }

/// Four bits along y (nibble of a row) to a brick's bits 0, 4, 8, 12.
constexpr std::uint64_t spread(std::uint64_t nibble) {
  return (nibble & 1) | (nibble & 2) << 3 | (nibble & 4) << 6 | (nibble & 8) << 9;
}

/// The reverse: bits 0, 4, 8, 12 to a nibble. The products land on distinct bits.
constexpr std::uint64_t squeeze(std::uint64_t word) { return ((word & 0x1111u) * 0x1248u >> 12) & 0xFu; }

}  // namespace

bool Face3D::reset(int index, ViewGrid& grid, const ViewCone& cone, const Cell& viewer) {
  grid_ = &grid;
  cone_ = &cone;
  axis_ = index / 2;
  sign_ = index % 2 == 0 ? 1 : -1;
  u_axis_ = axis_ == 0 ? 1 : 0;
  v_axis_ = axis_ == 2 ? 1 : 2;
  viewer_d_ = part(viewer, axis_);
  viewer_u_ = part(viewer, u_axis_);
  viewer_v_ = part(viewer, v_axis_);
  narrow_ = grid.lattice().holds(viewer);
  const CellRange d = grid.cells(axis_), u = grid.cells(u_axis_), v = grid.cells(v_axis_);
  u_ = {u.low - viewer_u_, u.high - viewer_u_};
  v_ = {v.low - viewer_v_, v.high - viewer_v_};
  const auto nearest = [](const CellRange& r) { return std::max({r.low, -r.high, std::int64_t{0}}); };
  depth_ =
      sign_ > 0 ? CellRange{d.low - viewer_d_, d.high - viewer_d_} : CellRange{viewer_d_ - d.high, viewer_d_ - d.low};
  // The pyramid |u|, |v| <= k meets the window from this depth on.
  depth_.low = std::max({depth_.low, nearest(u_), nearest(v_), std::int64_t{1}});
  if (depth_.empty()) return false;
  u_base_ = grid.base(u_axis_) - viewer_u_;
  u_stride_ = grid.stride(u_axis_);
  d_stride_ = grid.stride(axis_);
  v_stride_ = grid.stride(v_axis_);
  d_base_ = grid.base(axis_) - viewer_d_;
  v_base_ = grid.base(v_axis_) - viewer_v_;
  words_ = static_cast<std::size_t>((u_.high - u_base_) / 64 + 1);
  plane_.clear();
  std::size_t size = 0;
  for (std::int64_t k = depth_.low; k <= depth_.high; ++k) {
    plane_.push_back(size);
    const CellRange rows = plane_patch(k).v;
    size += static_cast<std::size_t>(rows.high - rows.low + 1) * words_;
  }
  hidden_.assign(size, 0);
  seen_depth_ = 0;
  return true;
}

Cell Face3D::cell(std::int64_t k, std::int64_t u, std::int64_t v) const {
  const std::int64_t d = sign_ * k;
  if (axis_ == 0) return {d, u, v};
  if (axis_ == 1) return {u, d, v};
  return {u, v, d};
}

Face3D::Patch Face3D::plane_patch(std::int64_t k) const { return {intersect(u_, {-k, k}), intersect(v_, {-k, k})}; }

// Cell (u, v) of plane k can only be seen through the cells of plane k - 1 that its from-cell footprint
// meets (hide_2d.h, the same claim with n = k and k - 1 for k), so one of those must have been visible.
Face3D::Patch Face3D::search_patch(std::int64_t k) const {
  const Patch all = plane_patch(k);
  if (!narrow_ || seen_depth_ == 0) return all;
  const auto scaled = [&](const CellRange& seen) {
    return CellRange{floor_div((seen.low - 1) * k, seen_depth_), ceil_div((seen.high + 1) * k, seen_depth_)};
  };
  return {intersect(all.u, scaled(seen_.u)), intersect(all.v, scaled(seen_.v))};
}

bool Face3D::scan(std::int64_t k, std::vector<std::uint64_t>& fresh, std::vector<std::size_t>& bricks,
                  WorkCounts& work) {
  const Patch patch = search_patch(k), whole = plane_patch(k);
  found_.assign(static_cast<std::size_t>(whole.v.high - whole.v.low + 1) * words_, 0);
  Patch seen;
  seen.u = {patch.u.high + 1, patch.u.low - 1};
  seen.v = {patch.v.high + 1, patch.v.low - 1};
  for (std::int64_t v = patch.v.low; v <= patch.v.high; ++v) {
    const CellRange in_view = cone_->row(u_axis_, cell(k, 0, v), patch.u).range;
    if (in_view.empty()) continue;
    std::uint64_t* out = found_.data() + static_cast<std::size_t>(v - whole.v.low) * words_;
    set_run(out, bit(in_view.low), bit(in_view.high));
    const std::uint64_t* hidden = row(k, v);
    int first = -1, last = -1;
    for (int w = bit(in_view.low) >> 6; w <= bit(in_view.high) >> 6; ++w) {
      const std::uint64_t view = out[w];
      out[w] &= ~hidden[w];
      work.cells_hidden += static_cast<std::uint64_t>(std::popcount(view & hidden[w]));
      if (out[w] == 0) continue;
      work.cells_visited += static_cast<std::uint64_t>(std::popcount(out[w]));
      if (first < 0) first = 64 * w + std::countr_zero(out[w]);
      last = 64 * w + 63 - std::countl_zero(out[w]);
    }
    if (first < 0) continue;
    seen.u = {std::min(seen.u.low, u_base_ + first), std::max(seen.u.high, u_base_ + last)};
    seen.v = {std::min(seen.v.low, v), v};
    report(k, v, out, fresh, bricks);
  }
  seen_ = seen;
  seen_depth_ = k;
  return seen.v.low <= seen.v.high;
}

void Face3D::report(std::int64_t k, std::int64_t v, const std::uint64_t* found, std::vector<std::uint64_t>& fresh,
                    std::vector<std::size_t>& bricks) {
  // Edges shared with a face earlier in the order x, y, z belong to that face.
  const bool u_edge_foreign = axis_ != 0;  // u is x
  const bool v_edge_foreign = axis_ == 2;  // v is y
  if (v_edge_foreign && (v == k || v == -k)) return;
  const BrickRow at = brick_row(k, v);
  for (std::size_t w = 0; w < words_; ++w) {
    std::uint64_t bits = found[w];
    if (bits == 0) continue;
    if (u_edge_foreign) {
      for (const std::int64_t edge : {-k, k}) {
        const std::int64_t b = edge - u_base_ - static_cast<std::int64_t>(64 * w);
        if (b >= 0 && b < 64) bits &= ~(std::uint64_t{1} << b);
      }
    }
    while (bits != 0) {
      const int nibble = std::countr_zero(bits) >> 2;
      const std::uint64_t four = (bits >> (4 * nibble)) & 0xFu;
      bits &= ~(std::uint64_t{0xF} << (4 * nibble));
      const std::size_t brick = at.first + at.stride * (16 * w + static_cast<std::size_t>(nibble));
      const std::uint64_t cells = (axis_ == 0 ? spread(four) : four) << at.shift;
      grid_->visible[brick] |= cells;
      if (fresh[brick] == 0) bricks.push_back(brick);
      fresh[brick] |= cells;
    }
  }
}

void Face3D::gather_opaque(std::int64_t k, std::int64_t v, std::size_t w0, std::size_t w1, std::uint64_t* out) const {
  const BrickRow at = brick_row(k, v);
  const std::size_t count = static_cast<std::size_t>((u_.high - u_base_) / 4 + 1);
  for (std::size_t w = w0; w <= w1; ++w) {
    std::uint64_t bits = 0;
    const std::size_t end = std::min<std::size_t>(16, count - 16 * w);
    for (std::size_t nibble = 0; nibble < end; ++nibble) {
      const std::uint64_t word = grid_->opaque[at.first + at.stride * (16 * w + nibble)] >> at.shift;
      bits |= (axis_ == 0 ? squeeze(word) : word & 0xFu) << (4 * nibble);
    }
    out[w] = bits;
  }
}

}  // namespace gridcull
