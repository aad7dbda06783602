// Hull: A. M. Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
#include "gridcull/methods/extended_polytope.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace gridcull::extended {
namespace {

constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();

double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross2(b - a, c - a); }

}  // namespace

void hull_corners(const std::vector<Vec2>& points, std::vector<std::uint32_t>& order,
                  std::vector<std::uint32_t>& corners) {
  order.resize(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (points[a].x != points[b].x) return points[a].x < points[b].x;
    return points[a].y != points[b].y ? points[a].y < points[b].y : a < b;
  });
  corners.clear();
  const auto add = [&](std::uint32_t i, std::size_t least) {
    while (corners.size() > least &&
           turn(points[corners[corners.size() - 2]], points[corners.back()], points[i]) <= 0) {
      corners.pop_back();
    }
    corners.push_back(i);
  };
  for (const std::uint32_t i : order) add(i, 1);
  const std::size_t upper = corners.size();
  for (std::size_t i = order.size(); i-- > 0;) {
    if (i + 1 < order.size()) add(order[i], upper);
  }
  if (corners.size() > 1) corners.pop_back();
}

/// Joins the points that lie in the cutting plane.
void Clipper::add_ring(int axis) {
  if (ring_.size() < 2) return;
  flat_.clear();
  for (const std::uint32_t i : ring_)
    flat_.emplace_back(out_.points[i][(axis + 1) % 3], out_.points[i][(axis + 2) % 3]);
  hull_corners(flat_, order_, corners_);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    out_.edges.push_back({ring_[corners_[i]], ring_[corners_[(i + 1) % corners_.size()]]});
  }
}

void Clipper::operator()(Polytope& polytope, int axis, double sign, double bound) {
  const auto side = [&](const Vec3& p) { return sign * p[axis] - bound; };
  if (std::all_of(polytope.points.begin(), polytope.points.end(), [&](const Vec3& p) { return side(p) >= 0.0; }))
    return;
  kept_.assign(polytope.points.size(), gone);
  ring_.clear();
  out_.points.clear();
  out_.edges.clear();
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const double s = side(polytope.points[i]);
    if (s < 0.0) continue;
    kept_[i] = static_cast<std::uint32_t>(out_.points.size());
    if (s == 0.0) ring_.push_back(kept_[i]);
    out_.points.push_back(polytope.points[i]);
  }
  for (const auto& [a, b] : polytope.edges) {
    if (kept_[a] == gone && kept_[b] == gone) continue;
    if (kept_[a] != gone && kept_[b] != gone) {
      out_.edges.push_back({kept_[a], kept_[b]});
      continue;
    }
    const std::uint32_t in = kept_[a] != gone ? a : b, out = kept_[a] != gone ? b : a;
    const Vec3 &p = polytope.points[in], &q = polytope.points[out];
    const double at = side(p);
    if (at == 0.0) continue;
    Vec3 corner = p + (at / (at - side(q))) * (q - p);
    corner[axis] = sign * bound;
    const auto next = static_cast<std::uint32_t>(out_.points.size());
    out_.points.push_back(corner);
    out_.edges.push_back({kept_[in], next});
    ring_.push_back(next);
  }
  add_ring(axis);
  std::swap(polytope, out_);
}

}  // namespace gridcull::extended
