#include "gridcull/methods/extended_plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gridcull::extended {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Share of the way from cell to plane that is too near for occluders.
constexpr double near_share = 1e-3;

float round_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}
float round_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

std::array<double, 2> depths_of(const Polytope& p) {
  std::array<double, 2> out{infinity, -infinity};
  for (const Vec3& x : p.points) out = {std::min(out[0], x.z), std::max(out[1], x.z)};
  return out;
}

double reach_of(const Polytope& p) {
  double reach = 0.0;
  for (const Vec3& x : p.points) reach = std::max(reach, std::fabs(x.x) + std::fabs(x.y) + std::fabs(x.z));
  return reach;
}

}  // namespace

Plane make_plane(const Vec3& half, double distance, int resolution) {
  Plane plane;
  plane.half = half;
  plane.distance = distance;
  const double gap = distance - half.z;
  plane.near = half.z + near_share * gap;
  plane.extent = plane_extension * (Vec2(half) + Vec2(gap));
  plane.resolution = resolution;
  return plane;
}

bool OccluderProjector::add(const Plane& plane, const Polytope& occluder, double error, int cuts, DepthMap& map) {
  whole_ = occluder;
  error += 1e-14 * reach_of(whole_);
  clip_(whole_, 2, 1.0, plane.near);
  const auto [near, far] = depths_of(whole_);
  if (!(near <= far)) return false;
  // Rays from the cell to the map stay within these sides up to the plane, and behind it within the same angle.
  const double widen = 1.01 * std::max(1.0, (far + plane.half.z) / (plane.distance - plane.half.z));
  for (const int axis : {0, 1}) {
    for (const double sign : {1.0, -1.0}) clip_(whole_, axis, sign, -2.0 * widen * plane.extent[axis]);
  }
  if (whole_.points.empty()) return false;
  bool any = false;
  const double front = std::min(far, plane.distance);
  for (int i = 1; i <= cuts && near <= front; ++i) {
    const double cut = i == cuts ? front : near + (front - near) * i / cuts;
    part_ = whole_;
    clip_(part_, 2, -1.0, -cut);
    any = enter(plane, part_, error, cut, map) || any;
  }
  if (far > plane.distance) {
    part_ = whole_;
    clip_(part_, 2, 1.0, plane.distance);
    any = enter(plane, part_, error, far, map) || any;
  }
  return any;
}

bool OccluderProjector::enter(const Plane& plane, const Polytope& part, double error, double depth, DepthMap& map) {
  if (part.points.size() < 3 || !view_all(plane, part, error) || !choose_rows(plane)) return false;
  const auto lines = 2 * static_cast<std::size_t>(plane.resolution);
  low_.assign(lines, -infinity);
  high_.assign(lines, infinity);
  const std::span<const Vec2> views(views_);
  const std::size_t n = part.points.size();
  for (std::size_t v = 0; v < 8; ++v) cut_lines(plane, views.subspan(v * n, n));
  return fill(plane, depth + error, map);
}

/// Projects the points from the cell's corners. With k = (D - w(V)) / (w(X) - w(V)) a view is V + k (X - V). X is off
/// by at most `error`, so k is by at most k * error / (w(X) - w(V) - error), and the view by k * error + |X - V| * k *
/// 2 error / (w(X) - w(V)) while error is below half of that gap; |X - V| k = |P - V|. Some ten roundings of 2^-53 of
/// |P| + |V| come on top, and of the extent for what follows.
bool OccluderProjector::view_all(const Plane& plane, const Polytope& part, double error) {
  views_.clear();
  const Vec3& h = plane.half;
  double widest = 0.0, largest_k = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 v{(corner & 1) ? h.x : -h.x, (corner & 2) ? h.y : -h.y, (corner & 4) ? h.z : -h.z};
    for (const Vec3& x : part.points) {
      const double k = (plane.distance - v.z) / (x.z - v.z);
      const Vec2 p{v.x + k * (x.x - v.x), v.y + k * (x.y - v.y)};
      largest_k = std::max(largest_k, k);
      widest = std::max({widest, std::fabs(p.x), std::fabs(p.y)});
      views_.push_back(p);
    }
  }
  const double gap = depths_of(part)[0] - h.z;
  const double size = widest + std::max({h.x, h.y, plane.extent.x, plane.extent.y});
  margin_ = largest_k * error + size * (2.0 * error / gap + 4e-14);
  return gap > 4.0 * error && margin_ < 0.25 * std::min(plane.pixel().x, plane.pixel().y);
}

/// Rows whose lines every view crosses.
bool OccluderProjector::choose_rows(const Plane& plane) {
  Vec2 low(-infinity), high(infinity);
  const std::size_t n = views_.size() / 8;
  for (std::size_t v = 0; v < 8; ++v) {
    Vec2 least(infinity), most(-infinity);
    for (std::size_t i = v * n; i < (v + 1) * n; ++i)
      least = glm::min(least, views_[i]), most = glm::max(most, views_[i]);
    low = glm::max(low, least);
    high = glm::min(high, most);
  }
  const Vec2 pixel = plane.pixel();
  if (!(high.x - low.x >= pixel.x && high.y - low.y >= pixel.y)) return false;
  const auto row = [&](double y) {
    return static_cast<int>(std::floor(std::clamp((y + plane.extent.y) / pixel.y, -1.0, plane.resolution + 1.0)));
  };
  const auto inside = [&](int r) {
    return r * pixel.y - plane.extent.y - margin_ > low.y && (r + 1) * pixel.y - plane.extent.y + margin_ < high.y;
  };
  first_row_ = std::max(0, row(low.y));
  last_row_ = std::min(plane.resolution - 1, row(high.y));
  while (first_row_ <= last_row_ && !inside(first_row_)) ++first_row_;
  while (first_row_ <= last_row_ && !inside(last_row_)) --last_row_;
  return first_row_ <= last_row_;
}

/// Where the rows' lines (each row's bottom less the margin, its top more the margin) run inside one view. Of a hull's
/// edges, counter-clockwise, those that go up bound it on the right. A closed ring crosses each line between its least
/// and greatest y both ways, and every crossing lies in the hull, so the least on the right and the greatest on the
/// left are safe even if rounding bent the ring.
void OccluderProjector::cut_lines(const Plane& plane, std::span<const Vec2> view) {
  hull_.assign(view.begin(), view.end());
  hull_corners(hull_, order_, corners_);
  const double pixel = plane.pixel().y;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vec2 &a = hull_[corners_[i]], &b = hull_[corners_[(i + 1) % corners_.size()]];
    const bool up = b.y > a.y;
    const double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
    if (!(low < high)) continue;
    const double slope = (b.x - a.x) / (b.y - a.y);
    const auto near_row = [&](double y) { return std::floor(std::clamp((y + plane.extent.y) / pixel, -2e4, 2e4)); };
    const int first = std::max(first_row_, static_cast<int>(near_row(low)) - 1);
    const int last = std::min(last_row_, static_cast<int>(near_row(high)) + 1);
    for (int r = first; r <= last; ++r) {
      for (const int side : {0, 1}) {
        const double y = (r + side) * pixel - plane.extent.y + (side == 0 ? -margin_ : margin_);
        if (!(low <= y && y < high)) continue;
        const double x = a.x + (y - a.y) * slope;
        const auto line = static_cast<std::size_t>(2 * r + side);
        if (up) {
          high_[line] = std::min(high_[line], x);
        } else {
          low_[line] = std::max(low_[line], x);
        }
      }
    }
  }
}

bool OccluderProjector::fill(const Plane& plane, double depth, DepthMap& map) {
  const double pixel = plane.pixel().x;
  const float stored = round_up(depth);
  bool any = false;
  for (int r = first_row_; r <= last_row_; ++r) {
    const auto line = static_cast<std::size_t>(2 * r);
    const double left = std::max(low_[line], low_[line + 1]) + margin_ + plane.extent.x;
    const double right = std::min(high_[line], high_[line + 1]) - margin_ + plane.extent.x;
    if (!(right - left >= pixel)) continue;
    const int first = static_cast<int>(std::ceil(std::clamp(left / pixel, 0.0, plane.resolution + 1.0)));
    const int last = static_cast<int>(std::floor(std::clamp(right / pixel, 0.0, plane.resolution + 0.0))) - 1;
    if (first > last) continue;
    map.cover(r, first, last, stored);
    any = true;
  }
  return any;
}

namespace {

struct Span {
  double low = infinity, high = -infinity;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
};

/// The union of the views of [x0, x1] x [w0, w1] from [-half, half] x [-depth, depth], one axis beside w. Through a
/// fixed X the plane's point is a fractional linear function of V and the other way round: extremes lie at corners.
/// Where X is nearer than the plane these are the separating lines, beyond it the supporting ones (3.1).
Span union_of_views(double half, double depth, double distance, const std::array<double, 2>& x,
                    const std::array<double, 2>& w) {
  Span out;
  for (const double vw : {-depth, depth}) {
    for (const double xw : w) {
      const double k = (distance - vw) / (xw - vw);
      for (const double v : {-half, half}) {
        for (const double xx : x) out.add(v + k * (xx - v));
      }
    }
  }
  return out;
}

/// Section 4.2, from the cell's front side: a point P of the plane holds X in its cone when it lies between the lines
/// through X from the side's ends, low(X) <= P <= high(X). The span meets this interval for each X.
Span improved(double half, double depth, double distance, const std::array<double, 2>& x,
              const std::array<double, 2>& w) {
  double greatest_low = -infinity, least_high = infinity;
  for (const double xw : w) {
    const double k = (distance - depth) / (xw - depth);
    for (const double xx : x) {
      greatest_low = std::max(greatest_low, half + k * (xx - half));
      least_high = std::min(least_high, -half + k * (xx + half));
    }
  }
  if (greatest_low < least_high) {  // beyond the vanishing point
    const double middle = 0.5 * (greatest_low + least_high);
    return {middle, middle};
  }
  return {least_high, greatest_low};
}

/// Pixels that the spans touch, and whether they leave the map. The formulas above round some ten times, each by 2^-53
/// of the greatest number in them; the spans grow by far more.
struct Touched {
  PixelRange range{};
  bool beside = false, leaves = true;

  Touched(const Plane& plane, Span u, Span v) {
    const Vec2 pixel = plane.pixel();
    std::array<int, 4> at{};
    bool inside = true;
    int next = 0;
    for (const Span& s : {u, v}) {
      const int axis = next / 2;
      const double extent = plane.extent[axis], half = plane.half[axis];
      const double grow = 1e-13 * (std::fabs(s.low) + std::fabs(s.high) + half + extent);
      const double low = (s.low - grow + extent) / pixel[axis], high = (s.high + grow + extent) / pixel[axis];
      if (!(low <= high)) return;  // not a number: it leaves the map
      const double end = plane.resolution;
      beside = beside || high < 0.0 || low >= end;
      inside = inside && low >= 0.0 && high < end;
      at[static_cast<std::size_t>(next++)] = static_cast<int>(std::floor(std::clamp(low, 0.0, end - 1.0)));
      at[static_cast<std::size_t>(next++)] = static_cast<int>(std::floor(std::clamp(high, 0.0, end - 1.0)));
    }
    leaves = !inside;
    range = {at[0], at[2], at[1], at[3]};
  }
};

Cover look_at_part(const Plane& plane, const DepthMap& map, const Bounds& box, std::uint64_t& looked_at) {
  const Vec3& h = plane.half;
  const std::array<double, 2> u{box.min.x, box.max.x}, v{box.min.y, box.max.y}, w{box.min.z, box.max.z};
  const float depth = round_down(box.min.z);
  if (box.max.z <= plane.distance) {
    const Touched spot(plane, improved(h.x, h.z, plane.distance, u, w), improved(h.y, h.z, plane.distance, v, w));
    if (!spot.leaves && map.look(spot.range, depth, looked_at) == Cover::all) return Cover::all;
  }
  const Touched all(plane, union_of_views(h.x, h.z, plane.distance, u, w),
                    union_of_views(h.y, h.z, plane.distance, v, w));
  if (all.beside) return Cover::none;
  const Cover cover = map.look(all.range, depth, looked_at);
  return all.leaves && cover == Cover::all ? Cover::some : cover;
}

}  // namespace

Cover look_at(const Plane& plane, const DepthMap& map, const Bounds& box, std::uint64_t& looked_at) {
  if (!(box.min.z > plane.half.z)) return Cover::some;
  if (!(box.min.z < plane.distance && box.max.z > plane.distance)) return look_at_part(plane, map, box, looked_at);
  Bounds front = box, back = box;
  front.max.z = back.min.z = plane.distance;
  const Cover before = look_at_part(plane, map, front, looked_at);
  if (before == Cover::some) return before;
  const Cover behind = look_at_part(plane, map, back, looked_at);
  return before == behind ? before : Cover::some;
}

}  // namespace gridcull::extended
