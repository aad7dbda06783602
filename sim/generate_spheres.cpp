// Spheres and discs that fly about and are reflected at the walls (DESIGN 9; the paper's own test, Batagelo
// and Wu 2002, section 6, has 5,000 such spheres).
#include <cmath>
#include <numbers>

#include "gridcull/core/trigonometry.h"
#include "gridcull/sim/generate_parts.h"

namespace gridcull {
namespace {

/// Movers with a constant velocity; their centres stay in a box.
class Flight {
 public:
  explicit Flight(const Bounds& box) : box_(box) {}

  /// Gives the object a velocity, uniform in [-2, 2] m/s per axis, and its bound.
  void launch(Object& object, int dimension, Random& random) {
    Vec3 velocity(0.0);
    for (int axis = 0; axis < dimension; ++axis) velocity[axis] = random.uniform(-2.0, 2.0);
    object.max_speed = speed_bound(glm::length(velocity));
    ids_.push_back(object.id);
    places_.push_back(object.pose.position);
    velocities_.push_back(velocity);
  }
  void advance(int dimension, double seconds, Frame& out) {
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      for (int axis = 0; axis < dimension; ++axis) {
        bounce(places_[i][axis], velocities_[i][axis], seconds, box_.min[axis], box_.max[axis]);
      }
      ObjectMove& move = out.set.emplace_back();
      move.id = ids_[i];
      move.position = places_[i];
    }
  }
  const std::vector<ObjectId>& ids() const { return ids_; }

 private:
  Bounds box_;
  std::vector<ObjectId> ids_{};
  std::vector<Vec3> places_{}, velocities_{};
};

/// 40 clusters of spheres in 100 x 100 x 60 m, z up.
class Spheres final : public GeneratedWorld {
 public:
  explicit Spheres(const GenerateOptions& options) : GeneratedWorld(options, 140) {
    scene_.dimension = 3;
    scene_.bounds = Bounds{Vec3(0.0), {100.0, 100.0, 60.0}};
    scene_.cell = options.cell.value_or(2.0);
    std::vector<Vec3> clusters;
    for (int i = 0; i < 40; ++i) {
      const double x = random_.uniform(8.0, 92.0), y = random_.uniform(8.0, 92.0);
      clusters.push_back({x, y, random_.uniform(8.0, 52.0)});
    }
    for (std::uint32_t i = 0; i < options.count.value_or(5000); ++i) {
      Vec3 place = clusters[random_.below(40)];
      for (int axis = 0; axis < 3; ++axis) {
        place[axis] = std::clamp(place[axis] + 5.0 * random_.normal(), box.min[axis], box.max[axis]);
      }
      flight_.launch(add(Sphere{random_.uniform(0.5, 3.5)}, place), 3, random_);
    }
    if (options.viewers)
      ride(flight_.ids(), *options.viewers);
    else
      camera(0, eye(0));
  }

 private:
  void advance(Frame& out) override { flight_.advance(3, 1.0 / frames_a_second, out); }
  void look(std::uint64_t frame, Frame& out) override {
    if (options_.viewers) return;
    ViewerUpdate& viewer = out.viewers.emplace_back();
    const Pose pose = eye(frame);
    viewer.id = 0;
    viewer.position = pose.position;
    viewer.orientation = pose.orientation;
  }
  /// On the circle of radius 45 about the middle, once round in 140 frames, at 30 + 10 sin 2t, looking at
  /// the middle.
  static Pose eye(std::uint64_t frame) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(frame % 140) / 140.0;
    const SinCos a = stable_sincos(t);
    const Vec3 out{45.0 * a.cos, 45.0 * a.sin, 10.0 * stable_sincos(2.0 * t).sin};
    return {Vec3(50.0, 50.0, 30.0) + out, look_along(-out)};
  }

  inline static const Bounds box{Vec3(4.0), {96.0, 96.0, 56.0}};
  Flight flight_{box};
};

/// Discs in 256 x 256 m.
class Discs final : public GeneratedWorld {
 public:
  explicit Discs(const GenerateOptions& options) : GeneratedWorld(options, 100) {
    scene_.dimension = 2;
    scene_.bounds = Bounds{Vec3(0.0), {256.0, 256.0, 0.0}};
    const std::uint32_t count = options.count.value_or(300);
    // Few are large (1 .. 6 m), many are small (0.5 .. 1.5 m).
    const bool few = count <= 1000;
    scene_.cell = options.cell.value_or(few ? 1.0 : 0.5);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double radius = few ? random_.uniform(1.0, 6.0) : random_.uniform(0.5, 1.5);
      const double x = random_.uniform(6.0, 250.0);
      flight_.launch(add(Disc{radius}, {x, random_.uniform(6.0, 250.0), 0.0}), 2, random_);
    }
    if (options.viewers)
      ride(flight_.ids(), *options.viewers);
    else
      camera(0, Pose{{128.0, 128.0, 0.0}, {}});
  }

 private:
  void advance(Frame& out) override { flight_.advance(2, 1.0 / frames_a_second, out); }

  Flight flight_{Bounds{{6.0, 6.0, 0.0}, {250.0, 250.0, 0.0}}};
};

}  // namespace

std::unique_ptr<Generator> make_spheres(const GenerateOptions& options) { return std::make_unique<Spheres>(options); }
std::unique_ptr<Generator> make_discs(const GenerateOptions& options) { return std::make_unique<Discs>(options); }

}  // namespace gridcull
