// A world for measuring what hidden objects cost: the spheres of DESIGN's scene A around one large solid box
// that is full of small movers nobody can see. Positions are functions of time, so that a pull-mode engine
// pays for the objects that it asks for and for nothing else.
#pragma once

#include <cmath>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/world.h"

namespace gridcull {

class HiddenMovers final : public PositionSource {
 public:
  /// `movers` balls of 0.25 m that go back and forth at 0.5 .. 2 m/s inside the box; `spheres` of scene A.
  HiddenMovers(std::uint32_t spheres, std::uint32_t movers, double cell) : movers_(movers) {
    GenerateOptions options;
    options.count = spheres;
    options.cell = cell;
    generator_ = make_generator("spheres", options);
    world_.emplace(generator_->scene());
    first_mover_ = spheres + 1;
    tracks_.reserve(movers);
    std::uint64_t state = 42;
    const auto uniform = [&](double low, double high) {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      return low + (high - low) * static_cast<double>(state >> 11) * 0x1p-53;
    };
    for (std::uint32_t i = 0; i < movers; ++i) {
      const Vec3 centre(uniform(42, 58), uniform(42, 58), uniform(18, 42));
      Vec3 along(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      along /= std::fmax(0.1, glm::length(along));
      tracks_.push_back({centre, along, uniform(0.5, 2.0), uniform(0.0, 8.0)});
    }
  }

  /// The box takes x, y 24 .. 76 and z 3 .. 57: the movers stay 16 m away from its faces.
  void fill(Culler& culler) const {
    for (const SceneObject& o : generator_->scene().objects) culler.add(o.object);
    Object box;
    box.id = first_mover_ - 1;
    box.shape = Cuboid{{52, 52, 54}};
    box.pose.position = {50, 50, 30};
    box.is_static = true;
    culler.add(box);
    for (std::uint32_t i = 0; i < movers_; ++i) {
      Object mover;
      mover.id = first_mover_ + i;
      mover.shape = Sphere{0.25};
      mover.pose.position = at(tracks_[i]);
      mover.max_speed = tracks_[i].speed * (1.0 + 1e-9);
      culler.add(mover);
    }
  }

  /// Moves the spheres and the camera by one frame; false at the end.
  bool step(std::vector<View>& views, double& time) {
    if (!generator_->next(frame_)) return false;
    world_->apply(frame_);
    world_->views(views);
    time = time_ = frame_.time;
    return true;
  }

  Pose pose(ObjectId id) override {
    if (id >= first_mover_) return {at(tracks_[id - first_mover_]), {}};
    return world_->object(id).pose;
  }

  const Scene& scene() const { return generator_->scene(); }

 private:
  struct Track {
    Vec3 centre, along;
    double speed, phase;
  };
  /// Back and forth over 4 m, a triangle wave.
  Vec3 at(const Track& t) const {
    const double way = t.phase + t.speed * time_;
    const double rest = way - 8.0 * static_cast<double>(static_cast<std::int64_t>(way / 8.0));
    return t.centre + t.along * (std::fabs(rest - 4.0) - 2.0);
  }

  std::uint32_t movers_;
  ObjectId first_mover_ = 0;
  std::unique_ptr<Generator> generator_;
  std::optional<World> world_;
  std::vector<Track> tracks_;
  Frame frame_;
  double time_ = 0.0;
};

}  // namespace gridcull
