// Every angle of the view volume lies in the range: margins of 1e-9 are far above the dozen roundings of 2^-53 that an
// angle takes. What the range holds too much the exact test against the view volume takes out again.
#include "gridcull/methods/five_d_query.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gridcull/core/trigonometry.h"

namespace gridcull {
namespace {

constexpr double margin = 1e-9;

bool ranges_meet(const ViewCell& range, int axis, double plane, bool far_side) {
  const auto k = static_cast<std::size_t>(axis);
  return far_side ? range.high[k] >= plane : range.low[k] <= plane;
}

}  // namespace

ViewRange::ViewRange(const View& view, const ViewVolume& volume, int dimension, double around) {
  ViewCell& first = parts_[0];
  for (int k = 0; k < 3; ++k) {
    const double at = view.pose.position[k], reach = around + margin * (1.0 + std::fabs(at));
    first.low[static_cast<std::size_t>(k)] = at - reach;
    first.high[static_cast<std::size_t>(k)] = at + reach;
  }
  first.low[turn_axis] = 0.0;
  first.high[turn_axis] = whole_turn;
  first.low[rise_axis] = -1.0;
  first.high[rise_axis] = 1.0;
  if (dimension == 2) {
    look_flat(view);
  } else if (view.frustum) {
    look_in_frustum(view, volume);
  }
}

/// Counter-clockwise from one to the other.
void ViewRange::set_turns(double from, double to) {
  from -= margin;
  to += margin;
  if (from <= to && from >= 0.0 && to <= whole_turn) {
    parts_[0].low[turn_axis] = from;
    parts_[0].high[turn_axis] = to;
    return;
  }
  if (from < 0.0) from += whole_turn;
  if (to > whole_turn) to -= whole_turn;
  parts_[1] = parts_[0];
  parts_[0].high[turn_axis] = to;
  parts_[1].low[turn_axis] = from;
  count_ = 2;
}

void ViewRange::look_flat(const View& view) {
  if (view.fov > 2.0 * std::numbers::pi - 1e-6) return;
  const Rotation axes = rotation_of(view.pose.orientation);
  const SinCos half = stable_sincos(0.5 * view.fov);
  set_turns(turn_of(half.cos * axes.x - half.sin * axes.y), turn_of(half.cos * axes.x + half.sin * axes.y));
}

// Turns: along a great circle the azimuth grows or falls all the way, so on a frustum that does not hold the zenith or
// the nadir the corners have the extreme ones. Rises: a cone about the axis through the farthest corner holds it all.
void ViewRange::look_in_frustum(const View& view, const ViewVolume& volume) {
  const Rotation axes = rotation_of(view.pose.orientation);
  const SinCos half = stable_sincos(0.5 * view.frustum->fov_y);
  const double up = half.sin / half.cos, left = up * view.frustum->aspect;
  double cosine = 1.0;
  Vec3 leftmost = axes.x, rightmost = axes.x;
  bool all_turns = false;
  for (const double z : {-up, up}) {
    for (const double y : {-left, left}) {
      const Vec3 corner = axes.x + y * axes.y + z * axes.z;
      cosine = std::min(cosine, glm::dot(axes.x, corner) / glm::length(corner));
      if (cross2(Vec2(leftmost), Vec2(corner)) > 0.0) leftmost = corner;
      if (cross2(Vec2(rightmost), Vec2(corner)) < 0.0) rightmost = corner;
      // Nearly a quarter turn from the axis or more: the zenith or nadir may be near, and crossings lose their sign.
      if (!(glm::dot(Vec2(axes.x), Vec2(corner)) > 1e-6 * glm::length(corner))) all_turns = true;
    }
  }
  for (const double pole : {-1.0, 1.0}) {
    const bool inside = std::all_of(volume.begin(), volume.end(),
                                    [pole](const HalfSpace& side) { return pole * side.normal.z >= -1e-6; });
    all_turns = all_turns || inside;
  }
  if (!all_turns) set_turns(turn_of(rightmost), turn_of(leftmost));
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double rise = std::clamp(axes.x.z, -1.0, 1.0), level = std::sqrt(1.0 - rise * rise);
  for (int i = 0; i < count_; ++i) {
    ViewCell& part = parts_[static_cast<std::size_t>(i)];
    if (rise < cosine) part.high[rise_axis] = std::min(1.0, rise * cosine + level * sine + margin);
    if (-rise < cosine) part.low[rise_axis] = std::max(-1.0, rise * cosine - level * sine - margin);
  }
}

void find_members(const FiveDTree& tree, const FiveDSpace& space, const ViewRange& range,
                  std::span<std::uint64_t> members, std::vector<std::uint32_t>& stack, std::uint64_t& nodes) {
  std::ranges::fill(members, 0);
  for (const ViewCell& part : range.parts()) {
    stack.assign(1, 0);
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      ++nodes;
      const FiveDNode& node = tree.nodes[i];
      if (node.axis == FiveDNode::leaf) {
        const auto set = tree.set(space, node.second);
        for (std::size_t w = 0; w < members.size(); ++w) members[w] |= set[w];
        continue;
      }
      const double plane = space.plane(node.axis, node.step);
      if (ranges_meet(part, node.axis, plane, true)) stack.push_back(node.second);
      if (ranges_meet(part, node.axis, plane, false)) stack.push_back(i + 1);
    }
  }
}

}  // namespace gridcull
