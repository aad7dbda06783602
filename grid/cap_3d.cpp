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
// A block is rows r .. s, s > r, that all have the cells a .. b along u. What it hides are the cells with
// r <= v k / n <= s and a <= u k / n <= b: one run of bits in each of a few rows. Cost: four additions a block
// and plane, and a word or two a row.
#include <algorithm>
#include <utility>

#include "gridcull/grid/face_3d.h"
#include "gridcull/grid/scaled.h"

namespace gridcull {

void Face3D::occlude(std::int64_t k, WorkCounts& work) {
  if (k == depth_.high) return;
  const bool caps = find_caps(k);
  // Shadows of different caps that meet in this plane hide more together. One step each plane is enough: what
  // it hides in the next plane takes part in the step after.
  list_blocks(solid_);
  for (const Block& block : blocks_) work.rasters += extrude(block, k, k + 1);
  if (!caps) return;
  list_blocks(cap_);
  work.occluders += blocks_.size();
  for (const Block& block : blocks_) work.rasters += extrude(block, k, depth_.high);
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
  seeds_.assign(rows * words_, 0);
  near_.assign(words_, 0);
  std::uint64_t any = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const std::int64_t v = grown_.v.low + static_cast<std::int64_t>(r);
    std::uint64_t* solid = solid_.data() + r * words_;
    std::uint64_t* cap = seeds_.data() + r * words_;
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

// A cap grows from its opaque visible cells to all opaque or hidden cells joined to them along u, in their own
// rows and `reach` rows to both sides.
void Face3D::grow_caps(std::int64_t rows) {
  const auto seeds_near = [&](std::int64_t r, std::size_t w) {
    std::uint64_t near = 0;
    for (std::int64_t i = std::max<std::int64_t>(0, r - reach); i <= std::min(rows - 1, r + reach); ++i) {
      near |= seeds_[static_cast<std::size_t>(i) * words_ + w];
    }
    return near;
  };
  for (std::int64_t r = 0; r < rows; ++r) {
    const std::uint64_t* solid = solid_.data() + static_cast<std::size_t>(r) * words_;
    std::uint64_t* cap = cap_.data() + static_cast<std::size_t>(r) * words_;
    std::uint64_t any = 0;
    for (std::size_t w = 0; w < words_; ++w) any |= near_[w] = seeds_near(r, w) & solid[w];
    if (any == 0) continue;
    for_each_run({solid, words_}, [&](int first, int last) {
      std::uint64_t met = 0;
      for (int w = first >> 6; w <= last >> 6; ++w) {
        met |= near_[static_cast<std::size_t>(w)] &
               bit_range(w == first >> 6 ? first & 63 : 0, w == last >> 6 ? last & 63 : 63);
      }
      if (met != 0) set_run(cap, first, last);
    });
  }
}

// A single column or row hides whole cells only on the axis itself, where u k / n or v k / n stays whole.
void Face3D::list_blocks(const std::vector<std::uint64_t>& bits) {
  blocks_.clear();
  open_ = 0;
  const std::int64_t rows = grown_.v.high - grown_.v.low + 1;
  std::uint64_t* both = near_.data();
  for (std::int64_t r = 0; r < rows; ++r) {
    const std::uint64_t* here = bits.data() + static_cast<std::size_t>(r) * words_;
    const std::int64_t v = grown_.v.low + r;
    if (v == 0) {
      const std::size_t before = blocks_.size();
      for_each_run({here, words_}, [&](int first, int last) {
        const std::int64_t a = u_base_ + first, b = u_base_ + last;
        if (a < b || a == 0) blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(open_), {0, 0, a, b});
      });
      open_ += blocks_.size() - before;
    }
    if (r + 1 == rows) break;
    std::uint64_t any = 0;
    for (std::size_t w = 0; w < words_; ++w) any |= both[w] = here[w] & here[w + words_];
    if (any != 0)
      for_each_run({both, words_}, [&](int first, int last) { add_run(v, u_base_ + first, u_base_ + last); });
    // Blocks that did not grow by this row are closed: move the open ones to the back.
    for (std::size_t i = open_; i < blocks_.size(); ++i) {
      if (blocks_[i].v_high != v + 1) std::swap(blocks_[i], blocks_[open_++]);
    }
  }
}

void Face3D::add_run(std::int64_t v, std::int64_t low, std::int64_t high) {
  if (low == high && low != 0) return;
  for (std::size_t i = open_; i < blocks_.size(); ++i) {
    Block& block = blocks_[i];
    if (block.v_high == v && block.low == low && block.high == high) {
      block.v_high = v + 1;
      return;
    }
  }
  blocks_.push_back({v, v + 1, low, high});
}

std::uint64_t Face3D::extrude(const Block& block, std::int64_t k, std::int64_t last) {
  ScaledUp u_low(block.low, k), v_low(block.v_low, k);
  ScaledDown u_high(block.high, k), v_high(block.v_high, k);
  std::uint64_t rows = 0;
  for (std::int64_t n = k + 1; n <= last; ++n) {
    const CellRange u = intersect({u_low.next(), u_high.next()}, u_), v = intersect({v_low.next(), v_high.next()}, v_);
    // |u| and |v| stay within n by themselves: they are at most k in plane k. What has left the window on a
    // side stays out.
    if (u.empty() || v.empty()) break;
    std::uint64_t* out = hidden_.data() + plane_[static_cast<std::size_t>(n - depth_.low)] +
                         static_cast<std::size_t>(v.low - std::max(v_.low, -n)) * words_;
    const int from = bit(u.low), to = bit(u.high);
    if (from >> 6 == to >> 6) {
      const std::uint64_t mask = bit_range(from & 63, to & 63);
      out += from >> 6;
      for (std::int64_t i = v.low; i <= v.high; ++i, out += words_) *out |= mask;
    } else {
      for (std::int64_t i = v.low; i <= v.high; ++i, out += words_) set_run(out, from, to);
    }
    rows += static_cast<std::uint64_t>(v.high - v.low + 1);
  }
  return rows;
}

}  // namespace gridcull
