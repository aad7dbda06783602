// Pieces and mask together: a direction that the mask calls covered must meet the shape by the key, and the shape's
// outer cone must look open wherever the shape shows.
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "gridcull/grid/coverage_mask.h"
#include "gridcull/grid/occluder_pieces.h"
#include "gridcull/grid/outer_outline.h"
#include "gridcull/grid/piece_sections.h"
#include "random_solids.h"
#include "ray_truth.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

bool is_covered(const CoverageMask& mask, const Vec3& d) {
  const Vec3 off = 1e-7 * (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z)) * Vec3(0.3, 0.5, -0.7);
  const std::array<Vec3, 3> rays{d, d + off, d + Vec3(off.y, -off.x, off.z)};
  return !mask.open_convex(rays.data(), 3);
}

/// A direction about an outline: a mix of its rays, or anything.
Vec3 near_outline(const Outline& outline, std::mt19937_64& random) {
  Vec3 sum(0.0);
  if (random() % 8 == 0) return {unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5};
  for (int i = 0; i < outline.count; ++i) {
    sum += (unit(random) - 0.02) * glm::normalize(outline.rays[static_cast<std::size_t>(i)]);
  }
  return sum;
}

struct Counts {
  int pieces = 0, covered = 0, tried = 0;
};

void check_covers(const Placement& placed, CoverageMask& mask, std::mt19937_64& random, Counts& counts) {
  const RayTruth truth(placed.shape, placed.pose, placed.eye);
  if (truth.holds_eye()) return;
  View view;
  view.pose.position = placed.eye;
  const ViewVolume volume(view, 3);
  const SightFrame frame = sight_frame(placed.pose, rotation_of(placed.pose.orientation), placed.eye);
  for (const ConvexPiece& piece : make_occluder_pieces(placed.shape).pieces) {
    std::array<Section, max_sections> nested;
    const int count = sections({piece, frame}, nested);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const Section& section = nested[i];
      mask.begin(volume, 64);
      mask.cover_convex(section.outline.rays.data(), section.outline.count);
      ++counts.pieces;
      for (int k = 0; k < 15; ++k) {
        const Vec3 d = near_outline(section.outline, random);
        ++counts.tried;
        if (!is_covered(mask, d)) continue;
        ++counts.covered;
        const auto at = truth.entrance(longer(d));
        REQUIRE(at.has_value());
        REQUIRE(*at <= static_cast<long double>(section.key));
      }
    }
  }
}

}  // namespace

TEST_CASE("pieces in the mask: what is covered meets the shape by the key") {
  std::mt19937_64 random(11);
  CoverageMask mask(InstructionSet::scalar);
  Counts counts;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    CAPTURE(seed);
    check_covers(random_placement(seed), mask, random, counts);
  }
  MESSAGE(counts.pieces << " outlines, " << counts.covered << " of " << counts.tried << " directions covered");
  CHECK(counts.covered > counts.tried / 4);
}

TEST_CASE("pieces in the mask: an object that shows is open") {
  // One occluder and one object behind, beside or before it; a ray that reaches the object first must find it open.
  std::mt19937_64 random(12);
  CoverageMask mask(InstructionSet::scalar);
  int shown = 0, hidden = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    CAPTURE(seed);
    const Placement occluder = random_placement(2 * seed);
    Placement occludee = random_placement(2 * seed + 1);
    occludee.eye = occluder.eye;
    occludee.pose.position = occluder.eye + (1.0 + 2.0 * unit(random)) * (occluder.pose.position - occluder.eye) +
                             4.0 * Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5);
    const RayTruth front(occluder.shape, occluder.pose, occluder.eye),
        back(occludee.shape, occludee.pose, occluder.eye);
    if (front.holds_eye() || back.holds_eye()) continue;
    const ConvexPiece hull = make_outer_hull(occludee.shape);
    const SightFrame frame = sight_frame(occludee.pose, rotation_of(occludee.pose.orientation), occluder.eye);
    Outline outer;
    if (!outer_outline({hull, frame}, outer)) continue;
    View view;
    view.pose.position = occluder.eye;
    mask.begin(ViewVolume(view, 3), 128);
    // All that may be in the mask when the object is tested at its nearest distance.
    const SightFrame sight = sight_frame(occluder.pose, rotation_of(occluder.pose.orientation), occluder.eye);
    for (const ConvexPiece& piece : make_occluder_pieces(occluder.shape).pieces) {
      std::array<Section, max_sections> nested;
      const int count = sections({piece, sight}, nested);
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        if (nested[i].key > outer.nearest) continue;
        mask.cover_convex(nested[i].outline.rays.data(), nested[i].outline.count);
      }
    }
    if (mask.open_convex(outer.rays.data(), outer.count)) {
      ++shown;
      continue;
    }
    ++hidden;
    const std::vector<Vec3> points = world_vertices(occludee.shape, occludee.pose);
    for (int k = 0; k < 40; ++k) {
      Long3 d = longer(points[random() % points.size()]) - longer(occluder.eye);
      if (k % 2 == 0)
        d = d + static_cast<long double>(unit(random)) *
                    (longer(points[random() % points.size()]) - longer(occluder.eye) - d);
      const auto near = front.entrance(d), far = back.entrance(d);
      if (far) REQUIRE((near && *near <= *far));
    }
  }
  MESSAGE(shown << " shown, " << hidden << " hidden");
  CHECK(hidden > 100);
}
