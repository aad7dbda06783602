#include "naive_rays_2d.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace gridcull::test {
namespace {

constexpr double close = 1e-9;  // metres

/// A stretch of the ray inside the object, or a single crossing of a wall (begin == end).
struct Stretch {
  double begin, end;
};

/// Signed distances along the ray's whole line at which it crosses the walls.
std::vector<double> crossings(const std::vector<Vec2>& outline, bool closed, const Vec2& eye, const Vec2& ray) {
  std::vector<double> out;
  for (std::size_t i = closed ? 0 : 1; i < outline.size(); ++i) {
    const Vec2 a = outline[(i + outline.size() - 1) % outline.size()] - eye, b = outline[i] - eye;
    const double side_a = cross2(ray, a), side_b = cross2(ray, b);
    if ((side_a > 0) == (side_b > 0)) continue;
    out.push_back((side_a * glm::dot(b, ray) - side_b * glm::dot(a, ray)) / (side_a - side_b));
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Stretch> stretches(const Object& object, const Vec2& eye, const Vec2& ray) {
  std::vector<Stretch> out;
  if (const auto* disc = std::get_if<Disc>(&object.shape)) {
    const Vec2 c = Vec2(object.pose.position) - eye;
    const double square = disc->radius * disc->radius - cross2(ray, c) * cross2(ray, c);
    if (square > 0) out.push_back({glm::dot(c, ray) - std::sqrt(square), glm::dot(c, ray) + std::sqrt(square)});
    return out;
  }
  const bool thin = is_thin(object.shape);
  const std::vector<double> hits = crossings(world_outline(object.shape, object.pose), !thin, eye, ray);
  if (thin) {
    for (const double t : hits) out.push_back({t, t});
  } else {
    for (std::size_t i = 0; i + 1 < hits.size(); i += 2) out.push_back({hits[i], hits[i + 1]});
    // A wall that the ray meets is part of the closed shape, even where the shape has no width behind it.
  }
  return out;
}

struct Along {
  ObjectId id;
  bool contains = false;
  double touch = std::numeric_limits<double>::infinity();
  double entry = std::numeric_limits<double>::infinity();
};

Along look(const Object& object, const Vec2& eye, const Vec2& ray, bool generous) {
  Along along;
  along.id = object.id;
  const bool thin = is_thin(object.shape);
  for (const Stretch& s : stretches(object, eye, ray)) {
    along.contains = along.contains || (s.begin < -close && s.end > close);
    // Ahead of the viewer, or at least about the viewer itself.
    if (generous ? s.end < -close : s.end <= close) continue;
    along.touch = std::min(along.touch, std::max(0.0, s.begin));
    const bool blocks = thin ? s.begin > close : s.end - std::max(0.0, s.begin) > close;
    if (object.occluder && blocks) along.entry = std::min(along.entry, std::max(0.0, s.begin));
  }
  return along;
}

/// Least distance of the eye from the walls. `beside`: it lies within rounding of one, but not exactly on it.
double wall_distance(const Object& object, const Vec2& eye, bool& beside) {
  const std::vector<Vec2> outline = world_outline(object.shape, object.pose);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = is_thin(object.shape) ? 1 : 0; i < outline.size(); ++i) {
    const Vec2 a = outline[(i + outline.size() - 1) % outline.size()] - eye, b = outline[i] - eye;
    const double t = std::clamp(-glm::dot(a, b - a) / std::max(1e-300, glm::dot(b - a, b - a)), 0.0, 1.0);
    const double distance = glm::length(a + t * (b - a));
    beside = beside || (distance < close && cross2(a, b) != 0.0);
    least = std::min(least, distance);
  }
  return least;
}

bool inside_fov(const View& view, const Vec2& ray) {
  if (view.fov >= 2 * std::numbers::pi) return true;
  const double heading = heading_of(view.pose.orientation);
  return std::fabs(std::remainder(std::atan2(ray.y, ray.x) - heading, 2 * std::numbers::pi)) <= 0.5 * view.fov;
}

}  // namespace

std::vector<ObjectId> seen_along(std::span<const Object> world, const View& view, const Vec2& direction,
                                 bool generous) {
  std::vector<Along> all;
  const Vec2 eye(view.pose.position);
  for (const Object& o : world) {
    if (o.id == view.rides) continue;
    all.push_back(look(o, eye, direction, generous));
    bool beside = false;
    if (wall_distance(o, eye, beside) <= close) all.back().contains = false;
    // Beside a thin wall nobody can say on which side: nothing must be seen.
    if (beside && is_thin(o.shape) && o.occluder && !generous) return {};
  }
  std::vector<ObjectId> seen;
  for (const Along& x : all) {
    bool visible = std::isfinite(x.touch) && x.touch <= view.range && inside_fov(view, direction);
    for (const Along& y : all) {
      if (y.id != x.id && !y.contains && y.entry < x.touch - close) visible = false;
    }
    if (visible || x.contains) seen.push_back(x.id);
  }
  std::sort(seen.begin(), seen.end());
  return seen;
}

namespace {

struct Dice {
  std::mt19937_64 random;

  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }
  bool chance(double p) { return real(0, 1) < p; }
  Vec2 point(bool lattice, double size) {
    if (lattice)
      return Vec2(whole(-static_cast<int>(size), static_cast<int>(size)),
                  whole(-static_cast<int>(size), static_cast<int>(size)));
    return Vec2(real(-size, size), real(-size, size));
  }
};

Shape random_shape(Dice& dice, bool lattice) {
  const auto length = [&] { return lattice ? dice.whole(1, 5) : dice.real(0.3, 5); };
  std::vector<Vec2> points;
  const int count = dice.whole(3, 8);
  for (int i = 0; i < count; ++i) points.push_back(dice.point(lattice, 4));
  // Three distinct points at least.
  points.insert(points.end(), {{0, 0}, {1, 0}, {0, 1}});
  switch (dice.whole(0, 4)) {
    case 0: return Disc{length()};
    case 1:
    case 2: return Rectangle{{length(), length()}};
    case 3: return Polygon{points};
    default: return Polyline{points};
  }
}

}  // namespace

std::vector<Object> random_world_2d(std::uint64_t seed, int count) {
  Dice dice{std::mt19937_64(seed)};
  std::vector<Object> world;
  for (int i = 0; i < count; ++i) {
    const bool lattice = dice.chance(0.6);
    Object o;
    o.id = static_cast<ObjectId>(i);
    o.shape = random_shape(dice, lattice);
    o.pose.position = Vec3(dice.point(lattice, 20), 0.0);
    o.pose.orientation = turn_about_z(dice.chance(0.5)   ? 0.0
                                      : dice.chance(0.5) ? dice.whole(0, 7) * std::numbers::pi / 4
                                                         : dice.real(-4, 4));
    o.occluder = dice.chance(0.9);
    world.push_back(o);
  }
  return world;
}

View random_view_2d(std::uint64_t seed, std::span<const Object> world) {
  Dice dice{std::mt19937_64(seed ^ 0x5EEDull)};
  View view;
  view.viewer = 0;
  view.pose = {Vec3(dice.point(dice.chance(0.5), 20), 0.0), turn_about_z(dice.real(-4, 4))};
  const Object& o = world[static_cast<std::size_t>(dice.whole(0, static_cast<int>(world.size()) - 1))];
  const std::vector<Vec2> outline = world_outline(o.shape, o.pose);
  if (!outline.empty() && dice.chance(0.3)) {
    const std::size_t i = static_cast<std::size_t>(dice.whole(0, static_cast<int>(outline.size()) - 1));
    const Vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    // A thin wall's rounded middle lies a bit beside it, and nobody can say on which side.
    view.pose.position = Vec3(is_thin(o.shape) || dice.chance(0.5) ? a : 0.5 * (a + b), 0.0);
  }
  if (dice.chance(0.3)) view.range = dice.real(5, 30);
  if (dice.chance(0.3)) view.fov = dice.real(0.1, 2 * std::numbers::pi);
  if (dice.chance(0.2)) view.rides = o.id;
  return view;
}

}  // namespace gridcull::test
