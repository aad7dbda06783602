// Covering the cone of a few rays without projecting them: the planes through each two consecutive rays are turned into
// lines on each face (homogeneous edge functions: M. Olano and T. Greer, "Triangle scan conversion using 2D homogeneous
// coordinates", 1997), so that nothing is clipped. Part of mask_kernels_body.h. A lane is a ray, then the plane through
// it and the next one, then a pixel row.
//
// Claim. A pixel that is covered lies inside the cone K of the true rays r'. Let n_i = r_i x r_(i+1) as computed, all
// of them turned round where their sum says that the loop runs the other way, s_i the sum of magnitudes of r_i. A ray's
// coordinates err by 2^-40 of the largest, so r_i by sqrt(3) 2^-40 |r_i| and the true product by less than 2^-38
// s_i s_(i+1); its rounding is 2^-50 of that. A pixel's corner d, |d| < 4 (tangents are at most 2.5), errs by 2^-46,
// and the sums below by 2^-48 |n_i| |d|. So where n_i.d >= 2^-36 s_i s_(i+1) as computed, n'_i.d > 0 for the true ones:
// that is asked at all four corners of a pixel, and for all i. Then the true loop turns the same way about d at each
// step, so it winds about the line of d, and some combination q of the r' with weights >= 0, not all of them 0, is t d.
// Let h.r' > 0 for all r': then h.q > 0, so t has the sign of h.d, and where that is above 0, q is a point of K on the
// ray along d. For a face that all rays lie before, h is its axis, and h.d = 1. For others it is the sum of the rays'
// directions, when they all lie before that by more than their errors; h.d > 0 is then one more plane.
//
// Rows. n.d is linear on the face, a x + b y + c, so on a row a plane bounds x by base + slope y, at the row's edge and
// the pixel's side where it bounds it most: base = -(c + min(b, 0)) / a, slope = -b / a. Where |a| is below 2^-60 of
// what it might be it is taken to be that, which changes n.d by less than 2^-50 s_i s_(i+1). The roundings of base,
// slope and their sum shift the line by some 2^-51 of the face's size along x or y, as long as the line meets the face,
// which changes n.d by less than 2^-46 s_i s_(i+1). All of that is in the 2^-36.
//
// Which strips are looked at is a matter of cost: what is left out is not covered.

#include "gridcull/grid/mask_kernels.h"

namespace gridcull::masking::GRIDCULL_MASK_SET {
namespace {

/// A sum h of the rays' directions that all of them lie before: those that do not are given more weight, a few times
/// (F. Rosenblatt's perceptron, 1958). False where none is found. |h| is at most 32, and its product with a ray errs by
/// less than 2^-34 of the ray's size.
bool lean_on(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& size, double& hx, double& hy, double& hz) {
  Lanes weight = splat(1.0) / size;
  for (int i = 0; i < 4; ++i) {
    hx = sum(x * weight), hy = sum(y * weight), hz = sum(z * weight);
    const Mask before = splat(0x1p-31) * size < (splat(hx) * x + splat(hy) * y) + splat(hz) * z;
    if (bits(before) == 255) return true;
    weight = select(before, weight, weight + splat(1.0) / size);
  }
  return false;
}

bool span_cone(const double* rays, int count, Cone& out) {
  Lanes x, y, z;
  load_rays(rays, count, x, y, z);
  const Lanes xb = shift_in(x, x), yb = shift_in(y, y), zb = shift_in(z, z);
  Lanes nx = y * zb - z * yb, ny = z * xb - x * zb, nz = x * yb - y * xb;
  const Lanes size = (magnitude(x) + magnitude(y)) + magnitude(z);
  double hx, hy, hz;
  // Two rays that are nearly one span no plane to speak of: the margin would move it in by a part of a pixel and more.
  const Lanes sizes = size * shift_in(size, size), lanes = iota();
  const Mask spans = splat(0x1p-22) * sizes < (magnitude(nx) + magnitude(ny)) + magnitude(nz);
  const Mask beyond = (splat(count - 1.0) <= lanes) & (lanes < splat(7.0));
  if (bits(spans) != (bits(spans) | (255u & ~bits(beyond)))) return false;
  const bool before_h = lean_on(x, y, z, size, hx, hy, hz);
  // The products of the last ray with itself, beyond `count`, are 0.
  const bool turned = (sum(nx) * hx + sum(ny) * hy) + sum(nz) * hz < 0.0;
  const Lanes sign = splat(turned ? -1.0 : 1.0), lane = iota(), last = splat(count - 1.0);
  const Mask is_h = (lane <= last) & (last <= lane);
  store(out.nx, select(is_h, splat(hx), sign * nx));
  store(out.ny, select(is_h, splat(hy), sign * ny));
  store(out.nz, select(is_h, splat(hz), sign * nz));
  store(out.margin, select(is_h, splat(0x1p-31), splat(0x1p-36) * (size * shift_in(size, size))));
  store(out.x, x), store(out.y, y), store(out.z, z);
  out.low[0] = lowest(x), out.low[1] = lowest(y), out.low[2] = lowest(z);
  out.high[0] = highest(x), out.high[1] = highest(y), out.high[2] = highest(z);
  out.count = count;
  return before_h;
}

/// Lines x = base + slope * row that bound a row's pixels from the left, and from the right with both signs changed.
struct Lines {
  alignas(64) double base[8];
  alignas(64) double slope[8];
  double low, high;      ///< what upright lines and the face's sides bound
  unsigned left, right;  ///< the others, a bit each
};

void set_lines(const Window& window, const Cone& cone, unsigned planes, Lines& out) {
  const Lanes nx = load(cone.nx), ny = load(cone.ny), nz = load(cone.nz), margin = load(cone.margin);
  const Lanes zero = splat(0.0), least = splat(0x1p-24 * window.step) * margin;
  const Lanes at = form(window.per_x, nx, ny, nz), b = form(window.per_y, nx, ny, nz);
  const Lanes c = (form(window.corner, nx, ny, nz) - margin) + smaller(b, zero);
  const Lanes a = select(magnitude(at) < least, least, at);
  const Lanes per_a = splat(-1.0) / magnitude(a), base = c * per_a, slope = b * per_a;
  store(out.base, base), store(out.slope, slope);
  const unsigned left = bits(zero < a) & planes, right = planes & ~left;
  const unsigned upright = bits(magnitude(slope) <= zero);
  out.low = 0.0, out.high = -window.width;
  for (unsigned k = left & upright; k != 0; k &= k - 1) {
    const double x = out.base[__builtin_ctz(k)];
    out.low = x > out.low ? x : out.low;
  }
  for (unsigned k = right & upright; k != 0; k &= k - 1) {
    const double x = out.base[__builtin_ctz(k)];
    out.high = x > out.high ? x : out.high;
  }
  out.left = left & ~upright, out.right = right & ~upright;
}

/// The columns of eight rows between the lines of `left` and `right`.
GRIDCULL_MASK_INLINE void between(const Window& window, const Lines& lines, unsigned left, unsigned right,
                                  const Lanes& rows, Ints& from, Ints& to) {
  Lanes low = splat(lines.low), high = splat(lines.high);
  for (; left != 0; left &= left - 1) {
    const int at = __builtin_ctz(left);
    low = larger(low, splat(lines.base[at]) + rows * splat(lines.slope[at]));
  }
  for (; right != 0; right &= right - 1) {
    const int at = __builtin_ctz(right);
    high = larger(high, splat(lines.base[at]) + rows * splat(lines.slope[at]));
  }
  whole_pixels(window, low, splat(0.0) - high, from, to);
}

/// Strip after strip. A line whose greatest bound over the rows of a strip is none beyond low and high (its products
/// and sums round monotonically) is left out there: mostly no line or one is left.
int cover_between(Window& window, const Lines& lines, const Extent& e, std::uint64_t& strips) {
  const Lanes base = load(lines.base), slope = load(lines.slope), low = splat(lines.low), high = splat(lines.high);
  const Lanes reach = select(splat(0.0) < slope, splat(7.0), splat(0.0));
  Ints from0, to0;
  whole_pixels(window, low, splat(0.0) - high, from0, to0);
  const int first = e.x0 / 64, last = (e.x1 - 1) / 64;
  int filled = 0;
  for (int strip = e.y0 / 8; 8 * strip < e.y1; ++strip) {
    std::uint64_t open = open_blocks(window, strip, 0, first, last);
    if (open == 0) continue;
    ++strips;
    const int top = 8 * strip;
    const Lanes most = base + (splat(top) + reach) * slope;
    const unsigned left = lines.left & bits(low < most), right = lines.right & bits(high < most);
    Ints from = from0, to = to0;
    if ((left | right) != 0) between(window, lines, left, right, splat(top) + iota(), from, to);
    if (top < e.y0 || top + 8 > e.y1) to = keep(to, e.y0 - top, e.y1 - top);
    for (; open != 0; open &= open - 1) {
      const int block = __builtin_ctzll(open);
      filled += cover_block(window, strip, block, span(from, to, 64 * block));
    }
  }
  window.open_blocks -= filled;
  return filled;
}

/// Narrows rows [y0, y1) to the strips that may have a span: where a cone reaches beside the face, most have none.
void narrow_rows(const Lines& lines, Extent& e) {
  int first = e.y1, end = e.y0;
  for (int strip = e.y0 / 8; 8 * strip < e.y1; strip += 8) {
    const Lanes top = splat(8.0) * (splat(strip) + iota()), bottom = top + splat(7.0);
    Lanes low = splat(lines.low), high = splat(lines.high);
    const auto least = [&](unsigned k) {
      const Lanes slope = splat(lines.slope[k]);
      return splat(lines.base[k]) + select(splat(0.0) < slope, top, bottom) * slope;
    };
    for (unsigned k = lines.left; k != 0; k &= k - 1) low = larger(low, least(__builtin_ctz(k)));
    for (unsigned k = lines.right; k != 0; k &= k - 1) high = larger(high, least(__builtin_ctz(k)));
    const unsigned some = bits(low < splat(0.0) - high);
    if (some == 0) continue;
    const int from = 8 * (strip + __builtin_ctz(some)), to = 8 * (strip + 32 - __builtin_clz(some));
    if (from < first) first = from;
    end = to;
  }
  if (first > e.y0) e.y0 = first;
  if (end < e.y1) e.y1 = end;
}

int cover_cone(Window& window, const Cone& cone, std::uint64_t& strips) {
  const Lanes x = load(cone.x), y = load(cone.y), z = load(cone.z);
  const Lanes size = (magnitude(x) + magnitude(y)) + magnitude(z), w = form(window.form_w, x, y, z);
  const unsigned h = 1u << (cone.count - 1);
  unsigned planes = (h - 1) | 128u;
  Extent e{0, window.width, 0, window.height};
  if (bits(splat(0x1p-30) * size < w) == 255) {
    const Lanes over_w = splat(1.0) / w;
    const Lanes u = form(window.form_x, x, y, z) * over_w, v = form(window.form_y, x, y, z) * over_w;
    e = whole_extent(window, lowest(u), highest(u), lowest(v), highest(v));
    if (e.empty()) return 0;
  } else {
    planes |= h;
  }
  Lines lines;
  set_lines(window, cone, planes, lines);
  if ((planes & h) != 0) narrow_rows(lines, e);
  if (e.empty()) return 0;
  if (window.coarse == 1) return cover_between(window, lines, e, strips);
  return cover_strips(window, e, strips, [&](const Lanes& rows, Ints& from, Ints& to) {
    between(window, lines, lines.left, lines.right, rows, from, to);
  });
}

}  // namespace
}  // namespace gridcull::masking::GRIDCULL_MASK_SET
