// Method `silhouette` in 3D moves balls along as they are pushed, and judges jumps by one number for all: against an
// engine that is made anew for each frame, and against the rule for jumps as it is written.
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include "engine_probe.h"
#include "gridcull/grid/engine.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

constexpr double seconds = 0.1, greatest_speed = 20.0;

GridOptions options(TbvMode tbv) {
  return {.dimension = 3, .bounds = {{0, 0, 0}, {90, 90, 30}}, .cell = 1.0, .tbv = tbv, .hiding = Hiding::silhouette};
}

/// A world that changes in every way there is between frames.
class Restless {
 public:
  Restless(std::uint64_t seed, TbvMode tbv) : random_(seed), tbv_(tbv), engine_(options(tbv)) {
    for (ObjectId id = 0; id < 70; ++id) add(id);
  }

  void frame() {
    for (int i = 0; i < 60; ++i) change(static_cast<ObjectId>(random_.below(70)));
    if (random_.below(4) == 0) switch_source();
    std::uint64_t jumped_now = 0;
    for (const auto& [id, from] : pushed_) jumped_now += jumped(objects_.at(id), from);
    pushed_.clear();
    now_ += seconds;
    std::vector<View> views{make_view(1, spot()), make_view(2, spot())};
    views[1].frustum.emplace();
    Answers answers, expected;
    engine_.query(now_, views, answers);
    GridEngine fresh(options(TbvMode::off));
    for (const auto& [id, object] : objects_) fresh.add(object);
    fresh.query(now_, views, expected);
    for (std::size_t i = 0; i < views.size(); ++i) CHECK(answers.views[i].visible == expected.views[i].visible);
    CHECK(answers.stats.jumps == jumped_now);
    if (tbv_ == TbvMode::off || (tbv_ == TbvMode::automatic && !pulling_)) CHECK(answers.stats.tbv_active == 0);
    if (tbv_ != TbvMode::automatic && !pulling_) moving_read(answers.stats);
    volumes += answers.stats.tbv_active;
    jumps += jumped_now;
    fresh_ = false;
    added_.clear();
  }

  std::uint64_t volumes = 0, jumps = 0;

 private:
  void add(ObjectId id) {
    const bool is_static = id % 5 == 0;
    const Shape box = Cuboid{id % 10 == 0 ? Vec3(2, 50, 40) : Vec3(4, 2, 3)};  // walls, for somebody to be hidden
    const Shape ball = Sphere{random_.uniform(0.3, 3.0)};
    Object o = make_object(id, id % 2 == 1 ? ball : box, spot());
    if (id % 7 != 0) o.max_speed = id % 11 == 0 ? 0.0 : greatest_speed;
    o.is_static = is_static;
    engine_.add(o);
    objects_.insert_or_assign(id, o);
    added_[id] = true;
    source_.poses[id] = o.pose;
  }

  Vec3 spot() {
    // Sometimes beyond the lattice.
    return {random_.uniform(-5, 95), random_.uniform(-5, 95), random_.uniform(-2, 32)};
  }

  void change(ObjectId id) {
    Object& object = objects_.at(id);
    if (random_.below(20) == 0) {
      engine_.remove(id);
      pushed_.erase(id);
      return add(id);
    }
    if (pulling_ && !object.is_static) return;
    const Vec3 from = object.pose.position;
    if (random_.below(10) == 0) {
      object.pose.position = spot();
    } else {
      const double reach = 1.2 * greatest_speed * seconds;
      object.pose.position += reach * random_.uniform(0, 1) * glm::normalize(Vec3(random_.uniform(-1, 1), 0.3, 0.1));
    }
    object.pose.orientation = turn_about_z(random_.uniform(-3, 3));
    source_.poses[id] = object.pose;
    engine_.move(id, object.pose);
    if (!object.is_static && object.max_speed && !fresh_ && !added_.contains(id)) pushed_.try_emplace(id, from);
  }

  static bool jumped(const Object& o, const Vec3& from) {
    return glm::length(o.pose.position - from) > *o.max_speed * seconds * (1.0 + 1e-6);
  }

  void switch_source() {
    pulling_ = !pulling_;
    engine_.set_source(pulling_ ? &source_ : nullptr);
  }

  void moving_read(const FrameStats& stats) const {
    std::uint64_t moving = 0;
    for (const auto& [id, o] : objects_) moving += !o.is_static;
    if (tbv_ == TbvMode::off) CHECK(stats.positions_read == moving);
    CHECK(stats.positions_read <= moving);
  }

  Random random_;
  TbvMode tbv_;
  GridEngine engine_;
  ProbedWorld source_;
  std::map<ObjectId, Object> objects_;
  std::map<ObjectId, Vec3> pushed_;
  std::map<ObjectId, bool> added_;
  double now_ = 0.0;
  bool pulling_ = false, fresh_ = true;
};

}  // namespace

TEST_CASE("pushed moves are followed as if the world were made anew, and jumps are counted one by one") {
  for (const TbvMode tbv : {TbvMode::off, TbvMode::solid, TbvMode::automatic}) {
    std::uint64_t volumes = 0, jumps = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      CAPTURE(seed);
      CAPTURE(static_cast<int>(tbv));
      Restless world(seed, tbv);
      for (int frame = 0; frame < 25; ++frame) {
        CAPTURE(frame);
        world.frame();
      }
      volumes += world.volumes;
      jumps += world.jumps;
    }
    CHECK((volumes > 0) == (tbv != TbvMode::off));
    CHECK(jumps > 1000);
  }
}

}  // namespace gridcull::test
