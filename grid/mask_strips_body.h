// How the kernels walk over strips of eight pixel rows and their blocks; part of mask_kernels_body.h.

#include "gridcull/grid/mask_kernels.h"

// What is between a strip's spans and its words has to stay in registers.
#define GRIDCULL_MASK_INLINE inline __attribute__((always_inline))

namespace gridcull::masking::GRIDCULL_MASK_SET {
namespace {

int ceil_within(double x, int limit) { return x <= 0.0 ? 0 : x >= limit ? limit : round_up(x); }
/// -1 for whatever lies below 0.
int floor_within(double x, int limit) { return x < 0.0 ? -1 : x >= limit ? limit : round_down(x); }

/// Pixel columns [x0, x1) and rows [y0, y1) that a shape may reach.
struct Extent {
  int x0, x1, y0, y1;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
};

/// Bits of coarse word k of a strip: blocks in [first, last] that are not full.
std::uint64_t open_blocks(const Window& window, int strip, int k, int first, int last) {
  const int low = first - 64 * k, high = last - 64 * k;
  if (high < 0 || low > 63) return 0;
  const std::uint64_t range =
      (~std::uint64_t{0} << (low > 0 ? low : 0)) & (~std::uint64_t{0} >> (high < 63 ? 63 - high : 0));
  return range & ~window.full[strip * window.coarse + k];
}

/// Narrows [first, last] to the blocks that the spans of a strip really reach.
void narrow(const Ints& from, const Ints& to, int& first, int& last) {
  int a[8], b[8];
  store(a, from), store(b, to);
  int low = 64 * last + 63, high = 64 * first;
  for (int k = 0; k < 8; ++k) {
    if (a[k] >= b[k]) continue;
    if (a[k] < low) low = a[k];
    if (b[k] - 1 > high) high = b[k] - 1;
  }
  if (low / 64 > first) first = low / 64;
  if (high / 64 < last) last = high / 64;
}

/// Goes through the blocks of an extent that are not full. spans(rows, from, to) gives the columns [from, to) of
/// eight rows; use(strip, block, bits) gets what of them lies in a block and ends the walk with true.
template <class Spans, class Use>
GRIDCULL_MASK_INLINE bool each_open(const Window& window, const Extent& e, std::uint64_t& strips, const Spans& spans,
                                    const Use& use) {
  const int first = e.x0 / 64, last = (e.x1 - 1) / 64;
  const bool wide = last - first >= 4;
  for (int strip = e.y0 / 8; 8 * strip < e.y1; ++strip) {
    std::uint64_t open[2] = {open_blocks(window, strip, 0, first, last),
                             window.coarse > 1 ? open_blocks(window, strip, 1, first, last) : 0};
    if ((open[0] | open[1]) == 0) continue;
    ++strips;
    const int top = 8 * strip;
    Ints from, to;
    spans(splat(top) + iota(), from, to);
    if (top < e.y0 || top + 8 > e.y1) to = keep(to, e.y0 - top, e.y1 - top);
    if (wide) {  // worth it for long slanted shapes
      int low = first, high = last;
      narrow(from, to, low, high);
      for (int k = 0; k < window.coarse; ++k) open[k] = open_blocks(window, strip, k, low, high);
    }
    for (int k = 0; k < window.coarse; ++k) {
      for (; open[k] != 0; open[k] &= open[k] - 1) {
        const int block = 64 * k + __builtin_ctzll(open[k]);
        if (use(strip, block, span(from, to, 64 * block))) return true;
      }
    }
  }
  return false;
}

/// Sets bits of a block; returns whether it is full now.
GRIDCULL_MASK_INLINE bool cover_block(Window& window, int strip, int block, const Words& bits) {
  std::uint64_t* const words = window.words + 8 * (strip * window.blocks + block);
  const Words now = load(words) | bits;
  store(words, now);
  const std::uint64_t columns = common(now);
  window.columns[strip * window.blocks + block] = columns;
  if (columns != ~std::uint64_t{0}) return false;
  window.full[strip * window.coarse + block / 64] |= std::uint64_t{1} << (block % 64);
  return true;
}

template <class Spans>
GRIDCULL_MASK_INLINE int cover_strips(Window& window, const Extent& e, std::uint64_t& strips, const Spans& spans) {
  int filled = 0;
  each_open(window, e, strips, spans, [&](int strip, int block, const Words& bits) {
    filled += cover_block(window, strip, block, bits);
    return false;
  });
  window.open_blocks -= filled;
  return filled;
}

template <class Spans>
GRIDCULL_MASK_INLINE bool open_strips(const Window& window, const Extent& e, std::uint64_t& strips,
                                      const Spans& spans) {
  return each_open(window, e, strips, spans, [&](int strip, int block, const Words& bits) {
    return any_beyond(bits, load(window.words + 8 * (strip * window.blocks + block)));
  });
}

/// Columns [up(low), down(high)) of eight rows: whole pixels between the two.
void whole_pixels(const Window& window, const Lanes& low, const Lanes& high, Ints& from, Ints& to) {
  const Lanes zero = splat(0.0), width = splat(window.width);
  from = round_up(smaller(larger(low, zero), width));
  to = round_down(smaller(larger(high, zero), width));
}

/// Columns [down(low), down(high) + 1) of eight rows: pixels touched.
void touched_pixels(const Window& window, const Lanes& low, const Lanes& high, Ints& from, Ints& to) {
  const Lanes zero = splat(0.0);
  from = round_down(smaller(larger(low, zero), splat(window.width)));
  to = add(round_down(smaller(larger(high, splat(-1.0)), splat(window.width - 0.5))), 1);
}

Extent whole_extent(const Window& window, double x0, double x1, double y0, double y1) {
  const int right = floor_within(x1, window.width), high = floor_within(y1, window.height);
  return {ceil_within(x0, window.width), right, ceil_within(y0, window.height), high};
}

Extent touched_extent(const Window& window, double x0, double x1, double y0, double y1) {
  const int left = floor_within(x0, window.width), low = floor_within(y0, window.height);
  return {left > 0 ? left : 0, floor_within(x1, window.width - 1) + 1, low > 0 ? low : 0,
          floor_within(y1, window.height - 1) + 1};
}

}  // namespace
}  // namespace gridcull::masking::GRIDCULL_MASK_SET
