// The coverage mask against its definition (mask_truth.h): what is covered lies inside the cone, corner by corner; what
// a cone touches is open while one of its pixels is. All cones are given with the error that the mask must bear.
#include <doctest/doctest.h>

#include "mask_truth.h"

using namespace gridcull;
using namespace mask_truth;

namespace {

constexpr ViewKind kinds[] = {ViewKind::window, ViewKind::all_round, ViewKind::wide};

InstructionSet some_set(Dice& dice) {
  const auto set = static_cast<InstructionSet>(dice.integer(0, 2));
  return is_supported(set) ? set : InstructionSet::scalar;
}

struct Stage {
  ViewVolume volume;
  int resolution;
  CoverageMask mask;

  Stage(ViewKind kind, std::initializer_list<int> resolutions, Dice& dice)
      : volume(random_view(kind, dice), 3),
        resolution(resolutions.begin()[dice.integer(0, static_cast<int>(resolutions.size()) - 1)]),
        mask(some_set(dice)) {
    mask.begin(volume, resolution);
  }
  void begin() { mask.begin(volume, resolution); }
};

/// Half a millionth of a pixel, as an angle, about.
real small_angle(const CoverageMask& mask) {
  return 1e-6L / std::max(mask.face(0).scale_x, mask.face(0).scale_y) + 1e-8L;
}

/// Rays so nearly opposite that the margins grow, up to giving the occluder up; or so close to each other that the
/// line through them may point anywhere.
bool forgivable(const Cone& cone) {
  for (const Vec3& a : cone.rays) {
    for (const Vec3& b : cone.rays) {
      const real cosine = dot(unit(ray(a)), unit(ray(b)));
      if (cosine < -1 + 1e-4L || (&a != &b && length(cross(unit(ray(a)), unit(ray(b)))) < 1e-5L)) return true;
    }
  }
  return false;
}

bool in_view(const ViewVolume& volume, const Ray& d) {
  for (const HalfSpace& side : volume) {
    if (dot(ray(side.normal), d) < 0) return false;
  }
  return true;
}

bool all_beyond_one_side(const ViewVolume& volume, const std::array<Ray, 4>& corners, real margin) {
  for (const HalfSpace& side : volume) {
    bool all = true;
    for (const Ray& c : corners) all = all && dot(ray(side.normal), unit(c)) < -margin;
    if (all) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a window holds its whole view, and pixels start covered only outside the view") {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    const ViewKind kind = kinds[seed % 3];
    Stage s(kind, {8, 32, 136}, dice);
    REQUIRE(s.mask.faces() == (kind == ViewKind::window ? 1 : 6));
    CHECK_FALSE(s.mask.full());
    CHECK(std::max(s.mask.face(0).window.width, s.mask.face(0).window.height) == s.resolution);
    int wrong = 0, loose = 0;
    each_pixel(s.mask, [&](const Pixel& p) {
      const auto c = corners(s.mask, p);
      if (covered(s.mask, p)) {
        wrong += !all_beyond_one_side(s.volume, c, 0);
      } else {
        loose += all_beyond_one_side(s.volume, c, small_angle(s.mask)) && kind == ViewKind::wide;
      }
    });
    CHECK(wrong == 0);
    CHECK(loose == 0);
    for (int i = 0; i < 200; ++i) {
      const Ray d = ray(i < 100 || kind == ViewKind::all_round
                            ? dice.direction()
                            : glm::cross(s.volume.begin()[i % 2].normal, s.volume.begin()[2 + i / 2 % 2].normal));
      if (!in_view(s.volume, d)) continue;
      const Pixel p = pixel_of(s.mask, d);
      REQUIRE(p.face >= 0);
      REQUIRE_FALSE(covered(s.mask, p));
    }
  }
}

TEST_CASE("covered pixels lie inside the cone, and pixels well inside it are covered") {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    Stage s(seed % 2 == 0 ? ViewKind::window : ViewKind::all_round, {8, 16, 40, 72}, dice);
    const Cone cone = random_cone(s.mask, dice);
    cover(s.mask, cone, dice);
    int wrong = 0, lost = 0;
    const bool forgiven = forgivable(cone);
    each_pixel(s.mask, [&](const Pixel& p) {
      const auto c = corners(s.mask, p);
      const auto inside = [&](real margin) {
        return cone.holds(c[0], margin) && cone.holds(c[1], margin) && cone.holds(c[2], margin) &&
               cone.holds(c[3], margin);
      };
      if (covered(s.mask, p)) {
        wrong += !inside(0);
      } else {
        // A ball beside the viewpoint becomes a polygon.
        const real depth = dot(ray(s.mask.face(p.face).forward), unit(ray(cone.axis)));
        const bool polygon = cone.is_ball() && depth - cone.radius / glm::length(cone.axis) < 0.13L;
        lost += !forgiven && inside(polygon ? 0.02L : small_angle(s.mask));
      }
    });
    CHECK(wrong == 0);
    CHECK(lost == 0);
  }
}

TEST_CASE("a ray that comes twice, or nearly, costs no pixel") {
  Dice dice{std::mt19937_64(7)};
  for (const double apart : {0.0, 1e-12, 1e-10, 1e-8, 1e-6}) {
    CAPTURE(apart);
    Stage s(ViewKind::all_round, {128}, dice);
    const std::array<Vec3, 4> square{Vec3{10, -4, -4}, {10, 4, -4}, {10, 4, 4}, {10, -4, 4}};
    const std::array<Vec3, 5> doubled{square[0], square[1], {10, 4, -4 + 8 * apart}, square[2], square[3]};
    const auto covered_by = [&](const auto& rays) {
      s.begin();
      s.mask.cover_convex(rays.data(), static_cast<int>(rays.size()));
      int pixels = 0;
      each_pixel(s.mask, [&](const Pixel& p) { pixels += covered(s.mask, p); });
      return pixels;
    };
    const int plain = covered_by(square);
    CHECK(plain > 1000);
    CHECK(covered_by(doubled) == plain);
  }
}

TEST_CASE("a cone is open while one of its pixels is") {
  for (std::uint64_t seed = 0; seed < 8000; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    Stage s(kinds[seed % 3], {8, 16, 40, 72}, dice);
    const Cone cone = random_cone(s.mask, dice);
    for (int i = 0; i < 12; ++i) {
      const std::vector<Pixel> pixels = pixels_about(s.mask, random_within(cone, dice));
      s.begin();
      if (pixels.empty()) continue;
      const Pixel p = pixels[static_cast<std::size_t>(dice.integer(0, static_cast<int>(pixels.size()) - 1))];
      if (covered(s.mask, p)) continue;
      CAPTURE(i);
      REQUIRE(open(s.mask, cone, dice));
      cover_all_but(s.mask, p);
      REQUIRE_FALSE(s.mask.full());
      REQUIRE(open(s.mask, cone, dice));
      cover_rectangle(s.mask, p.face, p.x, p.x + 1, p.y, p.y + 1);
      REQUIRE(s.mask.full());
      REQUIRE_FALSE(open(s.mask, cone, dice));
    }
  }
}

TEST_CASE("a cone is hidden where it does not reach") {
  for (std::uint64_t seed = 0; seed < 20000; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    Stage s(seed % 2 == 0 ? ViewKind::window : ViewKind::all_round, {16, 40, 72}, dice);
    Cone cone = random_cone(s.mask, dice);
    if (cone.is_ball()) cone.radius = std::min(cone.radius, 0.3 * glm::length(cone.axis));
    // Cover the cone by a slightly larger one of the same kind, and what remains of its border pixels.
    const Pixel p = pixel_of(s.mask, ray(some_direction(s.mask, dice)));
    if (p.face < 0) continue;
    cover_all_but(s.mask, p);
    // A separating plane: an edge of the cone that has the whole pixel outside, or an edge of the pixel.
    const auto c = corners(s.mask, p);
    bool apart = false;
    if (!cone.is_ball()) {
      for (std::size_t k = 0; k < cone.rays.size(); ++k) {
        const Ray n = unit(cross(unit(ray(cone.rays[k])), unit(ray(cone.rays[(k + 1) % cone.rays.size()]))));
        bool all = true;
        for (const Ray& d : c) all = all && dot(n, unit(d)) < -1e-5L;
        apart = apart || all;
      }
      for (std::size_t k = 0; k < 4; ++k) {
        Ray n = unit(cross(c[k], c[(k + 1) % 4]));
        if (dot(n, c[(k + 2) % 4]) < 0) n = real{-1} * n;
        bool all = true;
        for (const Vec3& r : cone.rays) all = all && dot(n, unit(ray(r))) < -1e-5L;
        apart = apart || all;
      }
    } else {
      // A ball: its centre far enough from the pixel's middle and its corners' reach.
      Ray middle{0, 0, 0};
      for (const Ray& d : c) middle = middle + d;
      real reach = 0;
      for (const Ray& d : c) reach = std::max(reach, std::acos(std::min<real>(1, dot(unit(d), unit(middle)))));
      const real angle = std::acos(std::clamp<real>(dot(unit(middle), unit(ray(cone.axis))), -1, 1));
      apart = angle > reach + std::asin(static_cast<real>(cone.radius) / length(ray(cone.axis))) + 0.02L;
    }
    if (apart && !forgivable(cone)) CHECK_FALSE(open(s.mask, cone, dice));
  }
}

TEST_CASE("boxes are open while one of their pixels is, and hidden behind what covers their rectangle") {
  int hidden = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    Stage s(kinds[seed % 3], {8, 40, 72}, dice);
    const double size = dice.power(-3, 9), half = size * dice.power(-5, 0.3);
    Vec3 low, high, middle = size * glm::normalize(some_direction(s.mask, dice));
    for (int k = 0; k < 3; ++k) {
      // Often a corner of the box is the direction itself, which may be that of a pixel's corner.
      low[k] = middle[k] - (dice.chance(0.4) ? 0.0 : half * dice.real(0, 1));
      high[k] = middle[k] + (dice.chance(0.4) ? 0.0 : half * dice.real(0, 1));
    }
    const double off = 0x1p-41 * std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(low.z), std::fabs(high.x),
                                           std::fabs(high.y), std::fabs(high.z)});
    const auto open_box = [&] {
      const auto blur = [&] { return off * Vec3(dice.real(-1, 1), dice.real(-1, 1), dice.real(-1, 1)); };
      const bool narrow = dice.chance(0.5);
      return s.mask.open_box(low + (narrow ? Vec3(off) : blur()), high - (narrow ? Vec3(off) : blur()));
    };
    for (int i = 0; i < 12; ++i) {
      const auto at = [&](int axis) {
        const real t = dice.chance(0.6) ? (dice.chance(0.5) ? 1 : 0) : static_cast<real>(dice.real(0, 1));
        return low[axis] + t * (static_cast<real>(high[axis]) - low[axis]);
      };
      const std::vector<Pixel> pixels = pixels_about(s.mask, i < 4 ? ray(middle) : Ray{at(0), at(1), at(2)});
      s.begin();
      if (pixels.empty()) continue;
      const Pixel p = pixels[static_cast<std::size_t>(dice.integer(0, static_cast<int>(pixels.size()) - 1))];
      if (covered(s.mask, p)) continue;
      CAPTURE(i);
      REQUIRE(open_box());
      cover_all_but(s.mask, p);
      REQUIRE(open_box());
      cover_rectangle(s.mask, p.face, p.x, p.x + 1, p.y, p.y + 1);
      REQUIRE_FALSE(open_box());
      s.begin();
      cover_all_but(s.mask, pixel_of(s.mask, ray(dice.direction())));
      hidden += !s.mask.full() && !open_box();
    }
  }
  CHECK(hidden > 500);
}

TEST_CASE("a rectangle is open where one of its pixels is, and nowhere else") {
  int hidden = 0, opened = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    Stage s(kinds[seed % 3], {8, 40, 72, 200, 640}, dice);
    for (int i = 0; i < 5; ++i) cover(s.mask, random_cone(s.mask, dice), dice);
    const masking::Window& w = s.mask.face(dice.integer(0, s.mask.faces() - 1)).window;
    if (w.open_blocks == 0) continue;
    const auto& open_rectangle = *masking::kernels_of(some_set(dice)).open_rectangle;
    for (int i = 0; i < 40; ++i) {
      masking::Rectangle r{dice.integer(0, w.width - 1), 0, dice.integer(0, w.height - 1), 0};
      r.x1 = dice.integer(r.x0 + 1, dice.chance(0.5) ? std::min(r.x0 + 12, w.width) : w.width);
      r.y1 = dice.integer(r.y0 + 1, dice.chance(0.5) ? std::min(r.y0 + 12, w.height) : w.height);
      bool truth = false;
      for (int y = r.y0; y < r.y1; ++y) {
        for (int x = r.x0; x < r.x1; ++x) {
          truth = truth || (w.words[8 * (y / 8 * w.blocks + x / 64) + y % 8] >> (x % 64) & 1) == 0;
        }
      }
      std::uint64_t strips = 0;
      REQUIRE(open_rectangle(w, r, strips) == truth);
      ++(truth ? opened : hidden);
    }
  }
  CHECK(hidden > 500);
  CHECK(opened > 500);
}

TEST_CASE("a direction is open when its pixel is") {
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    CAPTURE(seed);
    Dice dice{std::mt19937_64(seed)};
    Stage s(kinds[seed % 3], {8, 16, 40}, dice);
    for (int i = 0; i < 4; ++i) cover(s.mask, random_cone(s.mask, dice), dice);
    each_pixel(s.mask, [&](const Pixel& p) {
      const Vec3 d = s.mask.face(p.face).direction(p.x + dice.real(0.01, 0.99), p.y + dice.real(0.01, 0.99));
      REQUIRE(s.mask.open_towards(dice.power(-8, 8) * d) != covered(s.mask, p));
    });
    for (int i = 0; i < 50; ++i) {
      const Vec3 d = dice.direction();
      if (pixel_of(s.mask, ray(d)).face < 0) REQUIRE_FALSE(s.mask.open_towards(d));
    }
  }
}

TEST_CASE("what holds the viewpoint is open until nothing is") {
  Dice dice{std::mt19937_64(7)};
  for (const ViewKind kind : kinds) {
    Stage s(kind, {64}, dice);
    const auto all = [&] {
      return s.mask.open_ball({0.1, 0.2, -0.1}, 0.5) && s.mask.open_ball({0, 0, 0}, 1) &&
             s.mask.open_ball({3, 4, 0}, 5) && s.mask.open_box({-1, -2, -0.5}, {1, 1, 1}) &&
             s.mask.open_box({0, -2, -0.5}, {1, 1, 1});
    };
    CHECK(all());
    // An occluder about the viewpoint covers nothing.
    s.mask.cover_ball({0.1, 0.2, -0.1}, 0.5);
    s.mask.cover_ball({3, 4, 0}, 5);
    CHECK(all());
    cover_all_but(s.mask, {});
    CHECK(s.mask.full());
    CHECK_FALSE(s.mask.open_ball({0.1, 0.2, -0.1}, 0.5));
    CHECK_FALSE(s.mask.open_box({-1, -2, -0.5}, {1, 1, 1}));
    s.begin();
    CHECK_FALSE(s.mask.full());
  }
}

TEST_CASE("pixel lines: a rectangle of whole pixels covers all but its border, and touches the next one") {
  CoverageMask mask(InstructionSet::scalar);
  mask.begin(ViewVolume({}, 3), 64);
  const MaskFace& f = mask.face(0);
  const std::array<Vec3, 4> rays{f.direction(8, 8), f.direction(16, 8), f.direction(16, 24), f.direction(8, 24)};
  mask.cover_convex(rays.data(), 4);
  each_pixel(mask, [&](const Pixel& p) {
    const bool inside = p.face == 0 && p.x > 8 && p.x < 15 && p.y > 8 && p.y < 23;
    REQUIRE(covered(mask, p) == inside);
  });
  cover_all_but(mask, {0, 16, 12});
  CHECK(mask.open_convex(rays.data(), 4));
  mask.begin(ViewVolume({}, 3), 64);
  cover_all_but(mask, {0, 17, 12});
  CHECK_FALSE(mask.open_convex(rays.data(), 4));
}

TEST_CASE("work is counted in strips, and memory is kept between frames") {
  CoverageMask mask(InstructionSet::scalar);
  const ViewVolume volume({}, 3);
  mask.begin(volume, 64);
  const std::uint64_t bytes = mask.bytes();
  CHECK(mask.rows() == 0);
  const MaskFace& f = mask.face(2);
  const std::array<Vec3, 4> rays{f.direction(5, 5), f.direction(20, 5), f.direction(20, 20), f.direction(5, 20)};
  mask.cover_convex(rays.data(), 4);
  CHECK(mask.rows() == 3);
  mask.clear_counts();
  CHECK(mask.open_convex(rays.data(), 4));
  CHECK(mask.rows() == 1);  // the first strip is enough
  mask.begin(volume, 32);
  mask.begin(volume, 64);
  CHECK(mask.bytes() == bytes);
}
