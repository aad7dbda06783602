// Along a line the interpolant of a cell is a cubic in t. Its sign is found between its turning points, which are the
// roots of a quadratic, by halving: places are good to the last bits, but for tangents, where the interior is met in a
// stretch shorter than the root of that. Cells whose corners have one sign are told without it, exactly, and 8 x 8 x 8
// of them at a time.
#include "gridcull/core/exact_3d_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace gridcull::exact {
namespace {

constexpr int edge = FieldBlock::side;

/// c[0] + c[1] s + c[2] s^2 + c[3] s^3.
using Cubic = std::array<double, 4>;

double value_of(const Cubic& c, double s) { return c[0] + s * (c[1] + s * (c[2] + s * c[3])); }

/// By s = 0 .. 1 between two points of a cell (0 .. 1 along each axis).
Cubic cubic_along(const std::array<double, 8>& corners, const Vec3& from, const Vec3& to) {
  const Vec3 d = to - from;
  std::array<Cubic, 8> c{};
  for (std::size_t i = 0; i < 8; ++i) c[i][0] = corners[i];
  // Along one axis after the other: c0 + (c1 - c0) (from + d s).
  for (int k = 2; k >= 0; --k) {
    const std::size_t half = std::size_t{1} << k;
    for (std::size_t i = 0; i < half; ++i) {
      Cubic out = c[i];
      for (std::size_t p = 0; p < 4; ++p) {
        const double rise = c[i + half][p] - c[i][p];
        out[p] += from[k] * rise;
        if (p < 3) out[p + 1] += d[k] * rise;
      }
      c[i] = out;
    }
  }
  return c[0];
}

/// 0, where the cubic turns, and 1, ascending.
struct Breaks {
  std::array<double, 4> at{0.0};
  std::size_t count = 1;

  void add(double s) {
    if (s > at[count - 1] && s < 1.0) at[count++] = s;
  }
};

Breaks breaks_of(const Cubic& c) {
  Breaks out;
  const double a = 3.0 * c[3], b = c[2], d = c[1];  // a s^2 + 2 b s + d
  const double square = b * b - a * d;
  if (square > 0.0) {
    const double q = -(b + std::copysign(std::sqrt(square), b));
    const double one = a != 0.0 ? q / a : 2.0, other = q != 0.0 ? d / q : 2.0;
    out.add(std::min(one, other));
    out.add(std::max(one, other));
  }
  out.at[out.count++] = 1.0;
  return out;
}

/// Where the cubic changes its sign between two places.
double crossing(const Cubic& c, double low, double high) {
  const bool inside = value_of(c, low) < 0.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) return middle;
    ((value_of(c, middle) < 0.0) == inside ? low : high) = middle;
  }
}

/// Calls f({begin, end}, cell) for the cubes of `step` points an edge that the line passes in the window, in order;
/// `cell` counts such cubes. Rounding may give a sliver to a neighbour.
template <class Line, class Window, class F>
void walk(const Line& line, const Window& window, double step, F&& f) {
  LatticePoint cell(glm::floor(line.at(window.begin) / step)), way(0);
  Vec3 next(std::numeric_limits<double>::infinity());
  const auto plane = [&](int k) { return ((cell[k] + (way[k] > 0 ? 1 : 0)) * step - line.from[k]) / line.along[k]; };
  for (int k = 0; k < 3; ++k) {
    if (line.along[k] == 0.0) continue;
    way[k] = line.along[k] > 0.0 ? 1 : -1;
    while (!((next[k] = plane(k)) > window.begin)) cell[k] += way[k];
  }
  for (double t = window.begin; t < window.end;) {
    const int k = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
    const double end = std::min(next[k], window.end);
    if (end > t) f(Window{t, end}, cell);
    t = std::max(t, end);
    if (!(next[k] < window.end)) return;
    cell[k] += way[k];
    next[k] = plane(k);
  }
}

std::uint64_t key_of(const LatticePoint& p) {
  constexpr std::uint64_t bits = (1u << 21) - 1;
  const auto part = [&](int x) { return static_cast<std::uint64_t>(x >> 3) & bits; };
  return part(p.x) << 42 | part(p.y) << 21 | part(p.z);
}

double size_of(const Vec3& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

}  // namespace

RayVolume::RayVolume(const Volume& volume, const Pose& pose)
    : field_(volume.field), iso_(volume.iso), below_(volume.inside_below) {
  const FieldFrame& frame = field_->frame();
  const Rotation outer = rotation_of(pose.orientation), inner = rotation_of(frame.pose.orientation);
  origin_ = to_world(pose, outer, frame.pose.position);
  step_ = {outer * (frame.voxel * inner.x), outer * (frame.voxel * inner.y), outer * (frame.voxel * inner.z)};
  const double det = glm::dot(step_[0], glm::cross(step_[1], step_[2]));
  rows_ = {glm::cross(step_[1], step_[2]) / det, glm::cross(step_[2], step_[0]) / det,
           glm::cross(step_[0], step_[1]) / det};
  read_blocks();
  find_world_box(size_of(pose.position) + size_of(frame.pose.position));
  find_inside_points();
}

void RayVolume::take_in(const LatticePoint& first, const LatticePoint& last) {
  const bool any = first_.x <= last_.x;
  first_ = any ? glm::min(first_, first) : first;
  last_ = any ? glm::max(last_, last) : last;
}

void RayVolume::read_blocks() {
  blocks_.reserve(field_->blocks().size());
  for (const FieldBlock& block : field_->blocks()) {
    const auto inside =
        std::count_if(block.values.begin(), block.values.end(), [&](float v) { return depth(v) < 0.0; });
    blocks_[key_of(block.origin)] = inside == 0 ? Side::outside : inside == 512 ? Side::inside : Side::mixed;
    if (inside > 0) take_in(block.origin, block.origin + LatticePoint(edge - 1));
  }
  for (const FieldTile& tile : field_->tiles()) {
    if (depth(tile.value) < 0.0) take_in(tile.origin, tile.origin + LatticePoint(tile.side - 1));
  }
}

void RayVolume::find_world_box(double magnitude) {
  for (unsigned i = 0; i < 8; ++i) {
    Vec3 p = origin_;
    for (int k = 0; k < 3; ++k) {
      p += ((i >> k & 1) != 0 ? last_[k] + 1.0 : first_[k] - 1.0) * step_[static_cast<std::size_t>(k)];
    }
    world_box_.add(p);
    magnitude = std::max(magnitude, size_of(p));
  }
  blur_ = 1e-14 * magnitude;
  world_box_.min -= Vec3(blur_), world_box_.max += Vec3(blur_);
}

// The farthest along a few directions: every point of a small volume may be one, one of each block of a large one.
void RayVolume::find_inside_points() {
  std::array<std::pair<double, LatticePoint>, 26> best;
  best.fill({-std::numeric_limits<double>::infinity(), LatticePoint(0)});
  const auto try_point = [&](const LatticePoint& p) {
    std::size_t i = 0;
    for (int n = 0; n < 27; ++n) {
      if (n == 13) continue;
      const LatticePoint way(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const double along =
          static_cast<double>(p.x) * way.x + static_cast<double>(p.y) * way.y + static_cast<double>(p.z) * way.z;
      if (along > best[i].first) best[i] = {along, p};
      ++i;
    }
  };
  const bool small = field_->blocks().size() <= 100;
  for (const FieldBlock& block : field_->blocks()) {
    for (int i = 0; i < 512; ++i) {
      if (!(depth(block.values[static_cast<std::size_t>(i)]) < 0.0)) continue;
      try_point(block.origin + LatticePoint(i >> 6, i >> 3 & 7, i & 7));
      if (!small) break;
    }
  }
  for (const FieldTile& tile : field_->tiles()) {
    if (depth(tile.value) < 0.0) try_point(tile.origin), try_point(tile.origin + LatticePoint(tile.side - 1));
  }
  for (const auto& [along, p] : best) {
    const Vec3 world = origin_ + static_cast<double>(p.x) * step_[0] + static_cast<double>(p.y) * step_[1] +
                       static_cast<double>(p.z) * step_[2];
    if (std::isfinite(along) &&
        std::find(inside_points_.begin(), inside_points_.end(), world) == inside_points_.end()) {
      inside_points_.push_back(world);
    }
  }
}

Vec3 RayVolume::to_lattice(const Vec3& direction) const {
  return {glm::dot(rows_[0], direction), glm::dot(rows_[1], direction), glm::dot(rows_[2], direction)};
}

RayVolume::Side RayVolume::side_of_block(const LatticePoint& origin) const {
  if (const auto found = blocks_.find(key_of(origin)); found != blocks_.end()) return found->second;
  return depth(field_->at(origin)) < 0.0 ? Side::inside : Side::outside;
}

/// Of 8 x 8 x 8 cells: their points are those of a block and the first ones of the next.
RayVolume::Side RayVolume::side_of_brick(const LatticePoint& brick) const {
  const Side side = side_of_block(edge * brick);
  for (int i = 1; i < 8 && side != Side::mixed; ++i) {
    if (side_of_block(edge * (brick + LatticePoint(i & 1, i >> 1 & 1, i >> 2 & 1))) != side) return Side::mixed;
  }
  return side;
}

RayVolume::Corners RayVolume::corners_of(const LatticePoint& cell) const {
  Corners out;
  for (int i = 0; i < 8; ++i) {
    out[static_cast<std::size_t>(i)] = depth(field_->at(cell + LatticePoint(i & 1, i >> 1 & 1, i >> 2 & 1)));
  }
  return out;
}

void RayVolume::add(const Stretch& stretch, std::vector<Stretch>& out) const {
  if (!(stretch.end > stretch.begin)) return;
  if (!out.empty() && stretch.begin - out.back().end <= blur_) {
    out.back().end = std::max(out.back().end, stretch.end);
  } else {
    out.push_back(stretch);
  }
}

void RayVolume::add_cell(const Line& line, const Window& part, const LatticePoint& cell,
                         std::vector<Stretch>& out) const {
  const Corners corners = corners_of(cell);
  const auto inside = std::count_if(corners.begin(), corners.end(), [](double d) { return d < 0.0; });
  if (inside == 0) return;
  if (inside == 8) return add({part.begin, part.end}, out);
  const Cubic c = cubic_along(corners, line.at(part.begin) - Vec3(cell), line.at(part.end) - Vec3(cell));
  const Breaks breaks = breaks_of(c);
  const auto place = [&](double s) { return part.begin + s * (part.end - part.begin); };
  for (std::size_t i = 0; i + 1 < breaks.count; ++i) {
    const double low = breaks.at[i], high = breaks.at[i + 1];
    const bool in = value_of(c, low) < 0.0, on = value_of(c, high) < 0.0;
    if (!in && !on) continue;
    const double cut = in == on ? high : crossing(c, low, high);
    add(in ? Stretch{place(low), on ? place(high) : place(cut)} : Stretch{place(cut), place(high)}, out);
  }
}

void RayVolume::add_brick(const Line& line, const Window& part, const LatticePoint& brick,
                          std::vector<Stretch>& out) const {
  const Side side = side_of_brick(brick);
  if (side == Side::outside) return;
  if (side == Side::inside) return add({part.begin, part.end}, out);
  walk(line, part, 1.0, [&](const Window& w, const LatticePoint& cell) { add_cell(line, w, cell, out); });
}

void RayVolume::add_stretches(const Vec3& eye, const Vec3& ray, std::vector<Stretch>& out) const {
  const Line line{to_lattice(eye - origin_), to_lattice(ray)};
  Window window{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k) {
    const double low = first_[k] - 1.0 - line.from[k], high = last_[k] + 1.0 - line.from[k];
    if (line.along[k] == 0.0) {
      if (low > 0.0 || high < 0.0) return;
      continue;
    }
    const double a = low / line.along[k], b = high / line.along[k];
    window = {std::max(window.begin, std::min(a, b)), std::min(window.end, std::max(a, b))};
  }
  if (!(window.begin < window.end)) return;
  // Stretches of other solids may stand before these.
  std::vector<Stretch> own;
  walk(line, window, edge, [&](const Window& w, const LatticePoint& brick) { add_brick(line, w, brick, own); });
  out.insert(out.end(), own.begin(), own.end());
}

bool RayVolume::surely_inside(const Vec3& point) const {
  const Vec3 p = to_lattice(point - origin_);
  for (int k = 0; k < 3; ++k) {
    if (p[k] < first_[k] - 1.0 || p[k] > last_[k] + 1.0) return false;
  }
  const LatticePoint cell(glm::floor(p));
  const Corners corners = corners_of(cell);
  double greatest = 0.0;
  for (const double d : corners) greatest = std::max(greatest, std::fabs(d));
  const double blur = 1e-12 + 100.0 * (blur_ + 1e-14 * size_of(point)) / field_->frame().voxel;
  return cubic_along(corners, p - Vec3(cell), p - Vec3(cell))[0] < -blur * greatest;
}

}  // namespace gridcull::exact
