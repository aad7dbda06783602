// What options ask for is held against the memory allowed before it is made, and what is asked for is what is taken.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/coverage_mask.h"
#include "gridcull/grid/engine.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/methods/extended_projections.h"
#include "gridcull/methods/extended_visibility.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

/// The line with which a method is refused for its memory; "" when it is made.
std::string refusal(const char* method, const MethodOptions& options) {
  try {
    (void)make_method(method, options);
  } catch (const Error& e) {
    CHECK(e.code() == ErrorCode::limit);
    return e.what();
  }
  return "";
}

MethodOptions small_world() {
  MethodOptions options;
  options.dimension = 3;
  options.bounds = {Vec3(0.0), Vec3(40.0)};
  options.cell = 4.0;
  return options;
}

/// Walls and things between them, and a viewer in each of many cells.
void fill(Culler& culler, std::vector<View>& views) {
  Random random(11);
  for (ObjectId id = 0; id < 60; ++id) {
    Object object;
    object.id = id;
    object.is_static = id < 40;
    object.shape = Cuboid{Vec3(random.uniform(0.5, 6.0), random.uniform(0.5, 6.0), random.uniform(0.5, 12.0))};
    object.pose.position = {random.uniform(0.0, 40.0), random.uniform(0.0, 40.0), random.uniform(0.0, 20.0)};
    culler.add(object);
  }
  for (ViewerId v = 0; v < 30; ++v) {
    View view;
    view.viewer = v;
    view.pose.position = {random.uniform(0.0, 40.0), random.uniform(0.0, 40.0), random.uniform(0.0, 40.0)};
    views.push_back(view);
  }
}

std::vector<std::vector<ObjectId>> answers_of(const ExtendedOptions& options) {
  const auto culler = make_extended_projections(options);
  std::vector<View> views;
  fill(*culler, views);
  std::vector<std::vector<ObjectId>> out;
  for (int frame = 0; frame < 3; ++frame) {
    Answers answers;
    culler->query(frame, views, answers);
    for (const Answer& answer : answers.views) out.push_back(answer.visible);
    for (View& view : views) view.pose.position.x += 1.5;
  }
  return out;
}

}  // namespace

TEST_CASE("a mask takes what it says at most") {
  View view;
  const ViewVolume volume(view, 3);
  for (const int resolution : {8, 64, 72, 200, 512, 1024}) {
    CAPTURE(resolution);
    CoverageMask mask(choose_instruction_set());
    mask.begin(volume, resolution);
    CHECK(mask.faces() == 6);
    CHECK(mask.bytes() <= CoverageMask::bytes_for(resolution) + sizeof(mask));
    CHECK(2 * mask.bytes() > CoverageMask::bytes_for(resolution));
  }
  CHECK(CoverageMask::bytes_for(8192) >= 6ull * 8192 * 8192 / 8);
}

TEST_CASE("what is too large is refused before it is made, and says what would fit") {
  MethodOptions options = small_world();
  options.resolution = 8192;
  CHECK(refusal("silhouette", options).empty());
  options.max_memory = 40'000'000;
  CHECK(refusal("silhouette", options).ends_with("; 4096 would fit"));
  options.resolution = 4096;
  CHECK(refusal("silhouette", options).empty());
  options.threads = 4;
  CHECK(refusal("silhouette", options).ends_with("; 2048 would fit"));

  options = small_world();
  options.resolution = 8192;
  CHECK(refusal("extended-projections", options).ends_with("; 2048 would fit"));
  options.resolution = 2048;
  CHECK(refusal("extended-projections", options).empty());
}

TEST_CASE("little memory for maps changes no answer") {
  ExtendedOptions options{.bounds = {Vec3(0.0), Vec3(40.0)}, .cell = 4.0, .resolution = 64};
  const auto plenty = answers_of(options);
  extended::CellSettings settings;
  settings.resolution = options.resolution;
  options.max_memory = 3 * extended::view_bytes(settings) + extended::looker_bytes(settings);
  CHECK(answers_of(options) == plenty);
  --options.max_memory;
  CHECK_THROWS_AS((void)make_extended_projections(options), Error);
}

}  // namespace gridcull::test
