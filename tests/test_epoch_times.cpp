// Simulators count time from where they like, many from 1970. What a frame costs must not depend on it: nodes of the
// index that are too coarse or too fine show in the work counts, though answers are the same.
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/methods/catalog.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"

namespace gridcull::test {
namespace {

/// The frames of a generator, from another time on; steps of 1/16 s are exact at any time asked for here.
class Shifted final : public FrameSource {
 public:
  Shifted(FrameSource& frames, double start) : frames_(frames), start_(start) {}
  bool next(Frame& frame) override {
    if (!frames_.next(frame)) return false;
    frame.time = start_ + place_++ / 16.0;
    return true;
  }

 private:
  FrameSource& frames_;
  double start_;
  int place_ = 0;
};

std::vector<std::uint64_t> work_from(double start, const std::string& scene_name, const std::string& method) {
  GenerateOptions options{.count = 200, .frames = 24};
  options.blocks = 6, options.viewers = 3, options.range = 80.0;
  const auto generator = make_generator(scene_name, options);
  const Scene& scene = generator->scene();
  Shifted frames(*generator, start);
  const auto culler = find_method(method).make({scene.dimension, *scene.bounds, *scene.cell, "off", 1});
  Replay replay(*culler, scene, &frames);
  std::vector<std::uint64_t> work;
  while (replay.step()) {
    for (const Answer& a : replay.answers().views) {
      for (const std::uint64_t count : {a.work.cells_visited, a.work.cells_hidden, a.work.object_tests,
                                        a.work.occluders, a.work.rasters, std::uint64_t{a.visible.size()}}) {
        work.push_back(count);
      }
    }
  }
  return work;
}

}  // namespace

TEST_CASE("what a frame costs does not depend on when time began") {
  for (const std::string scene : {"spheres", "city", "town"}) {
    for (const std::string method : {"silhouette", "voxel"}) {
      CAPTURE(scene);
      CAPTURE(method);
      const std::vector<std::uint64_t> work = work_from(0.0, scene, method);
      CHECK(!work.empty());
      CHECK(work_from(1.7e9, scene, method) == work);
      CHECK(work_from(-1e6, scene, method) == work);
    }
  }
}

}  // namespace gridcull::test
