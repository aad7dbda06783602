// Sutherland and Hodgman 1974 on directions (x, y, w), x / w and y / w being pixels from the face's middle,
// against the four guards; w >= 0 follows from two of them.
//
// Claim. Every corner of the result lies within the margins of a point of the cone, and the result holds all of
// the cone that falls on the face. A new corner is c = p a + q b with p, q >= 0 for an edge that runs from a to
// b: whatever the rounding of p and q, it is a direction of that edge. What is left is the error of the
// coordinates of a and b, proportional to their sizes, so that c's is proportional to p |a| + q |b|: that number
// is carried along as `size`, and the margins grow with size / w. The rounding of p and q moves c along the edge
// by as much, near a guard, where no pixel is.
#include "gridcull/grid/mask_clip.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridcull::masking {
namespace {

struct Corner {
  double x, y, w, size;
};

/// size / w up to which the margins of the face hold as they are, and up to which they are stretched.
constexpr double steepest = 16.0, utmost = 0x1p14;

struct Corners {
  Corner at[max_vertices];
  int count = 0;
  bool overflow = false;

  void add(const Corner& c) {
    if (count < max_vertices) {
      at[count++] = c;
    } else {
      overflow = true;
    }
  }
};

Corner between(const Corner& a, const Corner& b, double da, double db) {
  // da and db have opposite signs, one may be 0.
  const double total = std::fabs(da) + std::fabs(db);
  const double p = std::fabs(db) / total, q = std::fabs(da) / total;
  return {p * a.x + q * b.x, p * a.y + q * b.y, p * a.w + q * b.w, p * a.size + q * b.size};
}

/// Keeps what lies within a.w * guard >= sign * coordinate: then `in` and `out` change places. Mostly all does.
template <class Depth>
void clip(Corners*& from, Corners*& to, const Depth& depth) {
  Corners &in = *from, &out = *to;
  bool all = true;
  for (int k = 0; k < in.count; ++k) all = all && depth(in.at[k]) >= 0.0;
  if (all) return;
  std::swap(from, to);
  out.count = 0;
  out.overflow = in.overflow;
  for (int k = 0; k < in.count; ++k) {
    const Corner &a = in.at[k], &b = in.at[k + 1 < in.count ? k + 1 : 0];
    const double da = depth(a), db = depth(b);
    if (da >= 0.0) out.add(a);
    if ((da >= 0.0) != (db >= 0.0)) out.add(between(a, b, da, db));
  }
}

/// Corners this close (pixels) are taken for one, since the line through them may point anywhere and would cut off much
/// of the polygon; the margins grow by twice that
/// (one may be merged with a corner that is then merged with the first).
constexpr double same_corner = 0x1p-16;

bool same(const Polygon& polygon, int k, double x, double y) {
  return std::fabs(polygon.x[k] - x) <= same_corner && std::fabs(polygon.y[k] - y) <= same_corner;
}

void add(Polygon& polygon, double x, double y) {
  if (polygon.count > 0 && same(polygon, polygon.count - 1, x, y)) return;
  polygon.x[polygon.count] = x;
  polygon.y[polygon.count++] = y;
}

double form(const double* f, const Vec3& d) { return (f[0] * d.x + f[1] * d.y) + f[2] * d.z; }

}  // namespace

void pad(Polygon& polygon) {
  for (int k = polygon.count; k % 8 != 0; ++k) {
    polygon.x[k] = polygon.x[polygon.count - 1];
    polygon.y[k] = polygon.y[polygon.count - 1];
  }
}

Clipped clip_cone(const Window& window, const Vec3* rays, int count, Polygon& out) {
  const double middle_x = 0.5 * window.width, middle_y = 0.5 * window.height;
  Corners first, second;
  Corners *corners = &first, *other = &second;
  for (int k = 0; k < count; ++k) {
    const Vec3& d = rays[k];
    const double w = form(window.form_w, d);
    first.add({form(window.form_x, d) - middle_x * w, form(window.form_y, d) - middle_y * w, w,
               std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)})});
  }
  clip(corners, other, [&](const Corner& c) { return window.guard_x * c.w - c.x; });
  clip(corners, other, [&](const Corner& c) { return window.guard_x * c.w + c.x; });
  clip(corners, other, [&](const Corner& c) { return window.guard_y * c.w - c.y; });
  clip(corners, other, [&](const Corner& c) { return window.guard_y * c.w + c.y; });
  const Corners& one = *corners;
  if (one.overflow) return Clipped::unsure;
  if (one.count == 0) return Clipped::empty;
  double stretch = 1.0;
  out.count = 0;
  for (int k = 0; k < one.count; ++k) {
    const Corner& c = one.at[k];
    if (!(c.size <= utmost * c.w)) return Clipped::unsure;
    stretch = std::max(stretch, c.size / (steepest * c.w));
    add(out, snapped(middle_x + c.x / c.w), snapped(middle_y + c.y / c.w));
  }
  while (out.count > 1 && same(out, out.count - 1, out.x[0], out.y[0])) --out.count;
  const double merged = out.count < one.count ? 2.0 * same_corner : 0.0;
  out.margin_x = stretch * window.margin_x + merged, out.margin_y = stretch * window.margin_y + merged;
  pad(out);
  return Clipped::polygon;
}

}  // namespace gridcull::masking
