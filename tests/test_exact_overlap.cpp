// The specialised interference test against the naive one of Hudson et al. 1997, section 5.3, and what both cost,
// counted as in their table 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/methods/exact_overlap.h"

using namespace gridcull;

namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
Vec3 cube(std::mt19937_64& random) { return 2.0 * Vec3(unit(random), unit(random), unit(random)) - 1.0; }

/// A four-sided frustum from the origin along +x, with or without a far plane.
struct Frustum4 {
  std::vector<ShadowPlane> planes;
  std::vector<VolumeEdge> edges;
  std::vector<std::vector<Vec3>> faces;  ///< corners in order; endless ones are cut far away
};

constexpr double for_ever = 1e6;

Frustum4 make_frustum(double y, double z, double near, double far) {
  const bool endless = far >= for_ever;
  Frustum4 out;
  std::array<Vec3, 4> n{}, f{};
  constexpr std::array<std::array<double, 2>, 4> signs{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    n[i] = near * Vec3(1.0, y * signs[i][0], z * signs[i][1]);
    f[i] = far * Vec3(1.0, y * signs[i][0], z * signs[i][1]);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    Vec3 normal = glm::normalize(glm::cross(n[i], n[j]));
    if (normal.x < 0.0) normal = -normal;
    out.planes.push_back({normal, 0.0, 0.0, 0.0});
    out.faces.push_back({n[i], n[j], f[j], f[i]});
    out.edges.push_back({n[i], n[j] - n[i], false});
    out.edges.push_back({n[i], f[i] - n[i], endless});
    if (!endless) out.edges.push_back({f[i], f[j] - f[i], false});
  }
  out.planes.push_back({{1, 0, 0}, near, 0.0, 0.0});
  out.faces.push_back({n[0], n[1], n[2], n[3]});
  if (endless) return out;
  out.planes.push_back({{-1, 0, 0}, -far, 0.0, 0.0});
  out.faces.push_back({f[0], f[1], f[2], f[3]});
  return out;
}

Vec3 corner(const TurnedBox& box, int i) {
  return box.centre + ((i & 1) ? 1.0 : -1.0) * box.half.x * box.axes[0] +
         ((i & 2) ? 1.0 : -1.0) * box.half.y * box.axes[1] + ((i & 4) ? 1.0 : -1.0) * box.half.z * box.axes[2];
}

/// An edge against one convex face by vector products: where it meets the face's plane, is it left of all its edges?
bool meets_face(const Vec3& from, const Vec3& along, const std::vector<Vec3>& face, const Vec3& normal,
                Operations& done) {
  const double at = glm::dot(normal, from - face[0]), speed = glm::dot(normal, along);
  done.dots += 2;
  done.sums += 1;
  if (speed == 0.0) return false;
  const double t = -at / speed;
  if (!(t >= 0.0 && t <= 1.0)) return false;
  const Vec3 p = from + t * along;
  done.scalings += 1;
  done.sums += 1;
  int left = 0;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 n = glm::cross(face[(i + 1) % face.size()] - face[i], p - face[i]);
    left += glm::dot(n, normal) >= 0.0 ? 1 : -1;
    done.sums += 2;
    done.crosses += 1;
    done.dots += 1;
  }
  return left == static_cast<int>(face.size()) || left == -static_cast<int>(face.size());
}

constexpr std::array<std::array<int, 4>, 6> box_faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

Overlap naive_overlap(const Frustum4& frustum, const TurnedBox& box, Operations& done) {
  bool inside = true;
  for (const ShadowPlane& plane : frustum.planes) {
    bool all_out = true;
    for (int i = 0; i < 8; ++i) {
      const bool in = glm::dot(plane.normal, corner(box, i)) >= plane.offset;
      ++done.dots;
      all_out = all_out && !in;
      inside = inside && in;
    }
    if (all_out) return Overlap::outside;
  }
  if (inside) return Overlap::inside;
  for (const VolumeEdge& edge : frustum.edges) {
    const Vec3 along = edge.endless ? for_ever / glm::length(edge.along) * edge.along : edge.along;
    for (const auto& f : box_faces) {
      const std::vector<Vec3> face{corner(box, f[0]), corner(box, f[1]), corner(box, f[2]), corner(box, f[3])};
      const Vec3 normal = glm::cross(face[1] - face[0], face[3] - face[0]);
      if (meets_face(edge.from, along, face, normal, done)) return Overlap::partial;
    }
  }
  for (int i = 0; i < 8; ++i) {
    for (const int bit : {1, 2, 4}) {
      if ((i & bit) != 0) continue;
      const Vec3 from = corner(box, i), along = corner(box, i | bit) - from;
      for (std::size_t k = 0; k < frustum.faces.size(); ++k) {
        if (meets_face(from, along, frustum.faces[k], frustum.planes[k].normal, done)) return Overlap::partial;
      }
    }
  }
  // The frustum wholly in the box: one of its points tells.
  const Vec3 p = frustum.edges[0].from - box.centre;
  bool holds = true;
  for (int k = 0; k < 3; ++k) {
    holds = holds && std::fabs(glm::dot(p, box.axes[static_cast<std::size_t>(k)])) <= box.half[k];
    ++done.dots;
  }
  return holds ? Overlap::partial : Overlap::outside;
}

TurnedBox random_box(std::mt19937_64& random, bool turned) {
  TurnedBox box;
  box.centre = Vec3(8.0 * unit(random) - 1.0, 6.0 * unit(random) - 3.0, 6.0 * unit(random) - 3.0);
  box.half = std::pow(2.0, 6.0 * unit(random) - 4.0) * (0.5 + 0.5 * Vec3(unit(random), unit(random), unit(random)));
  if (!turned) return box;
  box.along_axes = false;
  box.axes[0] = glm::normalize(cube(random) + Vec3(0.0, 0.0, 1e-3));
  box.axes[1] = glm::normalize(glm::cross(box.axes[0], cube(random)));
  box.axes[2] = glm::cross(box.axes[0], box.axes[1]);
  return box;
}

struct Span {
  Operations most{};
  std::uint64_t least_dots = ~std::uint64_t{0};

  void add(const Operations& o) {
    most.dots = std::max(most.dots, o.dots);
    most.scalings = std::max(most.scalings, o.scalings);
    most.sums = std::max(most.sums, o.sums);
    most.crosses = std::max(most.crosses, o.crosses);
    least_dots = std::min(least_dots, o.dots);
  }
  std::string text() const {
    return std::to_string(most.dots) + " (" + std::to_string(least_dots) + ") dot products, " +
           std::to_string(most.scalings) + " scalings, " + std::to_string(most.sums) + " sums, " +
           std::to_string(most.crosses) + " cross products";
  }
};

}  // namespace

TEST_CASE("exact overlap: the specialised test says what the naive one says, for less") {
  std::mt19937_64 random(7);
  for (const bool far_plane : {false, true}) {
    for (const bool turned : {false, true}) {
      CAPTURE(far_plane);
      CAPTURE(turned);
      Span naive, specialised;
      std::array<int, 3> outcomes{};
      int only_exact = 0;
      for (int k = 0; k < 20000; ++k) {
        CAPTURE(k);
        const Frustum4 frustum = make_frustum(0.1 + unit(random), 0.1 + unit(random), 0.2 + unit(random),
                                              far_plane ? 2.0 + 4.0 * unit(random) : for_ever);
        const TurnedBox box = random_box(random, turned);
        Operations slow, fast;
        const Overlap expected = naive_overlap(frustum, box, slow);
        const Overlap found = exact_overlap(frustum.planes, frustum.edges, box, fast);
        REQUIRE(found == expected);
        ++outcomes[static_cast<std::size_t>(found)];
        naive.add(slow);
        specialised.add(fast);
        only_exact += found == Overlap::outside && fast.dots > 30 ? 1 : 0;
      }
      const std::string title =
          std::string(far_plane ? "with" : "without") + " far plane, boxes " + (turned ? "turned" : "along the axes");
      MESSAGE(title << "\n  naive: " << naive.text() << "\n  specialised: " << specialised.text() << "\n  outside "
                    << outcomes[0] << ", by edges only " << only_exact << ", partial " << outcomes[1] << ", inside "
                    << outcomes[2]);
      for (const int count : outcomes) CHECK(count > 100);
      if (turned) CHECK(only_exact > 100);
      // The paper's table 1: fewer products and sums, no cross products, a first plane that rejects for less.
      CHECK(specialised.most.crosses == 0);
      CHECK(naive.most.crosses > 50);
      CHECK(specialised.most.dots < naive.most.dots);
      CHECK(specialised.most.sums < naive.most.sums);
      CHECK(naive.least_dots == 8);
      CHECK(specialised.least_dots == (turned ? 5u : 2u));
    }
  }
}

TEST_CASE("exact overlap: boxes beside a cone that no single side parts from it") {
  const auto parts = make_occluder_parts(Cuboid{{1, 2, 2}});
  const Pose pose{{5, 4, 3}, normalised({0.8, 0.3, 0.4, 0.3})};
  ShadowFrustum frustum;
  SilhouetteTrack track;
  REQUIRE(frustum.build(parts[0], pose, rotation_of(pose.orientation), {0, 0, 0}, track));
  std::vector<VolumeEdge> scratch;
  Operations done;
  std::uint64_t tests = 0;
  std::mt19937_64 random(8);
  int beside = 0, partial = 0;
  for (int k = 0; k < 20000; ++k) {
    CAPTURE(k);
    const Vec3 low = 12.0 * cube(random);
    const SightBox box({low, low + 8.0 * Vec3(unit(random), unit(random), unit(random))}, {0, 0, 0});
    if (frustum.overlap(box, tests) != Overlap::partial) continue;
    ++partial;
    if (!lies_beside(frustum, box, scratch, done)) continue;
    ++beside;
    for (int i = 0; i < 50; ++i) {
      const Vec3 p = box.centre + box.half * cube(random);
      REQUIRE_FALSE(frustum.holds_ray(p, glm::length(p), 0.0, tests));
    }
  }
  CHECK(partial > 1000);
  CHECK(beside > 50);
}
