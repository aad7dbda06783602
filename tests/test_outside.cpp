// Objects beyond the bounds are seen across the border, whatever hides the border's cells (DESIGN section 6: clamping
// them into those cells missed 1,578).
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/methods/catalog.h"

namespace gridcull::test {
namespace {

constexpr ObjectId wall = 1, first_far = 10;
constexpr int crowd = 40;  // more than a node of the loose index is opened for without a test

struct Field {
  int dimension;
  bool moving;

  double z() const { return dimension == 3 ? 16.125 : 0.0; }

  /// From the viewer in the west the wall hides the south-east border with some nodes of the index that stick out of it,
  /// but no line to what lies far beyond.
  std::vector<Object> objects() const {
    const Shape slab = dimension == 2 ? Shape(Rectangle{{4, 77}}) : Shape(Cuboid{{4, 77, 640}});
    const Shape ball = dimension == 2 ? Shape(Disc{0.4}) : Shape(Sphere{0.4});
    std::vector<Object> out{make_static(wall, slab, {100, 23.5, z()})};
    for (int i = 0; i < crowd; ++i) {
      Object far = make_object(first_far + static_cast<ObjectId>(i), ball, {3000.0 + 3 * i, 1, z()}, 0.5);
      far.is_static = !moving;
      far.occluder = false;
      out.push_back(far);
    }
    return out;
  }
};

void check_field(const MethodEntry& method, const Field& field, const char* tbv) {
  MethodOptions options;
  options.dimension = field.dimension;
  options.bounds = {{0, 0, 0}, {256, 256, field.dimension == 3 ? 32.0 : 0.0}};
  options.cell = 1.0;
  options.tbv = tbv;
  const auto culler = method.make(options);
  for (const Object& object : field.objects()) culler->add(object);
  const View view = make_view(1, {64, 64, field.z()});
  Answers answers;
  for (int frame = 0; frame < 3; ++frame) {
    CAPTURE(frame);
    culler->query(frame, {&view, frame == 1 ? 0u : 1u}, answers);  // nobody looks in between: all hide that may
    if (frame == 1) continue;
    for (int i = 0; i < crowd; ++i) CHECK(sees(answers.views.at(0), first_far + static_cast<ObjectId>(i)));
  }
}

}  // namespace

TEST_CASE("objects beyond the bounds are seen though the border is hidden") {
  for (const MethodEntry& method : method_catalog()) {
    if (method.info.guarantee != Guarantee::conservative) continue;
    CAPTURE(std::string(method.info.name));
    for (const int dimension : {2, 3}) {
      if (!(dimension == 2 ? method.info.takes_2d : method.info.takes_3d)) continue;
      CAPTURE(dimension);
      for (const bool moving : {false, true}) {
        CAPTURE(moving);
        for (const char* tbv : {"off", "solid", "hollow"}) check_field(method, {dimension, moving}, tbv);
      }
    }
  }
}

}  // namespace gridcull::test
