// The outline of a ball: centre c in the face's axes, radius r, c.z > r. A direction (u, v, 1) meets the ball iff
// (c.(u,v,1))^2 >= K (u^2 + v^2 + 1), K = |c|^2 - r^2. With Z = c.z^2 - r^2, A = c.y^2 + Z, B = c.x^2 + Z:
//   v runs from (c.y c.z - r sqrt A) / Z to (c.y c.z + r sqrt A) / Z, u likewise with c.x and B;
//   at height v, u = (c.x (c.y v + c.z) -+ sqrt(K Z (v_high - v)(v - v_low))) / A;
//   the extreme u is reached at v = c.y (c.x u + c.z) / B.
// Claim. Taken for a ball whose radius is smaller (larger) by 2^-34 |c|, the computed spans lie inside (outside)
// the true ones. Such a ball's cone is narrower by at least 2^-34 radians all round, hence its outline by at least
// that in u and v. Let |c| = 1. Z >= (c.z - r)^2 >= 2^-6 (place_ball demands it), so A, B, K >= 2^-6 and all of
// v_high, |c.x c.y| / A, sqrt(K Z) / A, |c.x (c.y v + c.z)| / A are below 2^9. No formula subtracts what is nearly
// equal but c.y c.z - r sqrt A and c.z - r; so v_low, v_high are right to 2^-44, and the factored root turns that into
// a shift of the outline in v, which the ellipse's slant (below 2^6) makes one of 2^-38 in u. All other errors are
// relative ones of numbers below 2^9, that is below 2^-42. The sum is below 2^-37.
#include "gridcull/grid/mask_ball.h"

#include <cmath>

#include "gridcull/grid/mask_rectangle.h"

namespace gridcull::masking {
namespace {

/// cos(k pi / 16).
constexpr double cosines[9] = {1.0,
                               0.98078528040323044913,
                               0.92387953251128675613,
                               0.83146961230254523708,
                               0.70710678118654752440,
                               0.55557023301960222474,
                               0.38268343236508977173,
                               0.19509032201612826785,
                               0.0};
/// 1 / cos(pi / 32), rounded up.
constexpr double circumscribed = 1.00483857238;

/// cos(k pi / 16) for any k >= 0.
double cosine(int k) {
  k %= 32;
  if (k > 16) k = 32 - k;
  return k <= 8 ? cosines[k] : -cosines[16 - k];
}

void rays_round(const Vec3& centre, double radius, double factor, Vec3* out) {
  const double length = glm::length(centre);
  const Vec3 n = centre / length;
  const Vec3 a(std::fabs(n.x), std::fabs(n.y), std::fabs(n.z));
  const Vec3 axis = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Vec3 e = glm::normalize(glm::cross(n, axis)), f = glm::cross(n, e);
  const double cos = std::sqrt((length - radius) * (length + radius)) / length, sin = factor * (radius / length);
  for (int k = 0; k < cone_rays; ++k) out[k] = cos * n + sin * (cosine(k) * e + cosine(k + 24) * f);
}

}  // namespace

BallPlace place_ball(const MaskFace& face, const Vec3& c, double r, Ellipse& out) {
  if (beyond_face(face, c, r)) return BallPlace::outside;
  const double near = c.z - r, xx = c.x * c.x, yy = c.y * c.y;
  if (!(near > 0.0 && 64.0 * (near * near) >= xx + yy + c.z * c.z)) return BallPlace::crossing;
  const double z = near * (c.z + r), a = yy + z, b = xx + z, k = xx + a;
  const double over_z = 1.0 / z, over_a = 1.0 / a;
  const double reach_u = r * std::sqrt(b), reach_v = r * std::sqrt(a);
  const double low_u = (c.x * c.z - reach_u) * over_z, high_u = (c.x * c.z + reach_u) * over_z;
  const double low_v = (c.y * c.z - reach_v) * over_z, high_v = (c.y * c.z + reach_v) * over_z;
  const double middle_x = 0.5 * face.window.width, middle_y = 0.5 * face.window.height;
  const double sx = face.scale_x, sy = face.scale_y, tilt = c.y / b;
  out.low_x = middle_x + sx * low_u, out.high_x = middle_x + sx * high_u;
  out.low_y = middle_y + sy * low_v, out.high_y = middle_y + sy * high_v;
  out.y_at_low_x = middle_y + sy * (tilt * (c.x * low_u + c.z));
  out.y_at_high_x = middle_y + sy * (tilt * (c.x * high_u + c.z));
  // Heights as pixels: v = y step_y - tangent_y.
  const double per_row = sx * over_a;
  out.alpha = middle_x + per_row * (c.x * (c.z - c.y * face.tangent_y));
  out.beta = per_row * (c.x * c.y) * face.step_y;
  out.gamma = per_row * std::sqrt(k * z) * face.step_y;
  out.tolerance = 0x1p-30 * sy;
  return BallPlace::ellipse;
}

void rays_within(const Vec3& centre, double radius, Vec3* out) { rays_round(centre, radius, 1.0, out); }

void rays_around(const Vec3& centre, double radius, Vec3* out) { rays_round(centre, radius, circumscribed, out); }

}  // namespace gridcull::masking
