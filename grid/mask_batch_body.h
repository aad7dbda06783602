// Eight balls of the index at once: their keys, and the rectangles of pixels that they are first tested with. Part of
// mask_kernels_body.h. A lane is a ball.
//
// Claim. A lane gives what Silhouette3D's keys, CoverageMask::open_box() and open_about_ball() would, by the same
// operations in the same order. On the cube that is where the box about the ball, grown by what it may be off, lies
// wholly before one face, and strictly so: then no direction to it falls on any other face. Where it does not, or where
// the viewpoint may be in the ball, the lane is left to those two (Batch::single). What touches no pixel has an empty
// rectangle.

#include "gridcull/grid/mask_kernels.h"

namespace gridcull::masking::GRIDCULL_MASK_SET {
namespace {

struct Triple {
  Lanes x, y, z;
};

/// Added up as the sum of magnitudes is elsewhere.
Lanes magnitude(const Triple& p) { return (magnitude(p.x) + magnitude(p.y)) + magnitude(p.z); }
Lanes product(const Triple& p, const Triple& q) { return (p.x * q.x + p.y * q.y) + p.z * q.z; }
Lanes along(const double* axis, const Triple& p) {
  return (splat(axis[0]) * p.x + splat(axis[1]) * p.y) + splat(axis[2]) * p.z;
}

/// What a shape reaches along an axis.
struct Reach {
  Lanes low, high;
};

/// Pixels from .. to of [low, high] / depth, as in mask_rectangle.cpp.
void pixel_range(const Reach& r, const Lanes& per_near, const Lanes& per_far, double tangent, double scale,
                 double margin, int pixels, int* from, int* to) {
  const Lanes zero = splat(0.0);
  const Lanes a = r.low * select(r.low < zero, per_near, per_far);
  const Lanes b = r.high * select(r.high < zero, per_far, per_near);
  const Lanes left = larger((a + splat(tangent)) * splat(scale) - splat(margin), zero);
  const Lanes right = (b + splat(tangent)) * splat(scale) + splat(margin);
  store(from, round_down(smaller(left, splat(pixels))));
  store(to, add(round_down(smaller(larger(right, splat(-1.0)), splat(pixels - 0.5))), 1));
}

/// Rectangles of boxes in a face's axes. Bits: where one touches the face at all.
unsigned set_rectangles(const Outlook& from, const Window& window, const Reach& right, const Reach& up,
                        const Reach& depth, Batch& out) {
  const Lanes tiny = splat(0x1p-1000), one = splat(1.0);
  const Lanes per_near = select(tiny < depth.low, one / depth.low, splat(0x1p1000)), per_far = one / depth.high;
  pixel_range(right, per_near, per_far, from.tangent_x, from.scale_x, window.margin_x, window.width, out.x0, out.x1);
  pixel_range(up, per_near, per_far, from.tangent_y, from.scale_y, window.margin_y, window.height, out.y0, out.y1);
  return bits(tiny < depth.high);
}

Reach choose(Mask m, const Reach& a, const Reach& b) { return {select(m, a.low, b.low), select(m, a.high, b.high)}; }

/// On the cube: `grown` halves of the box in world axes. Returns the lanes that lie before one face.
unsigned set_on_cube(const Outlook& from, const Window& window, const Reach& x, const Reach& y, const Reach& z,
                     const Triple& centre, Batch& out) {
  const Lanes ax = magnitude(centre.x), ay = magnitude(centre.y), az = magnitude(centre.z);
  const Mask is_x = (ay <= ax) & (az <= ax), is_y = (az <= ay) & (ax < ay);
  const Mask is_z = (is_x ^ is_y) ^ (splat(0.0) <= splat(0.0));
  const Lanes zero = splat(0.0), middle = select(is_x, centre.x, select(is_y, centre.y, centre.z));
  const Reach along = choose(is_x, x, choose(is_y, y, z)), right = choose(is_x, y, x), up = choose(is_z, y, z);
  const Mask back = middle < zero;
  const Reach depth{select(back, zero - along.high, along.low), select(back, zero - along.low, along.high)};
  const Lanes beside = larger(larger(zero - right.low, right.high), larger(zero - up.low, up.high));
  const Mask single = (beside < depth.low) & (splat(0x1p-900) < depth.low);
  set_rectangles(from, window, right, up, depth, out);
  const Lanes face = select(is_x, zero, select(is_y, splat(2.0), splat(4.0))) + select(back, splat(1.0), zero);
  store(out.face, round_down(face));
  return bits(single);
}

/// On the one window: balls as boxes in its axes, which must not be beyond its sides to be kept.
unsigned set_in_window(const Outlook& from, const Window& window, const Triple& centre, const Lanes& outer,
                       Batch& out) {
  const Triple c{along(from.right, centre), along(from.up, centre), along(from.forward, centre)};
  const Mask left = splat(from.norm_x) * outer < magnitude(c.x) - splat(from.tangent_x) * c.z;
  const Mask above = splat(from.norm_y) * outer < magnitude(c.y) - splat(from.tangent_y) * c.z;
  out.kept &= ~(bits(left) | bits(above));
  const auto about = [&](const Lanes& v) { return Reach{v - outer, v + outer}; };
  const unsigned touching = set_rectangles(from, window, about(c.x), about(c.y), about(c.z), out);
  for (int k = 0; k < 8; ++k) {
    out.face[k] = 0;
    if ((touching >> k & 1) == 0) out.x1[k] = out.x0[k];
  }
  return 255;
}

void place_balls(const Outlook& from, const Window& window, const Balls& balls, Batch& out) {
  const Lanes zero = splat(0.0), radius = load(balls.radius), rounding = splat(from.rounding);
  const Triple place{load(balls.x), load(balls.y), load(balls.z)};
  const Triple centre{place.x - splat(from.apex[0]), place.y - splat(from.apex[1]), place.z - splat(from.apex[2])};
  const Lanes grown = radius + rounding * ((splat(from.apex_size) + magnitude(place)) + radius);
  // Upright objects: what they fill of their ball.
  const Lanes part = radius * splat(1.0 / 255.0), blur = grown - radius, filled = load(balls.wide);
  const Mask upright = zero <= filled;
  const Lanes wide = select(upright, part * filled + blur, grown);
  const Lanes tall = select(upright, part * load(balls.tall) + blur, grown);
  const Lanes beside = larger(root(centre.x * centre.x + centre.y * centre.y) - wide, zero);
  const Lanes above = larger(magnitude(centre.z) - tall, zero), square = product(centre, centre);
  // Ball and cylinder both hold the object: the farther of them says more.
  const Lanes near_ball = root(square) - grown;
  const Lanes key = select(upright, larger(near_ball, root(beside * beside + above * above)), near_ball);
  store(out.key, key);
  const unsigned there = (1u << balls.count) - 1u;
  out.kept = bits(key <= splat(from.limit)) & there;
  // As a box for open_box(), or as a ball for open_about_ball().
  const Lanes outer = grown + splat(0x1p-34) * (magnitude(centre) + grown);
  const unsigned around = bits(outer * outer < square * splat(1.0 - 0x1p-40));
  if (from.cube) {
    const auto box = [](const Lanes& c, const Lanes& half) { return Reach{c - half, c + half}; };
    Reach x = box(centre.x, wide), y = box(centre.y, wide), z = box(centre.z, tall);
    const auto greatest = [](const Reach& r) { return larger(magnitude(r.low), magnitude(r.high)); };
    const Lanes margin = splat(0x1p-39) * larger(larger(greatest(x), greatest(y)), greatest(z));
    const auto grow = [&](const Reach& r, const Lanes& c) {
      return Reach{select(upright, r.low - margin, c - outer), select(upright, r.high + margin, c + outer)};
    };
    x = grow(x, centre.x), y = grow(y, centre.y), z = grow(z, centre.z);
    out.single = set_on_cube(from, window, x, y, z, centre, out) & (bits(upright) | around);
  } else {
    out.single = set_in_window(from, window, centre, outer, out) & around & ~bits(upright);
  }
  store(out.x, centre.x), store(out.y, centre.y), store(out.z, centre.z);
  store(out.wide, wide), store(out.tall, tall);
}

}  // namespace
}  // namespace gridcull::masking::GRIDCULL_MASK_SET
