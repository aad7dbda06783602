#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/shape.h"

using namespace gridcull;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string refusal(const Shape& shape) {
  try {
    validate(shape);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::bad_scene);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("shape: good ones pass") {
  CHECK_NOTHROW(validate(Disc{1e-9}));
  CHECK_NOTHROW(validate(Rectangle{{1e9, 0.1}}));
  CHECK_NOTHROW(validate(Polygon{{{0, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 0}}}));
  CHECK_NOTHROW(validate(Polygon{{{0, 0}, {1, 0}, {2, 0}}}));  // without area: allowed, hides nothing
  CHECK_NOTHROW(validate(Polyline{{{0, 0}, {1, 0}}}));
  CHECK_NOTHROW(validate(Convex{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
  CHECK_NOTHROW(validate(Prism{{{0, 0}, {1, 0}, {0, 1}}, 2}));
  CHECK_NOTHROW(validate(Faces{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}}));
}

TEST_CASE("shape: bad ones are refused in one line that names the shape") {
  const std::vector<Shape> bad{
      Disc{0},
      Disc{-1},
      Disc{undefined},
      Disc{infinity},
      Disc{1e300},
      Rectangle{{1, 0}},
      Rectangle{{undefined, 1}},
      Polygon{{{0, 0}, {1, 0}}},
      Polygon{{{0, 0}, {1, 0}, {0, 0}, {1, 0}}},
      Polygon{{{0, 0}, {1, 0}, {infinity, 1}}},
      Polygon{},
      Polyline{{{0, 0}}},
      Polyline{{{0, 0}, {undefined, 0}}},
      Sphere{-2},
      Cuboid{{1, 1, 0}},
      Prism{{{0, 0}, {1, 0}, {0, 1}}, 0},
      Prism{{{0, 0}, {1, 0}}, 1},
      Convex{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
      Convex{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 5, 0}}},
      Convex{{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}},
      Faces{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 3}}}},
      Faces{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}},
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    CAPTURE(i);
    const std::string message = refusal(bad[i]);
    CHECK(message.starts_with(std::string(name_of(bad[i])) + ": "));
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("shape: outlines merge repeated points and keep the rest") {
  CHECK(merged_outline({{0, 0}, {0, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 0}}) == std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}});
  CHECK(merged_outline({}).empty());
  CHECK(merged_outline({{2, 2}, {2, 2}}) == std::vector<Vec2>{{2, 2}});
}

TEST_CASE("shape: world points") {
  const Pose pose{{10, 20, 0}, turn_about_z(0.5 * 3.14159265358979323846)};
  const std::vector<Vec2> box = world_outline(Rectangle{{4, 2}}, pose);
  const std::vector<Vec2> expected{{11, 18}, {11, 22}, {9, 22}, {9, 18}};
  REQUIRE(box.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(glm::length(box[i] - expected[i]) < 1e-14);
  CHECK(world_outline(Disc{1}, pose).empty());
  CHECK(world_outline(Polyline{{{0, 0}, {0, 0}, {1, 0}}}, pose).size() == 3);
  CHECK(world_outline(Sphere{1}, pose).empty());

  const std::vector<Vec3> cuboid = world_vertices(Cuboid{{2, 4, 6}}, Pose{{1, 1, 1}, {}});
  REQUIRE(cuboid.size() == 8);
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner((i & 1) ? 2 : 0, (i & 2) ? 3 : -1, (i & 4) ? 4 : -2);
    CHECK(cuboid[static_cast<std::size_t>(i)] == corner);
  }
  const std::vector<Vec3> prism = world_vertices(Prism{{{0, 0}, {1, 0}, {1, 0}, {0, 1}}, 5}, Pose{{0, 0, 2}, {}});
  CHECK(prism == std::vector<Vec3>{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {0, 0, 7}, {1, 0, 7}, {0, 1, 7}});
  CHECK(world_vertices(Sphere{1}, pose).empty());
}

TEST_CASE("shape: nothing reaches beyond reach_of at any orientation") {
  std::mt19937_64 random(17);
  std::normal_distribution<double> normal;
  const std::vector<Shape> shapes{Rectangle{{3, 4}},
                                  Polygon{{{1, 2}, {-3, 4}, {5, -6}}},
                                  Polyline{{{7, 1}, {0, 0}}},
                                  Cuboid{{1, 2, 3}},
                                  Prism{{{1, 2}, {-3, 4}, {5, -6}}, 9},
                                  Convex{{{1, 2, 3}, {-3, 4, 1}, {5, -6, 0}, {0, 0, 9}}},
                                  Faces{{{1, 2, 3}, {-3, 4, 1}, {5, -6, 0}}, {{{0, 1, 2}}}}};
  for (const Shape& shape : shapes) {
    CAPTURE(name_of(shape));
    double most = 0.0;
    for (int i = 0; i < 200; ++i) {
      const bool flat = dimension_of(shape) == 2;
      const Quat turn = flat ? turn_about_z(normal(random))
                             : normalised({normal(random), normal(random), normal(random), normal(random)});
      for (const Vec2& p : world_outline(shape, {{}, turn})) most = std::max(most, glm::length(p));
      for (const Vec3& p : world_vertices(shape, {{}, turn})) most = std::max(most, glm::length(p));
    }
    CHECK(most <= reach_of(shape));
    CHECK(most >= reach_of(shape) * (1 - 1e-7));
  }
  CHECK(reach_of(Disc{2}) >= 2.0);
  CHECK(reach_of(Sphere{2}) < 2.0 + 1e-7);
}

TEST_CASE("shape: names, dimensions and thinness") {
  CHECK(dimension_of(Polyline{}) == 2);
  CHECK(dimension_of(Sphere{1}) == 3);
  CHECK(name_of(Rectangle{{1, 1}}) == "box");
  CHECK(name_of(Cuboid{{1, 1, 1}}) == "box");
  CHECK(name_of(Faces{}) == "faces");
  CHECK(is_thin(Polyline{}));
  CHECK(is_thin(Faces{}));
  CHECK_FALSE(is_thin(Polygon{}));
}
