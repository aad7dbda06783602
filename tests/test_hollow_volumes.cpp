// A hollow volume is found by crossing its outline. A viewer that jumps over it, into a closed room within, sees no
// cell of the outline and must be told of the object all the same (DESIGN section 6: hollow volumes missed 4 that way).
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/methods/catalog.h"

namespace gridcull::test {
namespace {

constexpr int across = 6;     // rooms along each side of the world
constexpr double pitch = 16;  // metres and cells
constexpr ObjectId first_pole = 1000;

/// A room of 8 x 2 cells, closed by walls of one cell.
void add_room(Culler& culler, ObjectId first, const Vec3& middle) {
  const double thick = 1.2;  // a cell that touches a face from inside would not be opaque
  for (const double side : {-1.0, 1.0}) {
    culler.add(make_static(first++, Rectangle{{thick, 4.2}}, middle + Vec3(4.5 * side, 0, 0)));
    culler.add(make_static(first++, Rectangle{{10.2, thick}}, middle + Vec3(0, 1.5 * side, 0)));
  }
}

Vec3 middle_of(int room) { return {pitch * (room % across + 0.5), pitch * (room / across + 0.5), 0.0}; }

}  // namespace

TEST_CASE("a viewer that jumps into a closed room inside an outline is told who is there") {
  for (const MethodEntry& method : method_catalog()) {
    if (method.info.guarantee != Guarantee::conservative || !method.info.takes_2d) continue;
    CAPTURE(std::string(method.info.name));
    MethodOptions options;
    options.bounds = {{0, 0, 0}, {across * pitch, across * pitch, 0}};
    options.tbv = "hollow";
    const auto culler = method.make(options);
    // Poles as long as the rooms: volumes reach 3.5 m and up to 3 cells, walls 5.5 m.
    for (int room = 0; room < across * across; ++room) {
      add_room(*culler, static_cast<ObjectId>(4 * room), middle_of(room));
      culler->add(make_object(first_pole + static_cast<ObjectId>(room), Rectangle{{7, 0.2}}, middle_of(room), 1.0));
    }
    Answers answers;
    double time = 0.0;
    // Nobody looks: all poles hide, and their terms grow.
    for (int frame = 0; frame < 60; ++frame) culler->query(time += 0.5, {}, answers);
    for (int room = 0; room < across * across; ++room) {
      CAPTURE(room);
      const View view = make_view(1, middle_of(room) + Vec3(0.3, 0.6, 0));
      culler->query(time += 0.5, {&view, 1}, answers);
      CHECK(sees(answers.views.at(0), first_pole + static_cast<ObjectId>(room)));
    }
  }
}

}  // namespace gridcull::test
