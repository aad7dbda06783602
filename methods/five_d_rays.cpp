#include "gridcull/methods/five_d_rays.h"

#include <algorithm>

namespace gridcull {
namespace {

constexpr std::size_t origins = 256;  ///< of a cell; each serves many targets

bool limited(const FiveDScene& scene, const ViewCell& cell, int axis) {
  const auto k = static_cast<std::size_t>(axis);
  const FiveDSpace& space = scene.space();
  return space.has(axis) && (cell.low[k] > space.low(axis) || cell.high[k] < space.high(axis));
}

/// Directions that begin the eighths: 0, 45, 90 ... degrees.
constexpr std::array<std::array<double, 2>, 8> eighth{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

}  // namespace

CellRays::CellRays(const FiveDScene& scene, const ViewCell& cell, std::uint64_t seed, FiveDScene::Scratch& scratch)
    : scene_(scene),
      cell_(cell),
      scratch_(scratch),
      random_(seed),
      turns_(limited(scene, cell, turn_axis)),
      rises_(limited(scene, cell, rise_axis)) {
  for (std::size_t i = 0; i < origins; ++i) {
    Vec3 p(random_.uniform(cell.low[0], cell.high[0]), random_.uniform(cell.low[1], cell.high[1]), 0.0);
    if (scene.space().dimension == 3) p.z = random_.uniform(cell.low[2], cell.high[2]);
    if (scene.is_free(p, scratch)) origins_.push_back(p);
  }
  scratch.last = FiveDScene::nobody;
}

// Differences of two boxes' points fill a box. It misses an eighth, which is convex, when all its corners lie on the
// far side of one of its two borders.
unsigned CellRays::eighths(std::uint32_t member) const {
  const Bounds& b = scene_.box(member);
  const double x0 = b.min.x - cell_.high[0], x1 = b.max.x - cell_.low[0];
  const double y0 = b.min.y - cell_.high[1], y1 = b.max.y - cell_.low[1];
  const auto all_right = [&](const std::array<double, 2>& d, double side) {
    // cross(d, corner) * side < 0 at all corners
    for (const double x : {x0, x1}) {
      for (const double y : {y0, y1}) {
        if (!((d[0] * y - d[1] * x) * side < 0.0)) return false;
      }
    }
    return true;
  };
  unsigned out = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    if (static_cast<double>(k) >= cell_.high[turn_axis] || static_cast<double>(k + 1) <= cell_.low[turn_axis]) continue;
    if (all_right(eighth[k], 1.0) || all_right(eighth[(k + 1) % 8], -1.0)) continue;
    out |= 1u << k;
  }
  return out;
}

bool CellRays::aim(std::uint32_t member, KeptRay& ray) {
  from_ = origins_[next_++ % origins_.size()];
  to_ = scene_.target(member, random_);
  const Vec3 d = to_ - from_;
  const double turn = turn_of(d), rise = scene_.space().dimension == 3 ? rise_of(d) : 0.0;
  if (turns_ && (turn < cell_.low[turn_axis] || turn > cell_.high[turn_axis])) return false;
  if (rises_ && (rise < cell_.low[rise_axis] || rise > cell_.high[rise_axis])) return false;
  ray.at = {static_cast<float>(from_.x), static_cast<float>(from_.y), static_cast<float>(from_.z),
            static_cast<float>(turn), static_cast<float>(rise)};
  ray.member = member;
  return true;
}

void CellRays::cast(KeptRay& ray) {
  ++count_;
  ray.hit = !scene_.blocked(from_, to_, ray.member, scratch_);
}

}  // namespace gridcull
