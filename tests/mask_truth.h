// What a coverage mask may say, judged pixel by pixel in long doubles, and random cones to ask it about.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "gridcull/core/pose.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/coverage_mask.h"

namespace mask_truth {

using gridcull::CoverageMask;
using gridcull::MaskFace;
using gridcull::Vec3;
using real = long double;

struct Ray {
  real x, y, z;
};
inline Ray ray(const Vec3& v) { return {v.x, v.y, v.z}; }
inline real dot(const Ray& a, const Ray& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Ray cross(const Ray& a, const Ray& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Ray operator+(const Ray& a, const Ray& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Ray operator*(real s, const Ray& a) { return {s * a.x, s * a.y, s * a.z}; }
inline real length(const Ray& a) { return std::sqrt(dot(a, a)); }
inline Ray unit(const Ray& a) { return (1 / length(a)) * a; }

struct Dice {
  std::mt19937_64 random;
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  /// 10^low .. 10^high.
  double power(double low, double high) { return std::pow(10.0, real(low, high)); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }
  bool chance(double p) { return real(0, 1) < p; }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return glm::normalize(Vec3(normal(random), normal(random), normal(random)));
  }
};

struct Pixel {
  int face = -1, x = 0, y = 0;
};

/// The direction of a point of a face, pixel fractions allowed: the definition of a pixel.
inline Ray direction(const MaskFace& f, real x, real y) {
  const real u = x / f.scale_x - f.tangent_x, v = y / f.scale_y - f.tangent_y;
  return ray(f.forward) + u * ray(f.right) + v * ray(f.up);
}

/// The pixel that a direction falls into; face -1: none, it is outside the window.
inline Pixel pixel_of(const CoverageMask& mask, const Ray& d) {
  for (int k = 0; k < mask.faces(); ++k) {
    const MaskFace& f = mask.face(k);
    const real w = dot(ray(f.forward), d);
    if (w <= 0) continue;
    const real x = (dot(ray(f.right), d) / w + f.tangent_x) * f.scale_x;
    const real y = (dot(ray(f.up), d) / w + f.tangent_y) * f.scale_y;
    if (x < 0 || y < 0 || x >= f.window.width || y >= f.window.height) continue;
    return {k, static_cast<int>(x), static_cast<int>(y)};
  }
  return {};
}

/// The pixels that a direction lies in or on the border of.
inline std::vector<Pixel> pixels_about(const CoverageMask& mask, const Ray& d) {
  std::vector<Pixel> pixels;
  for (int k = 0; k < mask.faces(); ++k) {
    const MaskFace& f = mask.face(k);
    const real w = dot(ray(f.forward), d), near = 1e-12L;
    if (w <= 0) continue;
    const real x = (dot(ray(f.right), d) / w + f.tangent_x) * f.scale_x;
    const real y = (dot(ray(f.up), d) / w + f.tangent_y) * f.scale_y;
    if (!(x > -1 && y > -1 && x < f.window.width + 1 && y < f.window.height + 1)) continue;
    for (int i = static_cast<int>(x) - 1; i <= static_cast<int>(x) + 1; ++i) {
      for (int j = static_cast<int>(y) - 1; j <= static_cast<int>(y) + 1; ++j) {
        if (i < 0 || j < 0 || i >= f.window.width || j >= f.window.height) continue;
        if (x >= i - near && x <= i + 1 + near && y >= j - near && y <= j + 1 + near) pixels.push_back({k, i, j});
      }
    }
  }
  return pixels;
}

/// A convex cone of directions, exactly; margins (radians, about) make it narrower (> 0) or wider.
struct Cone {
  std::vector<Vec3> rays;  ///< counter-clockwise about `axis`; empty: a ball
  Vec3 axis;               ///< ball: its centre
  double radius = 0;
  std::vector<Ray> hints;  ///< corners of pixels that lie on its border, where errors show first

  bool is_ball() const { return rays.empty(); }
  bool holds(const Ray& d, real margin = 0) const {
    if (is_ball()) return ball_holds(d, margin);
    for (std::size_t k = 0; k < rays.size(); ++k) {
      const Ray n = cross(unit(ray(rays[k])), unit(ray(rays[(k + 1) % rays.size()])));
      if (dot(n, unit(d)) < margin * length(n)) return false;
    }
    return true;
  }

 private:
  bool ball_holds(const Ray& d, real margin) const {
    const Ray c = ray(axis);
    const real cosine = dot(unit(c), unit(d)), sine = length(cross(unit(c), unit(d)));
    const real s = radius / length(c), k = std::sqrt(1 - s * s);
    return cosine > 0 && sine * k - cosine * s <= -margin;  // sin(angle - half angle)
  }
};

/// Each coordinate off by up to 2^-40 of the largest: what the mask must put up with.
inline Vec3 blurred(const Vec3& v, Dice& dice) {
  const double size = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}) * 0x1p-40 * 0.999;
  const auto off = [&] { return size * (dice.chance(0.5) ? dice.real(-1, 1) : dice.chance(0.5) ? 1.0 : -1.0); };
  return {v.x + off(), v.y + off(), v.z + off()};
}

/// Where things get hard: window and cube edges, corners, pixel lines, or anywhere.
inline Vec3 some_direction(const CoverageMask& mask, Dice& dice) {
  const MaskFace& f = mask.face(dice.integer(0, mask.faces() - 1));
  const double w = f.window.width, h = f.window.height;
  switch (dice.integer(0, 4)) {
    case 0: return dice.direction();
    case 1: return f.direction(dice.chance(0.5) ? 0.0 : w, dice.chance(0.5) ? 0.0 : h);
    case 2: return f.direction(dice.chance(0.5) ? 0.0 : w, dice.real(0, h));
    case 3: return f.direction(dice.integer(0, f.window.width), dice.integer(0, f.window.height));
    default: return f.direction(dice.real(0, w), dice.real(0, h));
  }
}

/// `corners` rays in convex position about an axis, of lengths 1e-3 .. 1e9 m; half angle up to 89 degrees.
inline Cone random_convex(const CoverageMask& mask, int corners, Dice& dice) {
  Cone cone;
  cone.axis = glm::normalize(some_direction(mask, dice));
  const Vec3 e = glm::normalize(glm::cross(cone.axis, dice.direction())), f = glm::cross(cone.axis, e);
  const double reach = dice.power(-4, 1.7), flat = dice.chance(0.3) ? dice.power(-5, 0) : 1.0;
  std::vector<double> angles;
  const double doubled = dice.chance(0.3) ? 0.3 : 0.0;  // corners with a second one close by: edges without direction
  for (int k = 0; k < corners; ++k) {
    angles.push_back(2 * std::numbers::pi * (k + dice.real(0, 0.8)) / corners);
    if (corners < 32 && dice.chance(doubled)) angles.push_back(angles.back() + dice.power(-8, -4));
  }
  const double size = dice.power(-3, 9), spread = dice.chance(0.5) ? 3.0 : 0.0;
  const double turn = dice.real(0, 6.3);
  for (const double angle : angles) {
    const double a = reach * std::cos(angle), b = flat * reach * std::sin(angle);
    const Vec3 across = (a * std::cos(turn) - b * std::sin(turn)) * e + (a * std::sin(turn) + b * std::cos(turn)) * f;
    cone.rays.push_back(size * dice.power(-spread, spread) * (cone.axis + across));
  }
  return cone;
}

/// Corners on pixel lines of a face: a rectangle, or a triangle of three lattice points.
inline Cone lattice_convex(const CoverageMask& mask, Dice& dice) {
  const MaskFace& f = mask.face(dice.integer(0, mask.faces() - 1));
  const int w = f.window.width, h = f.window.height;
  const auto at = [&](int x, int y) { return dice.power(-3, 3) * f.direction(x, y); };
  for (;;) {
    Cone cone;
    const int x0 = dice.integer(-2, w + 2), x1 = dice.integer(-2, w + 2), y0 = dice.integer(-2, h + 2),
              y1 = dice.integer(-2, h + 2);
    if (dice.chance(0.5)) {
      cone.rays = {at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)};
    } else {
      cone.rays = {at(x0, y0), at(x1, y1), at(dice.integer(-2, w + 2), dice.integer(-2, h + 2))};
    }
    const real turn = dot(cross(unit(ray(cone.rays[0])), unit(ray(cone.rays[1]))), unit(ray(cone.rays[2])));
    if (std::fabs(turn) < 1e-3L / (f.scale_x * f.scale_y)) continue;  // on one line
    if (turn < 0) std::reverse(cone.rays.begin(), cone.rays.end());
    cone.axis = Vec3(0.0);
    for (const Vec3& r : cone.rays) cone.axis += glm::normalize(r);
    for (const Vec3& r : cone.rays) cone.hints.push_back(ray(r));
    return cone;
  }
}

/// A wall seen from close by: an edge along a pixel line whose ends are nearly opposite.
inline Cone grazing_convex(const CoverageMask& mask, Dice& dice) {
  const MaskFace& f = mask.face(dice.integer(0, mask.faces() - 1));
  const double w = f.window.width, h = f.window.height;
  const bool level = dice.chance(0.5), above = dice.chance(0.5);
  const int line = dice.integer(0, f.window.height);
  const auto at = [&](double x, double y) { return level ? f.direction(x, y) : f.direction(y * w / h, x * h / w); };
  Cone cone;
  const double left = -w * dice.power(0, 5), right = w + w * dice.power(0, 5), y = level ? line : line * h / w;
  cone.rays = {at(left, y), at(right, y), at(dice.real(0, w), above ? y + dice.real(0.5, h) : y - dice.real(0.5, h))};
  if (above != level) std::swap(cone.rays[0], cone.rays[1]);
  const real turn = dot(cross(ray(cone.rays[0]), ray(cone.rays[1])), ray(cone.rays[2]));
  if (turn < 0) std::swap(cone.rays[0], cone.rays[1]);
  cone.axis = cone.rays[2];
  for (int k = 0; k < 4; ++k) {
    const int x = dice.integer(0, f.window.width);
    const Ray d = ray(at(x, y));
    if (cone.holds(d)) cone.hints.push_back(d);
  }
  return cone;
}

inline Cone random_ball(const CoverageMask& mask, Dice& dice) {
  Cone cone;
  const double distance = dice.power(-3, 9);
  cone.axis = distance * glm::normalize(some_direction(mask, dice));
  // Half angles from a thousandth of a degree to nearly 90 degrees.
  cone.radius = glm::length(cone.axis) * (dice.chance(0.3) ? 1.0 - dice.power(-6, -0.1) : dice.power(-5, -0.05));
  if (dice.chance(0.5)) return cone;
  // Through the corner of a pixel.
  const MaskFace& f = mask.face(dice.integer(0, mask.faces() - 1));
  const Ray d = direction(f, dice.integer(0, f.window.width), dice.integer(0, f.window.height));
  if (dot(d, ray(cone.axis)) <= 0) return cone;
  const real radius = length(cross(unit(d), ray(cone.axis)));
  if (radius < 1e-6L * length(ray(cone.axis))) return cone;
  cone.radius = static_cast<double>(radius * (1 + 1e-16L));
  if (cone.holds(d)) cone.hints.push_back(d);
  return cone;
}

inline Cone random_cone(const CoverageMask& mask, Dice& dice) {
  if (dice.chance(0.4)) return random_ball(mask, dice);
  if (dice.chance(0.3)) return dice.chance(0.4) ? grazing_convex(mask, dice) : lattice_convex(mask, dice);
  return random_convex(mask, dice.chance(0.1) ? dice.integer(9, 64) : dice.integer(3, 8), dice);
}

/// A direction of the cone, often on its border.
inline Ray random_within(const Cone& cone, Dice& dice) {
  if (!cone.hints.empty() && dice.chance(0.6)) {
    return cone.hints[static_cast<std::size_t>(dice.integer(0, static_cast<int>(cone.hints.size()) - 1))];
  }
  if (cone.is_ball()) {
    const Ray n = unit(ray(cone.axis)), e = unit(cross(n, ray(dice.direction())));
    const real s = cone.radius / length(ray(cone.axis)), k = std::sqrt(1 - s * s);
    const real part = dice.chance(0.5) ? 1 - 1e-17L : static_cast<real>(dice.real(0, 1));
    return k * n + (part * s) * e;
  }
  Ray d{0, 0, 0};
  const int kind = dice.integer(0, 2);
  const std::size_t first = static_cast<std::size_t>(dice.integer(0, static_cast<int>(cone.rays.size()) - 1));
  for (std::size_t k = 0; k < cone.rays.size(); ++k) {
    const bool next = k == (first + 1) % cone.rays.size();
    const real weight = kind == 0 ? k == first : kind == 1 ? (k == first || next) : 1;
    if (weight != 0) d = d + (weight * static_cast<real>(dice.power(-3, 0))) * unit(ray(cone.rays[k]));
  }
  return d;
}

inline void cover(CoverageMask& mask, const Cone& cone, Dice& dice) {
  if (cone.is_ball()) {
    mask.cover_ball(blurred(cone.axis, dice), cone.radius * (1 + 0x1p-41));
    return;
  }
  std::vector<Vec3> rays;
  for (const Vec3& r : cone.rays) rays.push_back(blurred(r, dice));
  if (dice.chance(0.5)) std::reverse(rays.begin(), rays.end());
  mask.cover_convex(rays.data(), static_cast<int>(rays.size()));
}

inline bool open(const CoverageMask& mask, const Cone& cone, Dice& dice) {
  if (cone.is_ball()) {
    const Vec3 centre = blurred(cone.axis, dice);
    const double radius = cone.radius * (1 - 0x1p-41);
    const bool is_open = mask.open_ball(centre, radius);
    if (is_open) REQUIRE(mask.open_about_ball(centre, radius));  // the cheap tests may only err the other way
    if (is_open) REQUIRE_FALSE(mask.beyond_window(centre, radius));
    return is_open;
  }
  std::vector<Vec3> rays;
  for (const Vec3& r : cone.rays) rays.push_back(blurred(r, dice));
  if (dice.chance(0.5)) std::reverse(rays.begin(), rays.end());
  return mask.open_convex(rays.data(), static_cast<int>(rays.size()));
}

/// Covers rows and columns [x0, x1) x [y0, y1) of a face: a rectangle half a pixel larger all round.
inline void cover_rectangle(CoverageMask& mask, int face, int x0, int x1, int y0, int y1) {
  const MaskFace& f = mask.face(face);
  const std::array<Vec3, 4> rays{f.direction(x0 - 0.5, y0 - 0.5), f.direction(x1 + 0.5, y0 - 0.5),
                                 f.direction(x1 + 0.5, y1 + 0.5), f.direction(x0 - 0.5, y1 + 0.5)};
  mask.cover_convex(rays.data(), 4);
}

inline void cover_all_but(CoverageMask& mask, const Pixel& p) {
  for (int k = 0; k < mask.faces(); ++k) {
    const int w = mask.face(k).window.width, h = mask.face(k).window.height;
    if (k != p.face) {
      cover_rectangle(mask, k, 0, w, 0, h);
      continue;
    }
    if (p.x > 0) cover_rectangle(mask, k, 0, p.x, 0, h);
    if (p.x + 1 < w) cover_rectangle(mask, k, p.x + 1, w, 0, h);
    if (p.y > 0) cover_rectangle(mask, k, 0, w, 0, p.y);
    if (p.y + 1 < h) cover_rectangle(mask, k, 0, w, p.y + 1, h);
  }
}

/// f(pixel) for every pixel of the mask.
template <class F>
void each_pixel(const CoverageMask& mask, F&& f) {
  for (int k = 0; k < mask.faces(); ++k) {
    for (int y = 0; y < mask.face(k).window.height; ++y) {
      for (int x = 0; x < mask.face(k).window.width; ++x) f(Pixel{k, x, y});
    }
  }
}

inline bool covered(const CoverageMask& mask, const Pixel& p) { return mask.face(p.face).covered(p.x, p.y); }

inline std::array<Ray, 4> corners(const CoverageMask& mask, const Pixel& p) {
  const MaskFace& f = mask.face(p.face);
  return {direction(f, p.x, p.y), direction(f, p.x + 1, p.y), direction(f, p.x + 1, p.y + 1),
          direction(f, p.x, p.y + 1)};
}

/// One face, all round, or a pyramid too wide for one face.
enum class ViewKind { window, all_round, wide };

inline gridcull::View random_view(ViewKind kind, Dice& dice) {
  gridcull::View view;
  const Vec3 q = dice.direction();
  view.pose.orientation = gridcull::normalised({dice.real(-1, 1), q.x, q.y, q.z});
  view.pose.position = dice.power(-1, 6) * dice.direction();
  if (kind == ViewKind::all_round) return view;
  view.frustum = gridcull::Frustum{};
  if (kind == ViewKind::wide) {
    view.frustum->fov_y = dice.real(2.5, 3.1), view.frustum->aspect = dice.power(-0.7, 0.7);
    return view;
  }
  view.frustum->fov_y = dice.chance(0.2) ? dice.power(-5, 0) : dice.real(0.2, 1.6);
  view.frustum->aspect = dice.real(0.4, 2.4);
  return view;
}

}  // namespace mask_truth
