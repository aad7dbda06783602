// Extended projections from random cells: whoever is hidden from a cell is hidden from each of its points. Held against
// rays in doubles from random viewpoints to random points of each hidden object, and against the exact reference.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <doctest/doctest.h>

#include "extended_world.h"
#include "gridcull/core/exact.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/methods/extended_visibility.h"
#include "gridcull/methods/local_shape.h"

namespace gridcull::test {
namespace {

using extended::CellLooker;
using extended::CellView;

/// Blocks as the contract says, by an implementation of its own.
class Blockers {
 public:
  explicit Blockers(const std::vector<Object>& objects) : objects_(objects) {
    for (const Object& o : objects) {
      shapes_.push_back(make_local_shape(o.shape));
      turns_.push_back(rotation_of(o.pose.orientation));
    }
  }
  /// Whether some occluder other than `target`, and not around `from`, blocks the segment.
  bool block(const Vec3& from, const Vec3& to, std::size_t target) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const Object& o = objects_[i];
      if (i == target || !o.occluder) continue;
      const Vec3 at = turns_[i].inverse(from - o.pose.position), along = turns_[i].inverse(to - from);
      if (blocks_segment(shapes_[i], at, along, scratch_) && !interior_holds(o.shape, o.pose, from)) return true;
    }
    return false;
  }

 private:
  const std::vector<Object>& objects_;
  std::vector<LocalShape> shapes_{};
  std::vector<Rotation> turns_{};
  std::vector<double> scratch_{};
};

/// A point of an occludee of these worlds: a box or a ball.
Vec3 random_point(const Object& o, Random& random) {
  Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  if (const auto* box = std::get_if<Cuboid>(&o.shape)) {
    return to_world(o.pose, rotation_of(o.pose.orientation), 0.5 * p * box->size);
  }
  if (glm::length(p) > 1.0) p = glm::normalize(p);
  return o.pose.position + std::get<Sphere>(o.shape).radius * p;
}

bool is_plain(const Object& o) {
  return std::holds_alternative<Cuboid>(o.shape) || std::holds_alternative<Sphere>(o.shape);
}

struct Looked {
  extended::StaticScene scene;
  CellView view;

  std::vector<std::size_t> hidden() const {  // ids are places
    std::vector<std::size_t> out;
    for (std::uint32_t i = 0; i < scene.occludees.size(); ++i) {
      if (!std::binary_search(view.visible.begin(), view.visible.end(), i)) out.push_back(i);
    }
    return out;
  }
};

std::unique_ptr<Looked> look(const ExtendedWorld& world, int resolution) {
  auto out = std::make_unique<Looked>();
  out->scene = extended::make_static_scene(world.pointers(), extended::least_angle(resolution));
  extended::CellSettings settings;
  settings.resolution = resolution;
  CellLooker looker(out->scene, settings);
  const double lowest = world.cell.centre.z - world.cell.half.z;
  const bool above = world.cell.axes.z == Vec3(0, 0, 1) && lowest >= out->scene.floor.height;
  looker.look(world.cell, above, no_id, nullptr, out->view);
  return out;
}

/// Whether a touching occluder's interior holds the viewpoint: by rounding at most, and these viewpoints lie deeper.
bool is_held(const ExtendedWorld& world, const CellView& view, const Vec3& eye) {
  return std::any_of(view.touching.begin(), view.touching.end(),
                     [&](ObjectId id) { return interior_holds(world.objects[id].shape, world.objects[id].pose, eye); });
}

}  // namespace

TEST_CASE("who is hidden from a cell is hidden from its points: rays in doubles") {
  std::uint64_t hidden = 0, all = 0, floors = 0;
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    CAPTURE(seed);
    const ExtendedWorld world = random_extended_world(seed);
    const auto looked = look(world, 64);
    Blockers blockers(world.objects);
    Random random(seed);
    all += world.objects.size();
    floors += std::isfinite(looked->view.outlooks.floor);
    for (const std::size_t i : looked->hidden()) {
      ++hidden;
      if (!is_plain(world.objects[i])) continue;
      for (int ray = 0; ray < 40; ++ray) {
        const Vec3 eye = random_viewpoint(world.cell, random), at = random_point(world.objects[i], random);
        if (eye.z < looked->view.outlooks.floor) continue;
        REQUIRE(!is_held(world, looked->view, eye));
        if (!blockers.block(eye, at, i)) {
          CAPTURE(i);
          CAPTURE(eye.x);
          CAPTURE(eye.y);
          CAPTURE(eye.z);
          FAIL("a ray reaches a hidden object");
        }
      }
    }
  }
  CHECK(floors > 50);
  MESSAGE("hidden " << hidden << " of " << all);
  CHECK(hidden > all / 20);
}

TEST_CASE("who is hidden from a cell is not seen by the exact reference from its points") {
  if (!ExactRays::available()) {
    MESSAGE("skipped: built without Embree");
    return;
  }
  std::uint64_t seen = 0;
  for (std::uint64_t seed = 2001; seed <= 2060; ++seed) {
    CAPTURE(seed);
    const ExtendedWorld world = random_extended_world(seed);
    const auto looked = look(world, 128);
    const ExactRays exact(world.objects, 64);
    Random random(seed);
    for (int sample = 0; sample < 6; ++sample) {
      View view;
      view.viewer = 1;
      view.pose.position = random_viewpoint(world.cell, random);
      if (view.pose.position.z < looked->view.outlooks.floor) continue;
      REQUIRE(!is_held(world, looked->view, view.pose.position));
      const ExactAnswer answer = exact.visible(view);
      seen += answer.visible.size();
      for (std::size_t i = 0; i < answer.visible.size(); ++i) {
        const ObjectId id = answer.visible[i];
        if (std::binary_search(looked->view.visible.begin(), looked->view.visible.end(), id)) continue;
        CAPTURE(id);
        CHECK(!exact.confirm(view, id, answer.witness[i]));
      }
    }
  }
  CHECK(seen > 1000);
}

}  // namespace gridcull::test
