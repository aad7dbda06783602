// The kernels of the coverage mask, written once over eight lanes. Included by mask_kernels_*.cpp, each after the
// lanes of its instruction set, with GRIDCULL_MASK_SET naming their namespace. Nothing of the standard library:
// an inline function compiled here for wide registers must not be the one that the rest of the program links to.
//
// A lane is a corner of the polygon, then an edge of it, then one of the eight pixel rows of a strip of blocks.
// Why the answers are conservative stands in coverage_mask.cpp.

#include "gridcull/grid/mask_kernels.h"

namespace gridcull::masking::GRIDCULL_MASK_SET {
namespace {

/// Added and taken away again it rounds to multiples of 2^-32; right for magnitudes below 2^19.
constexpr double snap = 1.5 * 0x1p20;
/// The largest coordinate of a direction over its depth within which the margins hold.
constexpr double steepest = 16.0;

int ceil_within(double x, int limit) { return x <= 0.0 ? 0 : x >= limit ? limit : round_up(x); }
/// -1 for whatever lies below 0.
int floor_within(double x, int limit) { return x < 0.0 ? -1 : x >= limit ? limit : round_down(x); }

struct Projected {
  Lanes x, y, w, size;
};

Lanes form(const double* f, const Lanes& x, const Lanes& y, const Lanes& z) {
  return (splat(f[0]) * x + splat(f[1]) * y) + splat(f[2]) * z;
}

Projected apply_forms(const Window& window, const Lanes& x, const Lanes& y, const Lanes& z) {
  return {form(window.form_x, x, y, z), form(window.form_y, x, y, z), form(window.form_w, x, y, z),
          larger(larger(magnitude(x), magnitude(y)), magnitude(z))};
}

/// Which of the four sides all rays so far are beyond.
struct Beyond {
  unsigned left = 255, right = 255, low = 255, high = 255;

  void add(const Window& window, const Projected& p) {
    const Lanes zero = splat(0.0);
    const Lanes slack_x = splat(window.slack_x) * p.size, slack_y = splat(window.slack_y) * p.size;
    left &= bits(p.x + slack_x < zero);
    right &= bits((splat(window.width) * p.w - p.x) + slack_x < zero);
    low &= bits(p.y + slack_y < zero);
    high &= bits((splat(window.height) * p.w - p.y) + slack_y < zero);
  }
  bool any() const { return left == 255 || right == 255 || low == 255 || high == 255; }
};

Projection project(const Window& window, const double* rays, int count, Polygon& out) {
  Beyond beyond;
  unsigned inside = 255;
  const Lanes zero = splat(0.0);
  for (int k = 0; k < count; k += 8) {
    Lanes x, y, z;
    load_rays(rays + 3 * k, count - k < 8 ? count - k : 8, x, y, z);
    const Projected p = apply_forms(window, x, y, z);
    beyond.add(window, p);
    const Lanes u = p.x / p.w, v = p.y / p.w;
    const Lanes off_x = magnitude(u - splat(0.5 * window.width)), off_y = magnitude(v - splat(0.5 * window.height));
    inside &= bits((zero < p.w) & (off_x <= splat(window.guard_x)) & (off_y <= splat(window.guard_y)));
    store(out.x + k, (u + splat(snap)) - splat(snap));
    store(out.y + k, (v + splat(snap)) - splat(snap));
  }
  out.count = count;
  out.margin_x = window.margin_x, out.margin_y = window.margin_y;
  if (beyond.any()) return Projection::outside;
  return inside == 255 ? Projection::inside : Projection::crossing;
}

Projection project_box(const Window& window, const double* low, const double* high, Rectangle& out) {
  static constexpr double bit0[8] = {0, 1, 0, 1, 0, 1, 0, 1}, bit1[8] = {0, 0, 1, 1, 0, 0, 1, 1},
                          bit2[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  const Lanes half = splat(0.5);
  const Lanes x = select(load(bit0) < half, splat(low[0]), splat(high[0]));
  const Lanes y = select(load(bit1) < half, splat(low[1]), splat(high[1]));
  const Lanes z = select(load(bit2) < half, splat(low[2]), splat(high[2]));
  const Projected p = apply_forms(window, x, y, z);
  Beyond beyond;
  beyond.add(window, p);
  if (beyond.any()) return Projection::outside;
  if (bits((splat(0.0) < p.w) & (p.size <= splat(steepest) * p.w)) != 255) return Projection::crossing;
  const Lanes u = p.x / p.w, v = p.y / p.w;
  out.x0 = floor_within(lowest(u) - window.margin_x, window.width);
  out.x1 = floor_within(highest(u) + window.margin_x, window.width - 1) + 1;
  out.y0 = floor_within(lowest(v) - window.margin_y, window.height);
  out.y1 = floor_within(highest(v) + window.margin_y, window.height - 1) + 1;
  if (out.x0 < 0) out.x0 = 0;
  if (out.y0 < 0) out.y0 = 0;
  return out.x0 < out.x1 && out.y0 < out.y1 ? Projection::inside : Projection::outside;
}

// Strips and blocks.

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

bool any_open(const Window& window, int strip, int first, int last) {
  std::uint64_t open = 0;
  for (int k = 0; k < window.coarse; ++k) open |= open_blocks(window, strip, k, first, last);
  return open != 0;
}

/// Calls f(block) for the blocks of a strip in [first, last] that are not full, until it says true.
template <class F>
bool each_open(const Window& window, int strip, int first, int last, F&& f) {
  for (int k = 0; k < window.coarse; ++k) {
    for (std::uint64_t open = open_blocks(window, strip, k, first, last); open != 0; open &= open - 1) {
      if (f(64 * k + __builtin_ctzll(open))) return true;
    }
  }
  return false;
}

/// Narrows [first, last] to the blocks that the spans of a strip really reach: worth it for long slanted shapes.
void narrow(const Ints& from, const Ints& to, int& first, int& last) {
  if (last - first < 4) return;
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

int fill(Window& window, int strip, const Ints& from, const Ints& to, int first, int last) {
  int filled = 0;
  narrow(from, to, first, last);
  each_open(window, strip, first, last, [&](int block) {
    std::uint64_t* const words = window.words + 8 * (strip * window.blocks + block);
    const Words now = load(words) | span(from, to, 64 * block);
    store(words, now);
    if (all_ones(now)) {
      window.full[strip * window.coarse + block / 64] |= std::uint64_t{1} << (block % 64);
      ++filled;
    }
    return false;
  });
  return filled;
}

bool open_within(const Window& window, int strip, const Ints& from, const Ints& to, int first, int last) {
  narrow(from, to, first, last);
  return each_open(window, strip, first, last, [&](int block) {
    const Words words = load(window.words + 8 * (strip * window.blocks + block));
    return any_beyond(span(from, to, 64 * block), words);
  });
}

/// Goes through the strips of an extent that are not full yet. spans(rows, from, to) gives the columns
/// [from, to) of eight rows; use(strip, from, to, first, last) works on the blocks and ends the walk with true.
template <class Spans, class Use>
bool each_strip(const Window& window, const Extent& e, std::uint64_t& strips, Spans&& spans, Use&& use) {
  const int first = e.x0 / 64, last = (e.x1 - 1) / 64;
  for (int strip = e.y0 / 8; 8 * strip < e.y1; ++strip) {
    if (!any_open(window, strip, first, last)) continue;
    ++strips;
    const int top = 8 * strip;
    Ints from, to;
    spans(splat(top) + iota(), from, to);
    if (top < e.y0 || top + 8 > e.y1) to = keep(to, e.y0 - top, e.y1 - top);
    if (use(strip, from, to, first, last)) return true;
  }
  return false;
}

template <class Spans>
int cover_strips(Window& window, const Extent& e, std::uint64_t& strips, Spans&& spans) {
  int filled = 0;
  each_strip(window, e, strips, spans, [&](int strip, const Ints& from, const Ints& to, int first, int last) {
    filled += fill(window, strip, from, to, first, last);
    return false;
  });
  window.open_blocks -= filled;
  return filled;
}

template <class Spans>
bool open_strips(const Window& window, const Extent& e, std::uint64_t& strips, Spans&& spans) {
  return each_strip(window, e, strips, spans, [&](int strip, const Ints& from, const Ints& to, int first, int last) {
    return open_within(window, strip, from, to, first, last);
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

// Polygons.

enum class Side { within, around };  // under-estimate or over-estimate

struct Edges {
  alignas(64) double base[max_vertices];   ///< x where the edge's line meets row 0's lower or upper edge
  alignas(64) double slope[max_vertices];  ///< dx/dy
  int left[max_vertices], right[max_vertices];
  int lefts = 0, rights = 0;
};

/// Twice the signed area, up to rounding: only its sign is used, and a wrong sign costs tightness alone.
double area_of(const Polygon& p, int padded) {
  Lanes total = splat(0.0);
  const Lanes x0 = splat(p.x[0]), y0 = splat(p.y[0]);
  for (int k = 0; k < padded; k += 8) {
    const int next = k + 8 < padded ? k + 8 : 0;
    const Lanes xa = load(p.x + k), ya = load(p.y + k);
    const Lanes xb = shift_in(xa, load(p.x + next)), yb = shift_in(ya, load(p.y + next));
    total = total + ((xa - x0) * (yb - y0) - (xb - x0) * (ya - y0));
  }
  return sum(total);
}

/// How far (in x) a line must go left, or right, to have every corner on its inner side.
void push_lines(const Polygon& p, const Lanes& base, const Lanes& slope, Lanes& leftward, Lanes& rightward) {
  leftward = rightward = splat(0.0);
  for (int k = 0; k < p.count; ++k) {
    const Lanes beyond = (base + slope * splat(p.y[k])) - splat(p.x[k]);
    leftward = larger(leftward, beyond);
    rightward = smaller(rightward, beyond);
  }
}

void list_bits(unsigned set, int offset, int* list, int& count) {
  for (; set != 0; set &= set - 1) list[count++] = offset + __builtin_ctz(set);
}

/// Edges as lines x = base + slope * j at the pixel row's edge that matters: within, the one where the line
/// cuts deepest; around, the other.
void set_edges(const Polygon& p, Side side, Edges& out) {
  const int padded = (p.count + 7) & ~7;
  const Lanes zero = splat(0.0), lower = splat(-p.margin_y), upper = splat(1.0 + p.margin_y);
  const double area = area_of(p, padded);
  const Mask all = zero <= zero, none = zero < zero;
  const Mask clockwise = area < 0.0 ? all : none, outer = side == Side::around ? all : none;
  const Lanes inward = splat(side == Side::within ? p.margin_x : -p.margin_x);
  for (int k = 0; k < padded; k += 8) {
    const int next = k + 8 < padded ? k + 8 : 0;
    const Lanes xa = load(p.x + k), ya = load(p.y + k);
    const Lanes dx = shift_in(xa, load(p.x + next)) - xa, dy = shift_in(ya, load(p.y + next)) - ya;
    const Mask up = zero < dy, down = dy < zero;
    const Lanes slope = select(up ^ down, dx / select(up ^ down, dy, splat(1.0)), zero);
    const Mask is_right = up ^ clockwise;  // of the edges that are not level
    const Mask at_upper = ((zero <= slope) ^ is_right) ^ outer;
    const Lanes at = select(at_upper, upper, lower);
    Lanes base;
    if (side == Side::within) {
      base = xa + (at - ya) * slope;
    } else {
      const Lanes level = xa - ya * slope;
      Lanes leftward, rightward;
      push_lines(p, level, slope, leftward, rightward);
      base = (level - select(is_right, rightward, leftward)) + at * slope;
    }
    base = select(is_right, base - inward, base + inward);
    store(out.base + k, base);
    store(out.slope + k, slope);
    const unsigned slanted = bits(up ^ down), right = bits(is_right);
    list_bits(slanted & ~right, k, out.left, out.lefts);
    list_bits(slanted & right, k, out.right, out.rights);
  }
}

void bounds_of(const Polygon& p, double& x0, double& x1, double& y0, double& y1) {
  Lanes low_x = load(p.x), high_x = low_x, low_y = load(p.y), high_y = low_y;
  for (int k = 8; k < p.count; k += 8) {
    const Lanes x = load(p.x + k), y = load(p.y + k);
    low_x = smaller(low_x, x), high_x = larger(high_x, x), low_y = smaller(low_y, y), high_y = larger(high_y, y);
  }
  x0 = lowest(low_x), x1 = highest(high_x), y0 = lowest(low_y), y1 = highest(high_y);
}

/// The span of eight rows between the lines, starting from `low` and `high`.
void between(const Edges& edges, const Lanes& rows, Lanes& low, Lanes& high) {
  for (int i = 0; i < edges.lefts; ++i) {
    const int k = edges.left[i];
    low = larger(low, splat(edges.base[k]) + rows * splat(edges.slope[k]));
  }
  for (int i = 0; i < edges.rights; ++i) {
    const int k = edges.right[i];
    high = smaller(high, splat(edges.base[k]) + rows * splat(edges.slope[k]));
  }
}

int cover_polygon(Window& window, const Polygon& p, std::uint64_t& strips) {
  double x0, x1, y0, y1;
  bounds_of(p, x0, x1, y0, y1);
  const Extent e = whole_extent(window, x0 + p.margin_x, x1 - p.margin_x, y0 + p.margin_y, y1 - p.margin_y);
  if (e.empty()) return 0;
  Edges edges;
  set_edges(p, Side::within, edges);
  return cover_strips(window, e, strips, [&](const Lanes& rows, Ints& from, Ints& to) {
    Lanes low = splat(0.0), high = splat(window.width);
    between(edges, rows, low, high);
    whole_pixels(window, low, high, from, to);
  });
}

bool open_polygon(const Window& window, const Polygon& p, std::uint64_t& strips) {
  double x0, x1, y0, y1;
  bounds_of(p, x0, x1, y0, y1);
  const Extent e = touched_extent(window, x0 - p.margin_x, x1 + p.margin_x, y0 - p.margin_y, y1 + p.margin_y);
  if (e.empty()) return false;
  Edges edges;
  set_edges(p, Side::around, edges);
  const Lanes left = splat(x0 - p.margin_x), right = splat(x1 + p.margin_x);
  return open_strips(window, e, strips, [&](const Lanes& rows, Ints& from, Ints& to) {
    Lanes low = left, high = right;
    between(edges, rows, low, high);
    touched_pixels(window, low, high, from, to);
  });
}

// Ellipses.

/// Where the outline crosses height y: middle -+ half.
void cut(const Ellipse& o, const Lanes& y, Lanes& middle, Lanes& half) {
  const Lanes inside = (splat(o.high_y) - y) * (y - splat(o.low_y));
  middle = splat(o.alpha) + splat(o.beta) * y;
  half = splat(o.gamma) * root(larger(inside, splat(0.0)));
}

int cover_ellipse(Window& window, const Ellipse& o, std::uint64_t& strips) {
  const Extent e = whole_extent(window, o.low_x, o.high_x, o.low_y, o.high_y);
  if (e.empty()) return 0;
  return cover_strips(window, e, strips, [&](const Lanes& rows, Ints& from, Ints& to) {
    Lanes middle0, half0, middle1, half1;
    cut(o, rows, middle0, half0);
    cut(o, rows + splat(1.0), middle1, half1);
    const Lanes low = larger(middle0 - half0, middle1 - half1), high = smaller(middle0 + half0, middle1 + half1);
    whole_pixels(window, low, high, from, to);
  });
}

bool open_ellipse(const Window& window, const Ellipse& o, std::uint64_t& strips) {
  const Extent e = touched_extent(window, o.low_x, o.high_x, o.low_y, o.high_y);
  if (e.empty()) return false;
  const Lanes tolerance = splat(o.tolerance);
  return open_strips(window, e, strips, [&](const Lanes& rows, Ints& from, Ints& to) {
    const Lanes y0 = larger(rows, splat(o.low_y)), y1 = smaller(rows + splat(1.0), splat(o.high_y));
    Lanes middle0, half0, middle1, half1;
    cut(o, y0, middle0, half0);
    cut(o, y1, middle1, half1);
    const auto holds = [&](double y) { return (y0 - tolerance <= splat(y)) & (splat(y) <= y1 + tolerance); };
    const Lanes low = smaller(middle0 - half0, middle1 - half1), high = larger(middle0 + half0, middle1 + half1);
    touched_pixels(window, select(holds(o.y_at_low_x), splat(o.low_x), low),
                   select(holds(o.y_at_high_x), splat(o.high_x), high), from, to);
  });
}

bool open_rectangle(const Window& window, const Rectangle& r, std::uint64_t& strips) {
  const Extent e{r.x0, r.x1, r.y0, r.y1};
  const Ints zero = round_down(splat(0.0));
  return open_strips(window, e, strips, [&](const Lanes&, Ints& from, Ints& to) {
    from = add(zero, r.x0);
    to = add(zero, r.x1);
  });
}

}  // namespace

const Kernels& kernels() {
  static constexpr Kernels table{project,      project_box,  cover_polygon, cover_ellipse,
                                 open_polygon, open_ellipse, open_rectangle};
  return table;
}

}  // namespace gridcull::masking::GRIDCULL_MASK_SET
