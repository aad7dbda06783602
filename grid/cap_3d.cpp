// Occluder extension and occlusion in 3D (Batagelo and Wu 2002, section 5.3).
//
// The paper vectorises the bitmap of a shell's plane to cap polygons with holes and extrudes them away from
// the viewpoint, sampling each cross section at cell centres. Here a cap is kept as runs of bits, row by
// row, which is that polygon in scanline form with its holes; the vertices are still the cells' centres.
//
// Claim. Let C be cells of plane k, each opaque or hidden. Cell (n, u, v), n > k, is hidden from every point
// of the viewer's cell when the up to four cells of C's plane around (u k / n, v k / n), that is floor and
// ceil in both coordinates, all belong to C. Proof: as in hide_2d.h; the point at t = k / n of any segment
// between the two cells lies within half a cell of (k, u k / n, v k / n) in each of the three axes, hence in
// those four cells. Holes need no care: a footprint that meets one is not in C.
//
// For a run [a, b] of cells that rows r and r + 1 both have, these are the cells with r <= v k / n <= r + 1
// and a <= u k / n <= b: one run of bits in each of a few rows. Cost: two divisions a run and plane, and one
// word or two a row.
#include <algorithm>

#include "gridcull/grid/division.h"
#include "gridcull/grid/face_3d.h"

namespace gridcull {

void Face3D::occlude(std::int64_t k, WorkCounts& work) {
  if (k == depth_.high || !find_caps(k)) return;
  list_runs();
  extrude(k, work);
}

bool Face3D::find_caps(std::int64_t k) {
  // Caps grow within the visible part and one cell around it: what lies farther out is out of view or hidden
  // already, and so is what it would hide.
  const Patch whole = plane_patch(k);
  grown_ = {intersect(whole.u, {seen_.u.low - 1, seen_.u.high + 1}),
            intersect(whole.v, {seen_.v.low - 1, seen_.v.high + 1})};
  const auto rows = static_cast<std::size_t>(grown_.v.high - grown_.v.low + 1);
  const auto w0 = static_cast<std::size_t>(bit(grown_.u.low)) / 64,
             w1 = static_cast<std::size_t>(bit(grown_.u.high)) / 64;
  solid_.assign(rows * words_, 0);
  cap_.assign(rows * words_, 0);
  std::uint64_t any = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::int64_t v = grown_.v.low + static_cast<std::int64_t>(r);
    std::uint64_t* solid = solid_.data() + r * words_;
    std::uint64_t* cap = cap_.data() + r * words_;
    gather_opaque(k, v, w0, w1, solid);
    const std::uint64_t* found = found_.data() + static_cast<std::size_t>(v - whole.v.low) * words_;
    const std::uint64_t* hidden = row(k, v);
    for (std::size_t w = w0; w <= w1; ++w) {
      cap[w] = solid[w] & found[w];
      any |= cap[w];
      const int low = std::max<int>(0, bit(grown_.u.low) - static_cast<int>(64 * w));
      const int high = std::min<int>(63, bit(grown_.u.high) - static_cast<int>(64 * w));
      solid[w] = (solid[w] | hidden[w]) & bit_range(low, high);
    }
  }
  if (any == 0) return false;
  grow_caps(static_cast<std::int64_t>(rows));
  return true;
}

void Face3D::grow_caps(std::int64_t rows) {
  // Flood fill over face-connected cells, a row at a time, down and up until nothing changes.
  const auto fill = [&](std::int64_t r, std::int64_t from) {
    std::uint64_t* cap = cap_.data() + static_cast<std::size_t>(r) * words_;
    const std::uint64_t* solid = solid_.data() + static_cast<std::size_t>(r) * words_;
    const std::uint64_t* beside =
        from < 0 || from >= rows ? nullptr : cap_.data() + static_cast<std::size_t>(from) * words_;
    bool changed = false;
    std::uint64_t seeds = 0;
    for (std::size_t w = 0; w < words_; ++w) {
      if (beside != nullptr) cap[w] |= beside[w] & solid[w];
      seeds |= cap[w];
    }
    if (seeds == 0) return false;
    for_each_run({solid, words_}, [&](int first, int last) {
      bool some = false, all = true;
      for (int w = first >> 6; w <= last >> 6; ++w) {
        const std::uint64_t mask = bit_range(w == first >> 6 ? first & 63 : 0, w == last >> 6 ? last & 63 : 63);
        some = some || (cap[w] & mask) != 0;
        all = all && (cap[w] & mask) == mask;
      }
      if (!some || all) return;
      set_run(cap, first, last);
      changed = true;
    });
    return changed;
  };
  for (std::int64_t r = 0; r < rows; ++r) fill(r, r - 1);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::int64_t r = rows - 1; r >= 0; --r) changed = fill(r, r + 1) || changed;
    if (!changed) break;
    changed = false;
    for (std::int64_t r = 0; r < rows; ++r) changed = fill(r, r - 1) || changed;
  }
}

void Face3D::list_runs() {
  runs_.clear();
  axis_runs_.clear();
  const std::int64_t rows = grown_.v.high - grown_.v.low + 1;
  solid_.resize(std::max(solid_.size(), words_));
  for (std::int64_t r = 0; r < rows; ++r) {
    const std::uint64_t* here = cap_.data() + static_cast<std::size_t>(r) * words_;
    const std::int64_t v = grown_.v.low + r;
    // A single column or row hides whole cells only on the axis itself, where u k / n or v k / n stays whole.
    const auto keep = [&](std::vector<Run>& runs) {
      return [&](int first, int last) {
        const std::int64_t a = u_base_ + first, b = u_base_ + last;
        if (a < b || a == 0) runs.push_back({v, a, b});
      };
    };
    if (v == 0) for_each_run({here, words_}, keep(axis_runs_));
    if (r + 1 == rows) break;
    std::uint64_t* both = solid_.data();  // its contents are no longer needed
    std::uint64_t any = 0;
    for (std::size_t w = 0; w < words_; ++w) any |= both[w] = here[w] & here[w + words_];
    if (any != 0) for_each_run({both, words_}, keep(runs_));
  }
}

void Face3D::extrude(std::int64_t k, WorkCounts& work) {
  if (runs_.empty() && axis_runs_.empty()) return;
  ++work.occluders;
  for (std::int64_t n = k + 1; n <= depth_.high; ++n) {
    const Patch plane = plane_patch(n);
    const auto mark = [&](const Run& run, const CellRange& rows) {
      const CellRange v = intersect(rows, plane.v);
      const CellRange u = intersect({ceil_div(run.low * n, k), floor_div(run.high * n, k)}, plane.u);
      if (u.empty() || v.empty()) return;
      std::uint64_t* out = row(n, v.low);
      for (std::int64_t i = v.low; i <= v.high; ++i, out += words_) set_run(out, bit(u.low), bit(u.high));
      work.rasters += static_cast<std::uint64_t>(v.high - v.low + 1);
    };
    for (const Run& run : runs_) mark(run, {ceil_div(run.row * n, k), floor_div((run.row + 1) * n, k)});
    for (const Run& run : axis_runs_) mark(run, {0, 0});
  }
}

}  // namespace gridcull
