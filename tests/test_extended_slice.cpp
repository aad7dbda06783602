// Slices of concave prisms: covered pixels lie inside, and seams between convex pieces are closed.
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/view_volume.h"
#include "gridcull/methods/extended_pieces.h"
#include "gridcull/methods/extended_slice.h"
#include "gridcull/sim/random.h"
#include "random_solids.h"

namespace gridcull::test {
namespace {

using namespace extended;

constexpr int resolution = 48;

struct Cut {
  ViewCell cell{};
  Facing facing{};
  Plane plane{};
  DepthMap map{};

  Cut(const Object& object, double distance, const Facing& towards) : facing(towards) {
    cell.half = Vec3(1.0);
    plane = make_plane(cell.half, distance, resolution);
    map.reset(resolution);
    const Occluder occluder = make_occluder(object);
    if (!occluder.concave.outline.empty()) cover_slice(cell, facing, plane, occluder.concave, occluder.blur, map);
  }
  /// A point of the pixel, in the world.
  Vec3 at(int x, int y, double dx, double dy) const {
    const Vec2 p = (Vec2(x, y) + Vec2(dx, dy)) * plane.pixel() - plane.extent;
    Vec3 out;
    out[(facing.axis + 1) % 3] = p.x;
    out[(facing.axis + 2) % 3] = p.y;
    out[facing.axis] = facing.sign * plane.distance;
    return out;
  }
};

}  // namespace

TEST_CASE("pixels of a slice lie inside the prism") {
  std::uint64_t covered = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    std::mt19937_64 bits(seed);
    Object object;
    std::vector<Vec2> outline = random_outline(bits);
    for (Vec2& p : outline) p *= random.uniform(0.5, 4.0);
    object.shape = Prism{outline, random.uniform(1, 30)};
    const Facing facing = facings[seed % 6];
    object.pose.position[facing.axis] = facing.sign * 12.0;
    if (seed % 2 == 0) {
      object.pose.orientation = normalised({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1});
    }
    const Cut cut(object, random.uniform(8, 16), facing);
    for (int y = 0; y < resolution; ++y) {
      for (int x = 0; x < resolution; ++x) {
        if (cut.map.at(x, y) == DepthMap::uncovered) continue;
        ++covered;
        CHECK(cut.map.at(x, y) >= cut.plane.distance);
        for (int k = 0; k < 6; ++k) {
          const double dx = k < 4 ? k & 1 : random.unit(), dy = k < 4 ? k >> 1 : random.unit();
          CHECK(interior_holds(object.shape, object.pose, cut.at(x, y, dx, dy)));
        }
      }
    }
  }
  MESSAGE("covered pixels: " << covered);
  CHECK(covered > 2000);
}

TEST_CASE("a slice has no seams") {
  // An L across the plane x = 10: cut there it is 12 m wide, over its whole height.
  Object object;
  object.shape = Prism{{{8, -6}, {14, -6}, {14, 0}, {12, 0}, {12, 6}, {8, 6}}, 20.2};
  object.pose.position.z = -10.1;
  const Cut cut(object, 10.0, facings[0]);
  const Vec2 pixel = cut.plane.pixel();
  const int wide = static_cast<int>(cut.map.covered_pixels());
  const int across = static_cast<int>(std::floor(12.0 / pixel.x)), up = static_cast<int>(std::floor(20.2 / pixel.y));
  CHECK(wide >= (across - 1) * (up - 1));
  int row = 0;
  for (int x = 0; x < resolution; ++x) row += cut.map.at(x, resolution / 2) < DepthMap::uncovered;
  CHECK(row >= across - 1);
}

}  // namespace gridcull::test
