// The 2D reference against CGAL's triangular expansion with exact numbers: polygons (concave, crossing each other, on
// lattice points, with common walls) in a large frame. An object is seen in CGAL's words when the visibility polygon
// has an edge on its outline that is not on a line with the viewer.
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>
#include <variant>

#include <CGAL/Arr_naive_point_location.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangular_expansion_visibility_2.h>
#include <doctest/doctest.h>

#include "gridcull/core/exact.h"

using namespace gridcull;

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_2;
using Segment = Kernel::Segment_2;
using Arrangement = CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>>;
using Visibility = CGAL::Triangular_expansion_visibility_2<Arrangement, CGAL::Tag_true>;
using Location = CGAL::Arr_naive_point_location<Arrangement>;

struct Wall {
  Segment segment;
  ObjectId object;
};

std::vector<Wall> walls_of(const std::vector<Object>& world) {
  std::vector<Wall> walls;
  for (const Object& o : world) {
    const std::vector<Vec2> outline = world_outline(o.shape, o.pose);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
      walls.push_back({Segment(Point(a.x, a.y), Point(b.x, b.y)), o.id});
    }
  }
  return walls;
}

/// Nothing when the viewer stands on a wall or the objects' free space does not hold it.
std::optional<std::vector<ObjectId>> seen_by_cgal(const std::vector<Object>& world, const Vec2& eye) {
  const std::vector<Wall> walls = walls_of(world);
  Arrangement arrangement;
  std::vector<Segment> segments;
  for (const Wall& w : walls) segments.push_back(w.segment);
  const double far = 1000;
  const Point corners[] = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};
  for (int i = 0; i < 4; ++i) segments.emplace_back(corners[i], corners[(i + 1) % 4]);
  CGAL::insert(arrangement, segments.begin(), segments.end());
  const Point viewer(eye.x, eye.y);
  const Location location(arrangement);
  const auto where = location.locate(viewer);
  const auto* face = boost::get<Arrangement::Face_const_handle>(&where);
  if (face == nullptr) return std::nullopt;
  const Visibility visibility(arrangement);
  Arrangement region;
  visibility.compute_visibility(viewer, *face, region);
  std::set<ObjectId> seen;
  for (auto e = region.edges_begin(); e != region.edges_end(); ++e) {
    const Point a = e->source()->point(), b = e->target()->point();
    if (CGAL::collinear(viewer, a, b)) continue;
    const Point middle = CGAL::midpoint(a, b);
    for (const Wall& w : walls) {
      if (w.segment.has_on(middle)) seen.insert(w.object);
    }
  }
  return std::vector<ObjectId>(seen.begin(), seen.end());
}

/// Star-shaped about its middle, so it never crosses itself; on lattice points if asked.
std::vector<Vec2> random_outline(std::mt19937_64& random, bool lattice) {
  std::uniform_real_distribution<double> unit(0, 1);
  if (lattice && random() % 2 == 0) {
    const double w = 1 + static_cast<double>(random() % 4), h = 1 + static_cast<double>(random() % 4);
    return {{0, 0}, {w, 0}, {w, h}, {0, h}};
  }
  const int count = 3 + static_cast<int>(random() % 7);
  std::vector<Vec2> outline;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + 0.8 * unit(random)) / count, radius = 0.5 + 3.5 * unit(random);
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

std::vector<Object> random_world(std::mt19937_64& random, bool lattice) {
  std::uniform_real_distribution<double> place(-15, 15);
  std::vector<Object> world;
  const int count = 4 + static_cast<int>(random() % 16);
  for (int i = 0; i < count; ++i) {
    Object o;
    o.id = static_cast<ObjectId>(i);
    o.shape = Polygon{random_outline(random, lattice)};
    const Vec3 p(place(random), place(random), 0);
    o.pose.position = lattice ? Vec3(std::round(p.x), std::round(p.y), 0) : p;
    if (!lattice) o.pose.orientation = turn_about_z(place(random));
    world.push_back(o);
  }
  return world;
}

}  // namespace

TEST_CASE("exact 2d: agrees with CGAL on polygon worlds") {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const bool lattice = seed % 2 == 0;
    const std::vector<Object> world = random_world(random, lattice);
    std::uniform_real_distribution<double> place(-16, 16);
    Vec2 eye(place(random), place(random));
    if (lattice) eye = {std::round(eye.x), std::round(eye.y)};
    View view;
    view.pose.position = Vec3(eye, 0);
    const ExactAnswer ours = exact_visible_2d(world, view);
    const bool inside =
        std::any_of(ours.witness.begin(), ours.witness.end(), [](const Vec3& w) { return w == Vec3(0); });
    if (inside) continue;  // what holds the viewer hides nothing from it: CGAL has no such rule
    const auto theirs = seen_by_cgal(world, eye);
    if (!theirs) continue;
    ++compared;
    CHECK(ours.visible == *theirs);
  }
  CHECK(compared >= 200);
}
