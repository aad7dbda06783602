#include "random_scenery.h"

#include <numbers>
#include <random>

#include "gridcull/core/error.h"
#include "gridcull/core/trigonometry.h"
#include "random_meshes.h"
#include "random_volumes.h"

namespace gridcull::test {
namespace {

constexpr double pi = std::numbers::pi;

Vec2 on_circle(double angle) {
  const SinCos c = stable_sincos(angle);
  return {c.cos, c.sin};
}

bool is_valid(const Shape& shape) {
  try {
    validate(shape);
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace

Scenery::Scenery(int dimension, Random& random) : dimension_(dimension), random_(random) {
  static constexpr double cells[] = {1.0, 1.0, 0.5, 2.0, 0.1, 1.0 / 3.0, 7.3};
  cell_ = cells[random_.below(7)];
  Vec3 origin(0.0);
  switch (random_.below(6)) {
    case 0: origin = Vec3(-5.0 * cell_); break;
    case 1: origin = {random_.uniform(-9, 9), random_.uniform(-9, 9), random_.uniform(-9, 9)}; break;
    case 2: origin = {1234567.0, -7654321.5, 50000.25}; break;
    default: break;
  }
  Vec3 size(0.0);
  crowd_ = chance(0.7);
  const std::uint32_t least = crowd_ ? (dimension == 2 ? 36 : 24) : 8;
  const std::uint32_t most = dimension == 2 ? 60 : (crowd_ || chance(0.1) ? 56 : 26);
  for (int k = 0; k < dimension; ++k) size[k] = cell_ * (least + random_.below(most - least + 1));
  if (chance(0.2)) size += Vec3(0.37 * cell_);
  extent_ = std::max({size.x, size.y, size.z});
  if (dimension == 2) origin.z = size.z = 0.0;
  bounds_ = {origin, origin + size};
  // Now and then one cell is larger than everything, or bounds are small in a large world.
  if (chance(0.03)) cell_ = 3.0 * extent_;
  if (chance(0.1)) bounds_.max = origin + 0.4 * size;
  static constexpr double units[] = {1.0, 1.0, 0.5, 2.0};
  unit_ = cell_ * units[random_.below(4)];
  if (unit_ > 0.3 * extent_) unit_ = extent_ / 16.0;
  static constexpr double shares[] = {0.0, 0.5, 1.0, 1.0};
  aligned_ = shares[random_.below(4)];
  big_ = crowd_ ? random_.uniform(0.15, 0.4) : random_.uniform(0.15, 0.6);
}

// Long and a few cells thick: holds whole cells, and hides what is behind.
Vec3 Scenery::wall() {
  Vec3 size(0.0);
  for (int k = 0; k < 3; ++k)
    size[k] = extent_ * (dimension_ == 2 ? random_.uniform(0.25, 0.8) : random_.uniform(0.4, 1.2));
  size[static_cast<int>(random_.below(static_cast<std::uint32_t>(dimension_)))] =
      std::min(cell_, 0.05 * extent_) * random_.uniform(2.0, dimension_ == 2 ? 8.0 : 10.0);
  if (chance(aligned_)) size = glm::max(Vec3(1.0), glm::round(size / unit_)) * unit_;
  return size;
}

double Scenery::snapped(double metres, int axis) const {
  const double origin = bounds_.min[axis];
  return origin + std::floor((metres - origin) / unit_ + 0.5) * unit_;
}

Vec3 Scenery::snapped(const Vec3& p) const {
  return {snapped(p.x, 0), snapped(p.y, 1), dimension_ == 3 ? snapped(p.z, 2) : 0.0};
}

Vec3 Scenery::place() {
  const double beyond = chance(0.08) ? 0.5 : 0.0;  // of the extent
  Vec3 p(0.0);
  for (int k = 0; k < dimension_; ++k) {
    const double side = std::max(bounds_.max[k] - bounds_.min[k], 0.5 * extent_);
    p[k] = bounds_.min[k] + side * random_.uniform(-beyond, 1.0 + beyond);
  }
  if (chance(0.01)) p += 1e5 * direction();
  return chance(aligned_) ? snapped(p) : p;
}

Quat Scenery::orientation() {
  if (dimension_ == 2 || chance(0.5)) {
    if (chance(std::max(0.2, aligned_))) return chance(0.6) ? Quat{} : turn_about_z(random_.below(8) * pi / 4);
    return turn_about_z(random_.uniform(-pi, pi));
  }
  Quat q{};
  do {
    q = {random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)};
    if (chance(0.3)) q = {std::round(q.w), std::round(q.x), std::round(q.y), std::round(q.z)};
  } while (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z < 0.01);
  return normalised(q);
}

Vec3 Scenery::direction() {
  Vec3 d(0.0);
  while (glm::dot(d, d) < 0.01) {
    for (int k = 0; k < dimension_; ++k) d[k] = random_.uniform(-1, 1);
    if (chance(0.4)) d = glm::round(d);  // axes and diagonals
  }
  return glm::normalize(d);
}

double Scenery::size() {
  double s = extent_ * random_.uniform(0.1, 0.5);
  if (!chance(big_))
    s = chance(0.2) ? cell_ * random_.uniform(0.01, 0.2) : std::min(cell_, 0.1 * extent_) * random_.uniform(0.2, 3.0);
  if (chance(aligned_)) s = std::max(1.0, std::floor(s / unit_ + 0.5)) * unit_;
  return s;
}

std::vector<Vec2> Scenery::outline() {
  const std::uint32_t n = 3 + random_.below(6);
  const double s = size();
  // A third each: a star about the origin (concave), any order (self-crossing), off the origin.
  const std::uint32_t kind = random_.below(3);
  const Vec2 shift = kind == 2 ? Vec2(direction()) * s : Vec2(0.0);
  std::vector<Vec2> points;
  for (std::uint32_t i = 0; i < n; ++i) {
    Vec2 p{random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5)};
    if (kind != 1) {
      const double angle = 2 * pi * (i + random_.unit() * 0.8) / n;
      p = random_.uniform(0.2, 0.7) * on_circle(angle);
    }
    p = s * p + shift;
    if (chance(aligned_)) p = glm::round(p / unit_) * unit_;
    points.push_back(p);
    if (chance(0.05)) points.push_back(p);                                               // repeated point
    if (chance(0.05) && points.size() > 2) points.push_back(points[points.size() - 2]);  // spike
  }
  return points;
}

Shape Scenery::shape_2d() {
  if (crowd_ && chance(big_)) return Rectangle{Vec2(wall())};
  switch (random_.below(5)) {
    case 0: return Disc{0.5 * size()};
    case 1:
    case 2: {
      Rectangle r{{size(), size()}};
      if (chance(0.1)) r.size.y = 1e-3 * cell_;  // all but thin
      return r;
    }
    case 3: return Polygon{outline()};
    default: {
      std::vector<Vec2> points = outline();
      points.resize(std::min<std::size_t>(points.size(), 2 + random_.below(5)));
      if (chance(0.3)) points.push_back(points.front());
      return Polyline{points};
    }
  }
}

Shape Scenery::convex() {
  const double s = size();
  std::vector<Vec3> points;
  const std::uint32_t n = 4 + random_.below(9);
  for (std::uint32_t i = 0; i < n; ++i) {
    Vec3 p = s * Vec3{random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5), random_.uniform(-0.5, 0.5)};
    if (chance(aligned_)) p = glm::round(p / unit_) * unit_;
    points.push_back(p);
  }
  return Convex{points};
}

Shape Scenery::faces() {
  const double s = size();
  const Vec3 h = 0.5 * Vec3{s, chance(0.5) ? s : size(), chance(0.5) ? s : size()};
  if (chance(0.4)) {
    std::mt19937_64 dice(random_.below(1u << 30));
    return random_mesh(dice, 0.5 * s);
  }
  if (chance(0.4)) {  // a wall of two triangles across the local x axis
    return Faces{{{0, -h.y, -h.z}, {0, h.y, -h.z}, {0, h.y, h.z}, {0, -h.y, h.z}}, {{0, 1, 2}, {0, 2, 3}}};
  }
  if (chance(0.5)) {  // an open box: floor and two walls
    return Faces{{{-h.x, -h.y, -h.z},
                  {h.x, -h.y, -h.z},
                  {h.x, h.y, -h.z},
                  {-h.x, h.y, -h.z},
                  {-h.x, -h.y, h.z},
                  {h.x, -h.y, h.z}},
                 {{0, 1, 2}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}}};
  }
  std::vector<Vec3> points;
  for (int i = 0; i < 5; ++i)
    points.push_back(h * Vec3{random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)});
  return Faces{points, {{0, 1, 2}, {2, 3, 4}}};
}

Shape Scenery::volume() {
  const double s = chance(0.5) ? extent_ * random_.uniform(0.2, 0.8) : size();
  std::mt19937_64 dice(random_.below(1u << 30));
  return random_volume(dice, 0.5 * s);
}

Shape Scenery::shape_3d() {
  if (crowd_ && chance(big_)) return chance(0.1) ? volume() : Shape(Cuboid{wall()});
  switch (random_.below(8)) {
    case 0: return Sphere{0.5 * size()};
    case 1:
    case 2:
    case 3: {
      Cuboid c{{size(), size(), size()}};
      if (chance(0.3)) c.size[static_cast<int>(random_.below(3))] = cell_ * (1.0 + random_.below(2));  // a wall
      return c;
    }
    case 4: return Prism{outline(), size()};
    case 5: return convex();
    case 6: return volume();
    default: return faces();
  }
}

std::vector<Object> Scenery::room() {
  Vec3 low = place(), high = place();
  const double thick =
      std::min(cell_, 0.05 * extent_) * (chance(aligned_) ? 2.0 + random_.below(3) : random_.uniform(2.0, 5.0));
  std::vector<Object> walls;
  const bool still = chance(0.5), overlap = chance(0.5);
  for (int k = 0; k < dimension_; ++k) {
    if (low[k] > high[k]) std::swap(low[k], high[k]);
    high[k] = std::max(high[k], low[k] + 0.25 * extent_);
  }
  for (int k = 0; k < dimension_; ++k) {
    for (const double side : {-1.0, 1.0}) {
      if (chance(0.08)) continue;  // a door
      Vec3 size = high - low + Vec3(overlap ? 2.0 * thick : 0.0);
      size[k] = thick;
      Object o;
      o.shape = dimension_ == 2 ? Shape(Rectangle{Vec2(size)}) : Shape(Cuboid{size});
      o.pose.position = 0.5 * (low + high);
      o.pose.position[k] += side * 0.5 * (high[k] - low[k] + thick);
      o.is_static = still;
      o.max_speed = chance(0.5) ? 0.0 : cell_;
      walls.push_back(std::move(o));
    }
  }
  return walls;
}

Object Scenery::beside(const Object& other) {
  // The same shape: at the same place, or moved by its own size so that faces abut.
  Object o = other;
  Vec3 step(0.0);
  if (const auto* r = std::get_if<Rectangle>(&o.shape)) step = {r->size.x, r->size.y, 0.0};
  if (const auto* c = std::get_if<Cuboid>(&o.shape)) step = c->size;
  const Rotation rotation = rotation_of(o.pose.orientation);
  const auto along = static_cast<int>(random_.below(static_cast<std::uint32_t>(dimension_)));
  Vec3 local(0.0);
  local[along] = chance(0.2) ? 0.0 : (chance(0.5) ? step[along] : -step[along]);
  o.pose.position += rotation * local;
  return o;
}

Object Scenery::object(const std::vector<Object>& others, double step) {
  Object o;
  if (!others.empty() && chance(0.25)) {
    o = beside(others[random_.below(static_cast<std::uint32_t>(others.size()))]);
  } else {
    for (bool good = false; !good;) {
      o.shape = dimension_ == 2 ? shape_2d() : shape_3d();
      good = is_valid(o.shape);
    }
    o.pose = {place(), orientation()};
    if (crowd_ && chance(0.5)) o.pose.orientation = Quat{};
  }
  o.occluder = !chance(0.12);
  o.is_static = chance(0.3);
  o.max_speed.reset();
  if (chance(0.8)) {
    static constexpr double cells_a_frame[] = {0.0, 0.05, 0.3, 1.0, 1.0, 2.5, 20.0};
    o.max_speed = std::min(1e9, cells_a_frame[random_.below(7)] * std::min(cell_, 0.1 * extent_) / step);
  }
  return o;
}

Vec3 Scenery::on_object(const Object& object) {
  std::vector<Vec3> points = world_vertices(object.shape, object.pose);
  for (const Vec2& p : world_outline(object.shape, object.pose)) points.emplace_back(p, 0.0);
  if (points.empty()) {  // round: a point of its outline, or its centre
    const double r = std::holds_alternative<Disc>(object.shape) ? std::get<Disc>(object.shape).radius
                                                                : std::get<Sphere>(object.shape).radius;
    const Vec3 away = direction();
    return object.pose.position + (chance(0.3) ? 0.0 : r) * away;
  }
  const Vec3 a = points[random_.below(static_cast<std::uint32_t>(points.size()))];
  const Vec3 b = points[random_.below(static_cast<std::uint32_t>(points.size()))];
  return chance(0.4) ? a : 0.5 * (a + b);  // a corner, a wall's middle or inside
}

Vec3 Scenery::viewpoint(const std::vector<Object>& objects) {
  const double what = random_.unit();
  if (objects.empty() || what < (crowd_ ? 0.7 : 0.4)) return place();
  if (chance(0.2)) {  // a voxel's corner
    const double unit = unit_;
    unit_ = cell_;
    const Vec3 corner = snapped(place());
    unit_ = unit;
    return corner;
  }
  const Object& o = objects[random_.below(static_cast<std::uint32_t>(objects.size()))];
  if (what < 0.82) return on_object(o);
  if (what < 0.86) return o.pose.position;
  const Vec3 away = direction();
  if (what < 0.92) return place() + extent_ * away;  // mostly outside
  return o.pose.position + away * reach_of(o.shape) * random_.uniform(1.0, 1.5);
}

Frustum Scenery::frustum() {
  Frustum f;
  f.fov_y = (chance(0.3) ? 90.0 : random_.uniform(3.0, 170.0)) * pi / 180.0;
  f.aspect = chance(0.4) ? 1.0 : random_.uniform(0.3, 3.0);
  if (chance(0.4)) f.near = extent_ * random_.uniform(0.0, 0.3);
  if (chance(0.4)) f.far = f.near + extent_ * random_.uniform(0.05, 1.0);
  return f;
}

View Scenery::view(ViewerId viewer, const std::vector<Object>& objects) {
  View v;
  v.viewer = viewer;
  v.pose = {viewpoint(objects), orientation()};
  if (chance(0.4)) v.range = chance(0.2) ? cell_ : extent_ * random_.uniform(0.05, 1.0);
  if (chance(0.2) && std::isfinite(v.range)) v.range = std::max(1.0, std::round(v.range / unit_)) * unit_;
  if (dimension_ == 2 && chance(0.6)) {
    v.fov = (chance(0.3) ? 90.0 * (1 + random_.below(3)) : random_.uniform(1.0, 359.0)) * pi / 180.0;
  }
  if (dimension_ == 3 && chance(0.6)) v.frustum = frustum();
  if (!objects.empty() && chance(0.2)) {
    const Object& o = objects[random_.below(static_cast<std::uint32_t>(objects.size()))];
    v.rides = o.id;
    v.pose = o.pose;
  }
  return v;
}

}  // namespace gridcull::test
