// Every conservative method on the hand-made scenes: who must be seen is reported, at several cell sizes, the first
// time the viewer is asked for and after everything has been hidden.
#include <algorithm>

#include <doctest/doctest.h>

#include "gridcull/core/bounds.h"
#include "gridcull/methods/catalog.h"
#include "hand_made_scenes.h"

namespace gridcull::test {
namespace {

/// The box of all objects and the viewer.
Bounds bounds_of(const HandMadeScene& scene) {
  Bounds b;
  b.add(scene.view.pose.position);
  for (const Object& o : scene.objects) b.add_ball(o.pose.position, std::min(reach_of(o.shape), 1e3));
  if (scene.dimension == 2) b.min.z = b.max.z = 0.0;
  return b;
}

void check_scene(const HandMadeScene& scene, const MethodEntry& method, double cells, const char* tbv) {
  MethodOptions options;
  options.dimension = scene.dimension;
  options.bounds = bounds_of(scene);
  const Vec3 size = options.bounds.size();
  options.cell = std::max({size.x, size.y, size.z, 1e-3}) / cells;
  options.tbv = tbv;
  const auto culler = method.make(options);
  for (Object o : scene.objects) {
    if (!o.is_static && !o.max_speed) o.max_speed = options.cell;
    culler->add(o);
  }
  Answers answers;
  for (int frame = 0; frame < 4; ++frame) {
    // Frame 1 has no viewer: whatever may hide is hidden then.
    const std::span<const View> views(&scene.view, frame == 1 ? 0 : 1);
    culler->query(frame, views, answers);
    if (frame == 1) continue;
    const std::vector<ObjectId>& visible = answers.views.at(0).visible;
    for (const ObjectId id : scene.sees) {
      CAPTURE(frame);
      CAPTURE(id);
      CHECK(std::binary_search(visible.begin(), visible.end(), id));
    }
  }
}

}  // namespace

TEST_CASE("conservative methods report who must be seen in hand-made scenes") {
  int scenes = 0;
  for (const HandMadeScene& scene : hand_made_scenes()) {
    CAPTURE(scene.name);
    for (const MethodEntry& method : method_catalog()) {
      const bool takes = scene.dimension == 2 ? method.info.takes_2d : method.info.takes_3d;
      if (method.info.guarantee != Guarantee::conservative || !takes) continue;
      CAPTURE(method.info.name);
      for (const double cells : {1.0, 7.0, 16.0, scene.dimension == 2 ? 101.0 : 40.0}) {
        CAPTURE(cells);
        for (const char* tbv : {"off", "solid", "hollow"}) check_scene(scene, method, cells, tbv);
      }
    }
    ++scenes;
  }
  CHECK(scenes > 20);
}

}  // namespace gridcull::test
