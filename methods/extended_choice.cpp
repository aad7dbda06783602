#include "gridcull/methods/extended_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gridcull::extended {
namespace {

constexpr int most_depth = 18;
constexpr std::size_t small_enough = 16;  // occluders that a leaf may name without being everywhere in it

bool overlap(const Bounds& a, const Bounds& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.min[k] > b.max[k] || b.min[k] > a.max[k]) return false;
  }
  return true;
}
bool inside(const Bounds& a, const Bounds& b) {
  for (int k = 0; k < 3; ++k) {
    if (a.min[k] < b.min[k] || a.max[k] > b.max[k]) return false;
  }
  return true;
}

}  // namespace

double solid_angle(const Bounds& box, const Vec3& from) {
  const Vec3 d = from - box.centre(), size = box.size();
  const double square = glm::dot(d, d);
  const Vec3 a = glm::abs(d);
  const double area = size.y * size.z * a.x + size.x * size.z * a.y + size.x * size.y * a.z;  // times |d|
  const double cube = square * std::sqrt(square);
  return cube > 0.0 ? std::min(area / cube, 2.0 * std::numbers::pi) : 2.0 * std::numbers::pi;
}

void ChoiceTree::build(std::span<const Bounds> boxes, double least_angle) {
  regions_.clear();
  nodes_.assign(1, {});
  std::vector<std::uint32_t> all;
  for (const Bounds& b : boxes) {
    // Never more across a line of sight than half of the box's surface.
    const Vec3 s = b.size();
    const double reach = std::sqrt((s.x * s.y + s.x * s.z + s.y * s.z) / least_angle);
    regions_.push_back({b.centre() - Vec3(reach), b.centre() + Vec3(reach)});
    nodes_[0].box.add(regions_.back().min);
    nodes_[0].box.add(regions_.back().max);
    all.push_back(static_cast<std::uint32_t>(all.size()));
  }
  if (!all.empty()) split(0, std::move(all), 0);
}

void ChoiceTree::split(std::uint32_t node, std::vector<std::uint32_t> candidates, int depth) {
  const Bounds box = nodes_[node].box;
  const auto everywhere = [&](std::uint32_t i) { return inside(box, regions_[i]); };
  const auto rest = std::stable_partition(candidates.begin(), candidates.end(), everywhere);
  if (static_cast<std::size_t>(candidates.end() - rest) <= small_enough || depth == most_depth) {
    nodes_[node].worth = std::move(candidates);
    return;
  }
  nodes_[node].worth.assign(candidates.begin(), rest);
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  // The median of the regions' ends within the box.
  std::vector<double> ends;
  for (auto i = rest; i != candidates.end(); ++i) {
    for (const double end : {regions_[*i].min[axis], regions_[*i].max[axis]}) {
      if (end > box.min[axis] && end < box.max[axis]) ends.push_back(end);
    }
  }
  double at = 0.5 * (box.min[axis] + box.max[axis]);
  if (!ends.empty()) {
    const auto middle = ends.begin() + static_cast<std::ptrdiff_t>(ends.size() / 2);
    std::nth_element(ends.begin(), middle, ends.end());
    at = *middle;
  }
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].left = left;
  nodes_.resize(nodes_.size() + 2);
  for (const std::uint32_t side : {0u, 1u}) {
    Bounds half = box;
    (side == 0 ? half.max : half.min)[axis] = at;
    nodes_[left + side].box = half;
    std::vector<std::uint32_t> here;
    std::copy_if(rest, candidates.end(), std::back_inserter(here),
                 [&](std::uint32_t i) { return overlap(regions_[i], half); });
    split(left + side, std::move(here), depth + 1);
  }
}

void ChoiceTree::find(const Bounds& cell, std::vector<std::uint32_t>& out) const {
  if (regions_.empty()) return;
  const std::size_t before = out.size();
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const Node& node = nodes_[open.back()];
    open.pop_back();
    if (!overlap(node.box, cell)) continue;
    for (const std::uint32_t i : node.worth) {
      if (overlap(regions_[i], cell)) out.push_back(i);
    }
    if (node.left != 0) open.insert(open.end(), {node.left, node.left + 1});
  }
  const auto begin = out.begin() + static_cast<std::ptrdiff_t>(before);
  std::sort(begin, out.end());
  out.erase(std::unique(begin, out.end()), out.end());
}

}  // namespace gridcull::extended
