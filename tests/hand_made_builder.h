// A few words to write hand-made scenes with.
#pragma once

#include <numbers>
#include <utility>

#include "hand_made_scenes.h"

namespace gridcull::test {

class SceneBuilder {
 public:
  SceneBuilder(std::string name, int dimension) {
    scene_.name = std::move(name);
    scene_.dimension = dimension;
    scene_.view.viewer = 1;
  }

  SceneBuilder& eye(const Vec3& position, double heading_degrees = 0.0) {
    scene_.view.pose = {position, turn_about_z(radians(heading_degrees))};
    return *this;
  }
  SceneBuilder& range(double metres) { return scene_.view.range = metres, *this; }
  SceneBuilder& fov(double degrees) { return scene_.view.fov = radians(degrees), *this; }
  SceneBuilder& frustum(double fov_y_degrees, double aspect, double near, double far) {
    scene_.view.frustum = Frustum{radians(fov_y_degrees), aspect, near, far};
    return *this;
  }
  SceneBuilder& rides(ObjectId id) { return scene_.view.rides = id, *this; }

  SceneBuilder& object(ObjectId id, Shape shape, const Vec3& position = Vec3(0.0), double heading_degrees = 0.0) {
    Object o;
    o.id = id;
    o.shape = std::move(shape);
    o.pose = {position, turn_about_z(radians(heading_degrees))};
    scene_.objects.push_back(std::move(o));
    return *this;
  }
  /// The last object never hides.
  SceneBuilder& clear() { return scene_.objects.back().occluder = false, *this; }

  SceneBuilder& sees(std::vector<ObjectId> ids) { return scene_.sees = std::move(ids), *this; }
  SceneBuilder& hides(std::vector<ObjectId> ids) { return scene_.hides = std::move(ids), *this; }

  operator HandMadeScene() const { return scene_; }

 private:
  static double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

  HandMadeScene scene_;
};

}  // namespace gridcull::test
