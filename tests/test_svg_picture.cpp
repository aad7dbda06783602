// The parts of a picture: cells merged into few rectangles, outlines and slices, the SVG itself.
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <pugixml.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/picture_request.h"
#include "gridcull/service/slice.h"
#include "gridcull/service/svg_cells.h"
#include "gridcull/service/svg_frame.h"
#include "gridcull/service/svg_picture.h"

using namespace gridcull;

namespace {

std::set<std::pair<std::int64_t, std::int64_t>> cells_of(const std::vector<CellRect>& rects, bool& disjoint) {
  std::set<std::pair<std::int64_t, std::int64_t>> cells;
  for (const CellRect& r : rects) {
    for (auto y = r.y0; y < r.y1; ++y) {
      for (auto x = r.x0; x < r.x1; ++x) disjoint = cells.insert({x, y}).second && disjoint;
    }
  }
  return cells;
}

double area_of(const std::vector<Vec2>& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) twice += cross2(ring[i], ring[(i + 1) % ring.size()]);
  return 0.5 * std::abs(twice);
}

}  // namespace

TEST_CASE("merged cells are the cells that were added, each once") {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    std::mt19937 random(seed);
    CellPlane plane;
    std::set<std::pair<std::int64_t, std::int64_t>> wanted;
    for (int i = 0; i < 30; ++i) {
      const auto x = static_cast<std::int64_t>(random() % 20) - 5, y = static_cast<std::int64_t>(random() % 20) - 5;
      const CellRect rect{x, y, x + 1 + static_cast<std::int64_t>(random() % 6),
                          y + 1 + static_cast<std::int64_t>(random() % 4)};
      plane.add(rect);
      for (auto v = rect.y0; v < rect.y1; ++v) {
        for (auto u = rect.x0; u < rect.x1; ++u) wanted.insert({u, v});
      }
    }
    bool disjoint = true;
    CHECK(cells_of(plane.merged(), disjoint) == wanted);
    CHECK(disjoint);
  }
}

TEST_CASE("a block of cells becomes one rectangle") {
  CellPlane plane;
  for (std::int64_t y = 3; y < 50; ++y) {
    for (std::int64_t x = -4; x < 60; ++x) plane.add({x, y, x + 1, y + 1});
  }
  CHECK(plane.merged() == std::vector<CellRect>{{-4, 3, 60, 50}});
  CHECK(path_of(plane.merged()) == "M-4 3h64v47h-64z");
}

TEST_CASE("slices of solids") {
  const Slice sphere = slice_of({.id = 0, .shape = Sphere{5.0}, .pose = {{1.0, 2.0, 3.0}}}, 6.0);
  CHECK(sphere.radius == doctest::Approx(4.0));
  CHECK(slice_of({.id = 0, .shape = Sphere{5.0}}, 5.5).empty());
  const Object box{.id = 1, .shape = Cuboid{{4.0, 2.0, 6.0}}, .pose = {{0, 0, 0}, turn_about_z(0.7)}};
  REQUIRE(slice_of(box, 1.0).rings.size() == 1);
  CHECK(area_of(slice_of(box, 1.0).rings[0]) == doctest::Approx(8.0));
  CHECK(slice_of(box, 3.5).empty());
  // An upright prism shows its concave outline, a leaning one the hull of its cut.
  const Prism corner{{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}, 10.0};
  REQUIRE(slice_of({.id = 2, .shape = corner}, 5.0).rings.size() == 1);
  CHECK(area_of(slice_of({.id = 2, .shape = corner}, 5.0).rings[0]) == doctest::Approx(7.0));
  CHECK(slice_of({.id = 2, .shape = corner}, 11.0).empty());
  const Faces wall{{{0, 0, 0}, {2, 0, 0}, {2, 0, 4}, {0, 0, 4}}, {{0, 1, 2}, {0, 2, 3}}};
  CHECK(slice_of({.id = 3, .shape = wall}, 1.0).chains.size() == 2);
}

TEST_CASE("the outline of the view volume") {
  View view{.viewer = 1, .range = 10.0, .fov = std::numbers::pi / 2};
  CHECK(area_of(view_outline(view, 2, 1e3)) == doctest::Approx(25.0 * std::numbers::pi).epsilon(0.001));
  view.fov = 2.0 * std::numbers::pi;
  CHECK(area_of(view_outline(view, 2, 1e3)) == doctest::Approx(100.0 * std::numbers::pi).epsilon(0.001));
  view.fov = 1.5 * std::numbers::pi;
  CHECK(area_of(view_outline(view, 2, 1e3)) == doctest::Approx(75.0 * std::numbers::pi).epsilon(0.001));
  view.frustum = Frustum{.fov_y = 1.0, .aspect = 1.0, .near = 1.0, .far = 3.0};
  const double across = 2.0 * std::tan(0.5);
  CHECK(area_of(view_outline(view, 3, 1e3)) == doctest::Approx(0.5 * across * (9.0 - 1.0)).epsilon(0.001));
}

TEST_CASE("a picture is well-formed and shows each object as what it is") {
  const Lattice lattice(2, {{0, 0, 0}, {100, 60, 0}}, 1.0, 1 << 20);
  const std::vector<Object> objects{
      {.id = 5, .shape = Rectangle{{10, 8}}, .pose = {{50, 30, 0}}},
      {.id = 6, .shape = Disc{2.0}, .pose = {{80, 30, 0}}},
      {.id = 7, .shape = Polyline{{{0, 0}, {10, 0}}}, .pose = {{20, 10, 0}}},
      {.id = 8, .shape = Rectangle{{4, 2}}, .pose = {{10, 30, 0}}},
  };
  const View view{.viewer = 3, .pose = {{10, 30, 0}}, .range = 80.0, .rides = 8};
  const std::vector<ObjectId> visible{5, 7};
  PictureSink sink(lattice);
  sink.cells(CellLayer::visited, {10, 30, 0}, {12, 31, 0});
  sink.cells(CellLayer::opaque, {50, 30, 0}, {51, 31, 0});
  sink.tbv(6, {80, 30, 0}, 4.0, false);
  const Picture picture{
      .lattice = lattice, .objects = objects, .view = view, .visible = visible, .title = "a < b & \"c\""};
  const std::string svg = svg_picture(picture, &sink);
  pugi::xml_document document;
  REQUIRE(document.load_string(svg.c_str()));
  CHECK(std::string(document.child("svg").child("title").child_value()) == "a < b & \"c\"");
  const auto map = document.child("svg").find_child_by_attribute("g", "clip-path", "url(#map)");
  const auto count = [&](const char* style) {
    return map.select_nodes((std::string("*[@class='") + style + "']").c_str()).size();
  };
  CHECK(count("seen") == 1);
  CHECK(count("seen chain") == 1);
  CHECK(count("unseen") == 1);
  CHECK(count("own") == 1);
  CHECK(count("tbv") == 1);
  CHECK(std::string(map.select_node("g/path[@class='opaque']").node().attribute("d").value()) == "M50 30h1v1h-1z");
  CHECK(std::string(map.select_node("g/path[@class='visited']").node().attribute("d").value()) == "M10 30h2v1h-2z");
  // Without a grid only the objects remain.
  REQUIRE(document.load_string(svg_picture(picture, nullptr).c_str()));
  CHECK(document.select_node("//path[@class='opaque']").node().empty());
  CHECK(svg_picture(picture, &sink) == svg);
}

TEST_CASE("where it is known what the viewer sees, that is drawn and cells looked into stand back") {
  const Lattice lattice(2, {{0, 0, 0}, {100, 60, 0}}, 1.0, 1 << 20);
  const View view{.viewer = 3, .pose = {{10, 30, 0}}, .range = 80.0};
  const Picture picture{.lattice = lattice, .view = view};
  PictureSink sink(lattice);
  sink.cells(CellLayer::visited, {8, 28, 0}, {16, 36, 0});
  sink.cells(CellLayer::hidden, {80, 56, 0}, {88, 64, 0});  // a node of an index may stick out of the lattice
  CHECK(svg_picture(picture, &sink).find("class=\"visited\"") != std::string::npos);
  sink.region(std::vector<Vec2>{{10, 30}, {50, 20}, {50, 40}});
  const std::string svg = svg_picture(picture, &sink);
  pugi::xml_document document;
  REQUIRE(document.load_string(svg.c_str()));
  CHECK(!document.select_node("//path[@class='region']").node().empty());
  CHECK(!document.select_node("//rect[@class='region']").node().empty());
  CHECK(!document.select_node("//path[@class='met']").node().empty());
  CHECK(!document.select_node("//path[@class='hidden']").node().empty());
  CHECK(document.select_node("//path[@class='visited']").node().empty());
}

TEST_CASE("of a box about objects those cells are hidden that lie within it, and those looked into that it touches") {
  const Lattice lattice(2, {{0, 0, 0}, {10, 10, 0}}, 1.0, 1 << 20);
  PictureSink sink(lattice);
  sink.cells(CellLayer::hidden, {1.4, 1.4, 0}, {1.6, 8.6, 0});  // no whole cell
  sink.cells(CellLayer::hidden, {3.4, 1.4, 0}, {6.6, 3.0, 0});
  sink.cells(CellLayer::visited, {3.4, 5.4, 0}, {4.6, 6.0, 0});
  CHECK(path_of(sink.plane(CellLayer::hidden, 0).merged()) == "M4 2h2v1h-2z");
  CHECK(path_of(sink.plane(CellLayer::visited, 0).merged()) == "M3 5h2v1h-2z");
}

TEST_CASE("cells are those meant, however far from 0 they lie") {
  for (const double far : {0.0, 5.5e6, 1.2e8, 9e8}) {
    CAPTURE(far);
    const Lattice lattice(2, {{far, far, 0}, {far + 8, far + 8, 0}}, 0.1, 1 << 20);
    PictureSink sink(lattice);
    for (std::int64_t i = 0; i < 80; ++i) {
      const Vec3 low(lattice.boundary(0, i), lattice.boundary(1, 3), 0);
      sink.cells(CellLayer::hidden, low, {lattice.boundary(0, i + 1), lattice.boundary(1, 4), 0});
    }
    CHECK(path_of(sink.plane(CellLayer::hidden, 0).merged()) == "M0 3h80v1h-80z");
  }
}

TEST_CASE("in three dimensions only the viewer's layer is drawn") {
  const Lattice lattice(3, {{0, 0, 0}, {10, 10, 10}}, 1.0, 1 << 20);
  PictureSink sink(lattice);
  sink.cells(CellLayer::hidden, {1, 1, 4}, {2, 2, 5});
  sink.cells(CellLayer::hidden, {3, 3, 6}, {4, 4, 7});
  sink.cells(CellLayer::hidden, {5, 5, 0}, {6, 6, 10});
  CHECK(path_of(sink.plane(CellLayer::hidden, 4).merged()) == "M1 1h1v1h-1zM5 5h1v1h-1z");
  CHECK(sink.plane(CellLayer::opaque, 4).empty());
}

TEST_CASE("picture requests") {
  const PictureRequest request = parse_picture_request("100:7:out/a:b.svg");
  CHECK(request.frame == 100);
  CHECK(request.viewer == 7);
  CHECK(request.file == "out/a:b.svg");
  for (const char* bad :
       {"", "1:2", "1:2:", ":2:x.svg", "1::x.svg", "-1:2:x.svg", "1:4294967295:x.svg", "1.5:2:x.svg"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(parse_picture_request(bad), Error);
  }
  CHECK_NOTHROW(Pictures({"1:2:a.svg", "1:3:b.svg"}, "scene"));  // of one frame as many as are asked for
}

TEST_CASE("the map holds the viewer wherever it stands") {
  const Lattice lattice(2, {{0, 0, 0}, {100, 60, 0}}, 1.0, 1 << 20);
  for (const Vec3 eye : {Vec3(50, 30, 0), Vec3(-500, 3000, 0), Vec3(100, 60, 0)}) {
    for (const double range : {1.0, 80.0, 1e6, std::numeric_limits<double>::infinity()}) {
      const View view{.viewer = 1, .pose = {eye}, .range = range};
      const SvgFrame frame = frame_for(view, lattice, {0, 0}, 800.0);
      CAPTURE(eye.x);
      CAPTURE(range);
      CHECK(frame.scale > 0.0);
      CHECK(frame.crop.min.x < eye.x);
      CHECK(frame.crop.max.x > eye.x);
      CHECK(frame.crop.min.y < eye.y);
      CHECK(frame.crop.max.y > eye.y);
      CHECK(std::max(frame.width(), frame.height()) == doctest::Approx(800.0));
    }
  }
}
