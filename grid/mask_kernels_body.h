// The kernels of the coverage mask, written once over eight lanes. Included by mask_kernels_*.cpp, each after the
// lanes of its instruction set, with GRIDCULL_MASK_SET naming their namespace. Nothing of the standard library:
// an inline function compiled here for wide registers must not be the one that the rest of the program links to.
//
// A lane is a corner of the polygon, then an edge of it, then one of the eight pixel rows of a strip of blocks.
// Why the answers are conservative stands in coverage_mask.cpp.

#include "gridcull/grid/mask_kernels.h"
#include "gridcull/grid/mask_strips_body.h"

namespace gridcull::masking::GRIDCULL_MASK_SET {
namespace {

/// Added and taken away again it rounds to multiples of 2^-32; right for magnitudes below 2^19.
constexpr double snap = 1.5 * 0x1p20;
/// The largest coordinate of a direction over its depth within which the margins hold.
constexpr double steepest = 16.0;

struct Projected {
  Lanes x, y, w;
};

/// The largest coordinate of each direction.
Lanes size_of(const Lanes& x, const Lanes& y, const Lanes& z) {
  return larger(larger(magnitude(x), magnitude(y)), magnitude(z));
}

Lanes form(const double* f, const Lanes& x, const Lanes& y, const Lanes& z) {
  return (splat(f[0]) * x + splat(f[1]) * y) + splat(f[2]) * z;
}

Projected apply_forms(const Window& window, const Lanes& x, const Lanes& y, const Lanes& z) {
  return {form(window.form_x, x, y, z), form(window.form_y, x, y, z), form(window.form_w, x, y, z)};
}

/// Which of the four sides all rays so far are beyond.
struct Beyond {
  unsigned left = 255, right = 255, low = 255, high = 255;

  void add(const Window& window, const Projected& p, const Lanes& x, const Lanes& y, const Lanes& z) {
    const Lanes zero = splat(0.0), size = size_of(x, y, z);
    const Lanes slack_x = splat(window.slack_x) * size, slack_y = splat(window.slack_y) * size;
    left &= bits(p.x + slack_x < zero);
    right &= bits((splat(window.width) * p.w - p.x) + slack_x < zero);
    low &= bits(p.y + slack_y < zero);
    high &= bits((splat(window.height) * p.w - p.y) + slack_y < zero);
  }
  bool any() const { return left == 255 || right == 255 || low == 255 || high == 255; }
};

/// The slow half of project(): which cones touch no pixel for sure.
Projection outside_or_crossing(const Window& window, const double* rays, int count) {
  Beyond beyond;
  for (int k = 0; k < count; k += 8) {
    Lanes x, y, z;
    load_rays(rays + 3 * k, count - k < 8 ? count - k : 8, x, y, z);
    beyond.add(window, apply_forms(window, x, y, z), x, y, z);
  }
  return beyond.any() ? Projection::outside : Projection::crossing;
}

Projection project(const Window& window, const double* rays, int count, Polygon& out) {
  const Lanes middle_x = splat(0.5 * window.width), middle_y = splat(0.5 * window.height);
  for (int k = 0; k < count; k += 8) {
    Lanes x, y, z;
    load_rays(rays + 3 * k, count - k < 8 ? count - k : 8, x, y, z);
    const Projected p = apply_forms(window, x, y, z);
    if (bits(splat(0.0) < p.w) != 255) return outside_or_crossing(window, rays, count);
    const Lanes over_w = splat(1.0) / p.w, u = p.x * over_w, v = p.y * over_w;
    const Mask near_x = magnitude(u - middle_x) <= splat(window.guard_x);
    const Mask near_y = magnitude(v - middle_y) <= splat(window.guard_y);
    if (bits(near_x & near_y) != 255) return outside_or_crossing(window, rays, count);
    store(out.x + k, (u + splat(snap)) - splat(snap));
    store(out.y + k, (v + splat(snap)) - splat(snap));
  }
  out.count = count;
  out.margin_x = window.margin_x, out.margin_y = window.margin_y;
  return Projection::inside;
}

Projection project_box(const Window& window, const double* low, const double* high, Rectangle& out) {
  static constexpr double bit0[8] = {0, 1, 0, 1, 0, 1, 0, 1}, bit1[8] = {0, 0, 1, 1, 0, 0, 1, 1},
                          bit2[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  const Lanes half = splat(0.5);
  const Lanes x = select(load(bit0) < half, splat(low[0]), splat(high[0]));
  const Lanes y = select(load(bit1) < half, splat(low[1]), splat(high[1]));
  const Lanes z = select(load(bit2) < half, splat(low[2]), splat(high[2]));
  const Projected p = apply_forms(window, x, y, z);
  if (bits((splat(0.0) < p.w) & (size_of(x, y, z) <= splat(steepest) * p.w)) != 255) {
    Beyond beyond;
    beyond.add(window, p, x, y, z);
    return beyond.any() ? Projection::outside : Projection::crossing;
  }
  const Lanes over_w = splat(1.0) / p.w, u = p.x * over_w, v = p.y * over_w;
  out.x0 = floor_within(lowest(u) - window.margin_x, window.width);
  out.x1 = floor_within(highest(u) + window.margin_x, window.width - 1) + 1;
  out.y0 = floor_within(lowest(v) - window.margin_y, window.height);
  out.y1 = floor_within(highest(v) + window.margin_y, window.height - 1) + 1;
  if (out.x0 < 0) out.x0 = 0;
  if (out.y0 < 0) out.y0 = 0;
  return out.x0 < out.x1 && out.y0 < out.y1 ? Projection::inside : Projection::outside;
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
template <Side side>
void set_edges(const Polygon& p, Edges& out) {
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
  set_edges<Side::within>(p, edges);
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
  set_edges<Side::around>(p, edges);
  const Lanes left = splat(x0 - p.margin_x), right = splat(x1 + p.margin_x);
  return open_strips(window, e, strips, [&](const Lanes& rows, Ints& from, Ints& to) {
    Lanes low = left, high = right;
    between(edges, rows, low, high);
    touched_pixels(window, low, high, from, to);
  });
}

}  // namespace
}  // namespace gridcull::masking::GRIDCULL_MASK_SET

#include "gridcull/grid/mask_batch_body.h"
#include "gridcull/grid/mask_cone_body.h"

namespace gridcull::masking::GRIDCULL_MASK_SET {
namespace {

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

/// The columns of eight blocks, from `block` on, that a rectangle has.
Words columns_of(const Rectangle& r, int block) {
  const Lanes left = splat(64.0) * (splat(block) + iota());
  return span(round_down(splat(r.x0) - left), round_down(splat(r.x1) - left), 0);
}

/// A strip that the rectangle has some rows of.
bool open_rows(const Window& window, const Rectangle& r, int strip, int block) {
  const int top = 8 * strip, from = r.y0 > top ? r.y0 - top : 0, to = r.y1 < top + 8 ? r.y1 - top : 8;
  for (const int end = (r.x1 - 1) / 64 + 1; block < end; ++block) {
    const int left = r.x0 - 64 * block, right = 64 * block + 64 - r.x1;
    const std::uint64_t asked =
        (~std::uint64_t{0} << (left > 0 ? left : 0)) & (~std::uint64_t{0} >> (right > 0 ? right : 0));
    const std::uint64_t* const words = window.words + 8 * (strip * window.blocks + block);
    if (any_beyond(in_rows(asked, from, to), load(words))) return true;
  }
  return false;
}

/// Of rectangles in one or two blocks of a strip: block `first` and the one behind it, if need be.
bool open_narrow(const Window& window, const Rectangle& r, int first, std::uint64_t& strips) {
  const auto asked = [&](int left) {
    const int from = r.x0 - left > 0 ? r.x0 - left : 0, to = r.x1 - left < 64 ? r.x1 - left : 64;
    return from < to ? (~std::uint64_t{0} << from) & (~std::uint64_t{0} >> (64 - to)) : 0;
  };
  const std::uint64_t asked0 = asked(64 * first), asked1 = asked(64 * first + 64);
  const std::uint64_t* columns = window.columns + (r.y0 / 8 * window.blocks + first);
  for (int strip = r.y0 / 8; 8 * strip < r.y1; ++strip, columns += window.blocks) {
    if (((asked0 & ~columns[0]) | (asked1 & ~columns[1])) == 0) continue;
    ++strips;
    const bool whole = r.y0 <= 8 * strip && 8 * strip + 8 <= r.y1;
    if (whole || open_rows(window, r, strip, first)) return true;
  }
  return false;
}

// Eight blocks of a strip at a time: mostly their columns are covered over all eight rows wherever it is asked.
bool open_rectangle(const Window& window, const Rectangle& r, std::uint64_t& strips) {
  if (r.x0 >= r.x1) return false;
  const int first = r.x0 / 64;
  if (r.x1 <= 64 * first + 128) return open_narrow(window, r, first, strips);
  for (int block = first; 64 * block < r.x1; block += 8) {
    const Words asked = columns_of(r, block);
    for (int strip = r.y0 / 8; 8 * strip < r.y1; ++strip) {
      if (!any_beyond(asked, load(window.columns + (strip * window.blocks + block)))) continue;
      ++strips;
      const bool whole = r.y0 <= 8 * strip && 8 * strip + 8 <= r.y1;
      if (whole || open_rows(window, r, strip, block)) return true;
    }
  }
  return false;
}

}  // namespace

const Kernels& kernels() {
  static constexpr Kernels table{project,    project_box,   place_balls,  cover_polygon, span_cone,
                                 cover_cone, cover_ellipse, open_polygon, open_ellipse,  open_rectangle};
  return table;
}

}  // namespace gridcull::masking::GRIDCULL_MASK_SET
