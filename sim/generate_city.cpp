// Streets with buildings and cars: the city in 3D, the town in 2D (DESIGN 9).
#include <cmath>
#include <numbers>

#include "gridcull/sim/generate_parts.h"

namespace gridcull {
namespace {

constexpr double period = 20.0;  // metres from street to street
constexpr double lane_gap = 4.0;

/// Street i occupies [20 i, 20 i + 8] in x or y, block i the 12 m behind it; a last street closes the grid.
class City final : public GeneratedWorld {
 public:
  explicit City(const GenerateOptions& options) : GeneratedWorld(options, 200), blocks_(options.blocks.value_or(50)) {
    scene_.dimension = 3;
    const double side = period * blocks_ + street;
    scene_.cell = options.cell.value_or(1.5);
    // Opaque cells begin a 32nd of a cell above the ground, clear of the buildings' feet, and eyes are in a layer
    // above the lowest opaque one (at 1.5 m: 1.547 m and up). What is hidden reaches down to the ground behind
    // buildings only then: cells are hidden as seen from the middle of the viewer's cell, by middles of opaque ones.
    // One layer more is room for the cars' temporal bounding volumes: one that leaves the lattice is never hidden.
    const double low = -31.0 / 32.0 * *scene_.cell;
    scene_.bounds = Bounds{{low, low, low - *scene_.cell}, {side, side, 40.0}};
    for (std::uint32_t y = 0; y < blocks_; ++y) {
      for (std::uint32_t x = 0; x < blocks_; ++x) build({period * x + street, period * y + street});
    }
    std::vector<ObjectId> ids;
    for (std::uint32_t i = 0; i < options.count.value_or(5000); ++i) ids.push_back(park(side));
    // Eyes of riders are at 1.6 m, as the camera's.
    if (options.viewers)
      ride(ids, *options.viewers, {0.0, 0.0, eye_height - car_z});
    else
      camera(0, eye(0));
  }

 private:
  /// One building of 12 x 12 m, two or four with gaps of 1 m.
  void build(const Vec2& corner) {
    const std::uint32_t kind = random_.below(3);
    const bool split_x = kind == 2 || (kind == 1 && random_.below(2) == 0);
    const bool split_y = kind == 2 || (kind == 1 && !split_x);
    const Vec2 size{split_x ? 5.5 : 12.0, split_y ? 5.5 : 12.0};
    for (int j = 0; j <= (split_y ? 1 : 0); ++j) {
      for (int i = 0; i <= (split_x ? 1 : 0); ++i) {
        const double height = random_.uniform(6.0, 40.0);
        const Vec2 middle = corner + 0.5 * size + Vec2(6.5 * i, 6.5 * j);
        add(Cuboid{{size.x, size.y, height}}, {middle.x, middle.y, 0.5 * height}).is_static = true;
      }
    }
  }
  ObjectId park(double side) {
    const double line = period * random_.below(blocks_ + 1) + 0.5 * street;
    LoopCar car{};
    car.loop.along_x = random_.below(2) == 0;
    car.loop.straight = side - 2.0 * lane_gap;
    car.loop.gap = lane_gap;
    // Cars keep right: out along +x on the lower y, out along +y on the higher x.
    const double first = lane_gap;
    car.loop.start = car.loop.along_x ? Vec2(first, line - 0.5 * lane_gap) : Vec2(line + 0.5 * lane_gap, first);
    car.way = random_.uniform(0.0, car.loop.length());
    car.speed = random_.uniform(5.0, 14.0);
    const LaneLoop::Place place = car.loop.at(car.way);
    Object& object = add(Cuboid{{4.0, 1.6, 1.8}}, Vec3(place.position, car_z));
    object.pose.orientation = turn_about_z(place.heading);
    object.max_speed = speed_bound(car.speed);
    scene_.objects.back().heading = place.heading;
    car.id = object.id;
    cars_.push_back(car);
    return car.id;
  }
  void advance(Frame& out) override { drive(cars_, 1.0 / frames_a_second, car_z, out); }
  void look(std::uint64_t frame, Frame& out) override {
    if (options_.viewers) return;
    const Pose pose = eye(frame);
    ViewerUpdate& viewer = out.viewers.emplace_back();
    viewer.id = 0;
    viewer.position = pose.position;
    viewer.heading = frame % 200 < 100 ? 0.0 : 0.5 * std::numbers::pi;
    viewer.orientation = pose.orientation;
  }
  /// 100 frames at 15 m/s along the middle street towards its middle crossing, then 100 along the crossing
  /// street, in the right lane.
  Pose eye(std::uint64_t frame) const {
    const double crossing = period * (blocks_ / 2) + 0.5 * street;
    const double lane = 0.5 * lane_gap;
    const double step = 15.0 / frames_a_second * static_cast<double>(frame % 100);
    if (frame % 200 < 100) return {{crossing + lane - 50.0 + step, crossing - lane, eye_height}, turn_about_z(0.0)};
    return {{crossing + lane, crossing - lane + step, eye_height}, turn_about_z(0.5 * std::numbers::pi)};
  }

  static constexpr double street = 8.0;
  static constexpr double car_z = 0.9;
  static constexpr double eye_height = 1.6;
  std::uint32_t blocks_;
  std::vector<LoopCar> cars_{};
};

/// Buildings of 10 x 8 m, one in each square of the 20 m pitch, moved by up to 2 m in x and y; streets run
/// along the squares' borders, with at least 6 m between facing buildings.
class Town final : public GeneratedWorld {
 public:
  explicit Town(const GenerateOptions& options) : GeneratedWorld(options, 300) {
    const std::uint32_t count = options.count.value_or(400);
    while (side_ * side_ < count) ++side_;
    const double edge = period * side_;
    scene_.dimension = 2;
    scene_.bounds = Bounds{{-margin, -margin, 0.0}, {edge + margin, edge + margin, 0.0}};
    scene_.cell = options.cell.value_or(2.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double x = period * (i % side_) + 10.0 + random_.uniform(-2.0, 2.0);
      const double y = period * (i / side_) + 10.0 + random_.uniform(-2.0, 2.0);
      add(Rectangle{{10.0, 8.0}}, {x, y, 0.0}).is_static = true;
    }
    std::vector<ObjectId> ids;
    for (std::uint32_t i = 0; i < (count + 3) / 4; ++i) ids.push_back(park(edge));
    ride(ids, options.viewers.value_or(10));
  }

 private:
  ObjectId park(double edge) {
    const double line = period * random_.below(side_ + 1);
    LoopCar car{};
    car.loop.along_x = random_.below(2) == 0;
    car.loop.straight = edge;
    car.loop.gap = gap;
    car.loop.start = car.loop.along_x ? Vec2(0.0, line - 0.5 * gap) : Vec2(line + 0.5 * gap, 0.0);
    car.way = random_.uniform(0.0, car.loop.length());
    car.speed = random_.uniform(5.0, 14.0);
    const LaneLoop::Place place = car.loop.at(car.way);
    Object& object = add(Rectangle{{4.5, 1.8}}, Vec3(place.position, 0.0));
    object.pose.orientation = turn_about_z(place.heading);
    object.max_speed = speed_bound(car.speed);
    scene_.objects.back().heading = place.heading;
    car.id = object.id;
    cars_.push_back(car);
    return car.id;
  }
  void advance(Frame& out) override { drive(cars_, 1.0 / frames_a_second, 0.0, out); }

  static constexpr double gap = 2.6;     // between the lanes' middles
  static constexpr double margin = 6.0;  // for turning cars
  std::uint32_t side_ = 1;
  std::vector<LoopCar> cars_{};
};

}  // namespace

std::unique_ptr<Generator> make_city(const GenerateOptions& options) { return std::make_unique<City>(options); }
std::unique_ptr<Generator> make_town(const GenerateOptions& options) { return std::make_unique<Town>(options); }

}  // namespace gridcull
