#include "random_world.h"

#include "random_scenery.h"

namespace gridcull::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Makes the frames: keeps what is where, so that moves keep their max_speed unless they jump.
class Story {
 public:
  Story(int dimension, std::uint64_t seed) : random_(seed), scenery_(dimension, random_) {
    script_.dimension = dimension;
    script_.bounds = scenery_.bounds();
    script_.cell = scenery_.cell();
    static constexpr const char* modes[] = {"off", "solid", "solid", "hollow", "hollow"};
    script_.tbv = modes[random_.below(5)];
    busy_ = random_.uniform(0.1, 1.0);
    jumpy_ = random_.below(3) == 0 ? 0.15 : 0.02;
    choose_times();
  }

  WorldScript tell() {
    const std::uint32_t count = 2 + random_.below(script_.dimension == 2 ? 22 : 18);
    for (std::uint32_t i = 0; i < count; ++i) add_object(script_.objects);
    if (chance(script_.dimension == 2 ? 0.3 : 0.5)) {
      for (Object& wall : scenery_.room()) {
        wall.id = new_id();
        script_.objects.push_back(wall);
        objects_.push_back(std::move(wall));
      }
    }
    const std::uint32_t viewers = 1 + random_.below(script_.dimension == 2 ? 4 : 3);
    for (std::uint32_t i = 0; i < viewers; ++i) views_.push_back(scenery_.view(next_viewer_++, objects_));
    const std::uint32_t frames = script_.dimension == 2 ? 3 + random_.below(6) : 3 + random_.below(4);
    for (std::uint32_t f = 0; f < frames; ++f) {
      ScriptFrame frame;
      frame.time = time_;
      if (f > 0) change(frame);
      ask(frame);
      script_.frames.push_back(std::move(frame));
      const double now = time_;
      for (double step = next_step(); !(time_ > now); step *= 2.0) time_ = now + step;
      step_ = time_ - now;  // as it was rounded
    }
    return std::move(script_);
  }

 private:
  bool chance(double p) { return random_.unit() < p; }

  void choose_times() {
    static constexpr double starts[] = {0.0, 0.0, -3.0, 12.5, 1e6, -1e3, 1.7e9};
    static constexpr double steps[] = {0.1, 1.0, 1.0 / 30.0, 0.25, 1e-6, 1e-9};
    time_ = starts[random_.below(7)];
    usual_step_ = steps[random_.below(6)];
    uneven_ = chance(0.3);
    step_ = usual_step_;
  }

  double next_step() {
    if (!uneven_) return usual_step_;
    // Now and then a pause that lets every volume expire.
    if (chance(0.1)) return chance(0.2) ? 1e8 : 100.0 * usual_step_;
    return usual_step_ * random_.uniform(0.05, 3.0);
  }

  void add_object(std::vector<Object>& out) {
    Object o = scenery_.object(objects_, usual_step_);
    o.id = new_id();
    out.push_back(o);
    objects_.push_back(std::move(o));
  }

  /// Ids are anything, also those of objects that are gone.
  ObjectId new_id() {
    for (;;) {
      ObjectId id = random_.below(8) == 0 ? no_id - 1 - random_.below(3) : random_.below(60);
      if (!gone_.empty() && chance(0.3)) id = gone_[random_.below(static_cast<std::uint32_t>(gone_.size()))];
      bool taken = false;
      for (const Object& o : objects_) taken = taken || o.id == id;
      if (!taken) return id;
    }
  }

  void change(ScriptFrame& frame) {
    if (chance(0.25) && !objects_.empty()) {
      const std::uint32_t victim = random_.below(static_cast<std::uint32_t>(objects_.size()));
      frame.remove.push_back(objects_[victim].id);
      gone_.push_back(objects_[victim].id);
      objects_.erase(objects_.begin() + victim);
    }
    if (chance(0.25)) add_object(frame.add);
    for (Object& o : objects_) {
      if (!chance(o.is_static ? 0.02 : busy_)) continue;
      move(o);
      frame.moves.push_back({o.id, o.pose});
    }
    change_views();
  }

  void move(Object& o) {
    if (chance(0.5)) o.pose.orientation = scenery_.orientation();
    if (o.is_static || !o.max_speed || chance(jumpy_)) {
      o.pose.position = scenery_.place();
      return;
    }
    // Up to the very limit, along an axis or any way.
    const double most = *o.max_speed * step_;
    const double far = chance(0.4) ? most : most * random_.unit();
    const Vec3 target = o.pose.position + std::min(far, 1e6) * scenery_.direction();
    if (std::max({std::fabs(target.x), std::fabs(target.y), std::fabs(target.z)}) < 1e8) o.pose.position = target;
  }

  void change_views() {
    for (View& view : views_) {
      if (chance(0.12)) {
        view = scenery_.view(view.viewer, objects_);  // jumps, looks elsewhere
      } else if (chance(0.6)) {
        const double far = scenery_.cell() * random_.unit();
        view.pose.position += far * scenery_.direction();
        if (chance(0.3)) view.pose.orientation = scenery_.orientation();
      }
    }
    if (chance(0.1)) views_.push_back(scenery_.view(next_viewer_++, objects_));
    if (chance(0.05) && !views_.empty()) views_.erase(views_.begin());
  }

  void ask(ScriptFrame& frame) {
    for (View& view : views_) {
      if (view.rides != no_id) {
        for (const Object& o : objects_) {
          if (o.id == view.rides) view.pose = o.pose;
        }
      }
      if (!chance(0.1)) frame.views.push_back(view);  // else dropped for a frame
    }
  }

  Random random_;
  Scenery scenery_;
  WorldScript script_;
  std::vector<Object> objects_;
  std::vector<View> views_;
  std::vector<ObjectId> gone_;
  ViewerId next_viewer_ = 0;
  double time_ = 0.0, step_ = 0.1, usual_step_ = 0.1, busy_ = 0.5, jumpy_ = 0.02;
  bool uneven_ = false;
};

}  // namespace

WorldScript random_world(int dimension, std::uint64_t seed) {
  return Story(dimension, seed * 2 + static_cast<std::uint64_t>(dimension == 3)).tell();
}

}  // namespace gridcull::test
