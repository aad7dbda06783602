// Hundreds of viewers in one query: the same answers, work and reads at any number of threads, the same answers pushed
// and pulled, and the same as when each viewer is asked for alone. Small enough to run under the thread sanitizer
// (preset tsan).
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/hash.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/sim/random.h"

namespace gridcull::test {
namespace {

constexpr double side = 96.0;           // metres
constexpr double step_seconds = 0.25;   // a frame
constexpr double greatest_speed = 6.0;  // metres a second
constexpr std::uint32_t houses = 60, movers = 160, viewers = 240;
constexpr int frames = 7;
constexpr int few_frames = 2;  // of methods without volumes: nothing builds up

/// Streets of houses with movers between them, half of the viewers riding on movers.
class Quarter final : public PositionSource {
 public:
  explicit Quarter(int dimension) : dimension_(dimension) {
    for (ObjectId id = 0; id < houses; ++id) {
      Object house;
      house.id = id;
      const Vec2 middle = 12.0 * Vec2(id % 8, id / 8) + Vec2(6.0);
      const double height = dice_.uniform(6, 20), length = dice_.uniform(5, 9);
      if (dimension == 2) {
        house.shape = Rectangle{{length, 8}};
      } else {
        house.shape = Cuboid{{length, 8, height}};
      }
      house.pose.position = {middle, dimension == 3 ? 0.5 * height : 0.0};
      house.is_static = true;
      objects.push_back(house);
    }
    for (std::uint32_t i = 0; i < movers; ++i) objects.push_back(mover(houses + i));
    reads_.assign(objects.size(), 0);
  }

  Pose pose(ObjectId object) override {
    ++reads_[object];
    return objects[object].pose;
  }

  /// Moves everybody; some jump in the middle of the run and are listed in `jumped`.
  void step(int frame) {
    jumped.clear();
    std::fill(reads_.begin(), reads_.end(), 0);
    for (std::uint32_t i = 0; i < movers; ++i) {
      Object& object = objects[houses + i];
      Vec3& p = object.pose.position;
      if (frame == 4 && i % 50 == 7) {
        p = place(p.z);
        jumped.push_back(object.id);
        continue;
      }
      const double most = 0.7 * greatest_speed * step_seconds;
      p.x += dice_.uniform(-most, most);  // some leave the bounds
      p.y += dice_.uniform(-most, most);
      object.pose.orientation = turn_about_z(dice_.uniform(-3, 3));
    }
  }

  /// Where movers are, every second riding, and beside some: close enough together to reveal the same volumes.
  std::vector<View> views() const {
    std::vector<View> out;
    for (ViewerId v = 0; v < viewers; ++v) {
      const Object& carrier = objects[houses + v % movers];
      View view;
      view.viewer = v;
      view.pose = carrier.pose;
      view.range = 40.0;
      if (v % 2 == 0) view.rides = carrier.id;
      if (v % 3 == 0 && dimension_ == 2) view.fov = 2.0;
      if (v % 3 == 0 && dimension_ == 3) view.frustum = Frustum{1.0, 1.5, 0.1, 60.0};
      if (v >= movers) view.pose.position.x += 1.5;
      out.push_back(view);
    }
    return out;
  }

  MethodOptions options() const {
    MethodOptions o;
    o.dimension = dimension_;
    o.bounds = {{0, 0, 0}, {side, side, dimension_ == 3 ? 24.0 : 0.0}};
    o.cell = dimension_ == 3 ? 3.0 : 2.0;
    return o;
  }

  int most_reads() const { return *std::max_element(reads_.begin(), reads_.end()); }

  std::vector<Object> objects;  // by id
  std::vector<ObjectId> jumped;

 private:
  Vec3 place(double z) { return {dice_.uniform(0, side), dice_.uniform(0, side), z}; }

  Object mover(ObjectId id) {
    Object out;
    out.id = id;
    if (dimension_ == 2) {
      out.shape = id % 2 == 0 ? Shape(Disc{0.6}) : Shape(Rectangle{{4, 1.6}});
    } else {
      out.shape = id % 2 == 0 ? Shape(Sphere{0.6}) : Shape(Cuboid{{4, 1.6, 1.5}});
    }
    out.pose.position = place(dimension_ == 3 ? 1.0 : 0.0);
    out.max_speed = greatest_speed;
    return out;
  }

  int dimension_;
  Random dice_{17};
  std::vector<int> reads_;  // in this frame
};

struct Outcome {
  std::uint64_t answers = 0, work = 0;  // hashes
  std::uint64_t shared = 0;             ///< reveals of a volume that another viewer revealed in the same frame
  std::uint64_t reported = 0;

  bool operator==(const Outcome&) const = default;
};

void add_work(const Answers& answers, StableHash& hash) {
  const auto add = [&](std::uint64_t n) { hash.add(static_cast<std::uint32_t>(n)); };
  for (const Answer& a : answers.views) {
    const WorkCounts& w = a.work;
    for (const std::uint64_t n :
         {w.cells_visited, w.cells_hidden, w.object_tests, w.occluders, w.rasters, w.tbv_tests, w.tbv_revealed}) {
      add(n);
    }
  }
  const FrameStats& s = answers.stats;
  for (const std::uint64_t n : {s.positions_read, s.tbv_active, s.tbv_revealed, s.tbv_expired, s.jumps}) add(n);
}

enum class Feed { push, pull };

void feed_frame(const Quarter& quarter, Culler& culler, Feed feed) {
  if (feed == Feed::pull) {
    for (const ObjectId id : quarter.jumped) culler.announce_jump(id);
    return;
  }
  for (const Object& object : quarter.objects) {
    if (!object.is_static) culler.move(object.id, object.pose);
  }
}

bool has_volumes(const MethodEntry& method) { return method.options.find("--tbv") != std::string_view::npos; }

/// Plays the quarter. In every other frame a few look only, so that many are hidden and then revealed at once.
Outcome play(const MethodEntry& method, int dimension, const char* tbv, int threads, Feed feed) {
  Quarter quarter(dimension);
  MethodOptions options = quarter.options();
  options.tbv = tbv;
  options.threads = threads;
  const auto culler = method.make(options);
  for (const Object& object : quarter.objects) culler->add(object);
  if (feed == Feed::pull) culler->set_source(&quarter);
  Outcome out;
  StableHash answers_hash, work_hash;
  Answers answers;
  const int length = has_volumes(method) ? frames : few_frames;
  for (int frame = 0; frame < length; ++frame) {
    if (frame > 0) quarter.step(frame), feed_frame(quarter, *culler, feed);
    std::vector<View> views = quarter.views();
    if (frame % 2 == 1) views.resize(3);
    culler->query(frame * step_seconds, views, answers);
    std::uint64_t reveals = 0;
    for (const Answer& a : answers.views) {
      answers_hash.add(a);
      reveals += a.work.tbv_revealed;
      out.reported += a.visible.size();
    }
    out.shared += reveals - answers.stats.tbv_revealed;
    add_work(answers, work_hash);
    CHECK(quarter.most_reads() <= 1);
  }
  out.answers = answers_hash.value();
  out.work = work_hash.value();
  return out;
}

template <class F>
void for_each_conservative(F&& f) {
  for (const MethodEntry& method : method_catalog()) {
    if (method.info.guarantee != Guarantee::conservative) continue;
    CAPTURE(std::string(method.info.name));
    for (const int dimension : {2, 3}) {
      if (!(dimension == 2 ? method.info.takes_2d : method.info.takes_3d)) continue;
      CAPTURE(dimension);
      f(method, dimension);
    }
  }
}

}  // namespace

TEST_CASE("many viewers: the same answers at 1, 2 and 4 threads, pushed and pulled") {
  for_each_conservative([](const MethodEntry& method, int dimension) {
    for (const char* tbv : {"off", "solid", "hollow"}) {
      if (!has_volumes(method) && tbv != std::string("off")) continue;
      CAPTURE(std::string(tbv));
      const Outcome pushed = play(method, dimension, tbv, 1, Feed::push);
      const Outcome pulled = play(method, dimension, tbv, 1, Feed::pull);
      // How much work it is may depend on the feed (positions of hidden objects are older when pulled).
      CHECK(pulled.answers == pushed.answers);
      if (tbv != std::string("off")) CHECK(pushed.shared > 50);
      for (const int threads : {2, 4}) {
        CAPTURE(threads);
        CHECK(play(method, dimension, tbv, threads, Feed::push) == pushed);
        CHECK(play(method, dimension, tbv, threads, Feed::pull) == pulled);
      }
    }
  });
}

TEST_CASE("many viewers: nobody's answer depends on who else asks") {
  for_each_conservative([](const MethodEntry& method, int dimension) {
    Quarter quarter(dimension);
    MethodOptions options = quarter.options();
    options.tbv = "off";
    options.threads = 4;
    const auto crowd = method.make(options);
    options.threads = 1;
    const auto lonely = method.make(options);
    for (const Object& object : quarter.objects) crowd->add(object), lonely->add(object);
    Answers all, alone;
    const std::vector<View> views = quarter.views();
    crowd->query(0.0, views, all);
    for (std::size_t i = 0; i < views.size(); ++i) {
      CAPTURE(i);
      lonely->query(static_cast<double>(i), {&views[i], 1}, alone);
      CHECK(alone.views.at(0).visible == all.views.at(i).visible);
    }
  });
}

}  // namespace gridcull::test
