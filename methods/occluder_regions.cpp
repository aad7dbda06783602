#include "gridcull/methods/occluder_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridcull {
namespace {

/// Steradians (2D: radians).
constexpr double least_angle = 1e-3;

/// Sebastiano Vigna's splitmix64: 0 <= result < 1.
double next_unit(std::uint64_t& state) {
  std::uint64_t z = state += 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

void count_below(const BoxTree& tree, std::uint32_t at, std::span<const Bounds> boxes, const ShadowFrustum& frustum,
                 const Vec3& eye, std::uint64_t& count) {
  const BoxTree::Node& node = tree.node(at);
  std::uint64_t tests = 0;
  const Overlap place = frustum.overlap(SightBox(node.box, eye), tests);
  if (place == Overlap::outside) return;
  if (place == Overlap::inside) {
    count += node.count;
    return;
  }
  if (node.right == 0) {
    for (const std::uint32_t item : tree.names(node)) {
      if (frustum.overlap(SightBox(boxes[item], eye), tests) == Overlap::inside) ++count;
    }
    return;
  }
  count_below(tree, at + 1, boxes, frustum, eye, count);
  count_below(tree, node.right, boxes, frustum, eye, count);
}

}  // namespace

std::uint64_t count_hidden(const BoxTree& tree, std::span<const Bounds> boxes, const ShadowFrustum& frustum,
                           const Vec3& eye) {
  std::uint64_t count = 0;
  if (!tree.empty()) count_below(tree, 0, boxes, frustum, eye, count);
  return count;
}

double greatest_area_angle(const ShadowWorld& world, const PartEntry& entry, const Bounds& box) {
  const OccluderPart& part = *entry.part;
  const Vec3 sight = world.sight_of(entry, box.centre()), half = 0.5 * box.size();
  double square = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::fmax(0.0, std::fabs(sight[k]) - half[k]);
    square += gap * gap;
  }
  const double nearest = std::sqrt(square);
  if (nearest <= part.radius) return std::numeric_limits<double>::infinity();
  double area = part.kind == OccluderPart::Kind::ball ? part.area.x : glm::length(part.area);
  if (part.kind == OccluderPart::Kind::face || part.kind == OccluderPart::Kind::wall) {
    const Vec3 normal = world.object(entry.place).rotation * part.area;
    const double along = std::fabs(glm::dot(normal, sight)) + std::fabs(normal.x) * half.x +
                         std::fabs(normal.y) * half.y + std::fabs(normal.z) * half.z;
    area = std::fmin(area, along / nearest);
  }
  return area / (part.flat ? nearest : square);
}

void OccluderRegions::begin_frame(const ShadowWorld& world) {
  // Static entries come first in the world's list: movers that come and go leave their numbers alone.
  if (static_version_ == world.static_version()) return;
  static_version_ = world.static_version();
  regions_.clear();
  worked_out_ = 0;
  if (world.static_count() == 0 || world.static_tree().empty()) return;
  box_ = world.static_tree().node(0).box;
  const Vec3 size = box_.size();
  const double edge = std::max({size.x, size.y, size.z}) / most_along_an_axis;
  std::size_t count = 1;
  for (int k = 0; k < 3; ++k) {
    cells_[k] = std::clamp(static_cast<int>(std::floor(size[k] / edge)), 1, most_along_an_axis);
    count *= static_cast<std::size_t>(cells_[k]);
  }
  regions_.resize(count);
}

const std::vector<OccluderRegions::Promise>* OccluderRegions::at(const ShadowWorld& world, const Vec3& eye) {
  if (regions_.empty()) return nullptr;
  std::size_t number = 0;
  Bounds box;
  for (int k = 2; k >= 0; --k) {
    if (!(box_.min[k] <= eye[k] && eye[k] <= box_.max[k])) return nullptr;
    const double edge = (box_.max[k] - box_.min[k]) / cells_[k];
    const int cell = edge > 0.0 ? std::min(static_cast<int>((eye[k] - box_.min[k]) / edge), cells_[k] - 1) : 0;
    number = number * static_cast<std::size_t>(cells_[k]) + static_cast<std::size_t>(cell);
    box.min[k] = box_.min[k] + cell * edge;
    box.max[k] = box.min[k] + edge;
  }
  if (!regions_[number].known) work_out(world, number, box);
  return &regions_[number].promises;
}

void OccluderRegions::work_out(const ShadowWorld& world, std::size_t number, const Bounds& box) {
  Region& region = regions_[number];
  region.known = true;
  ++worked_out_;
  std::vector<std::pair<double, std::uint32_t>> able;  // negative angle: the best first, then by entry
  const auto entries = world.static_entries();
  for (std::uint32_t i = 0; i < entries.size(); ++i) {
    const double angle = greatest_area_angle(world, entries[i], box);
    if (angle > least_angle) able.emplace_back(-angle, i);
  }
  const std::size_t kept = std::min(able.size(), most_parts);
  std::partial_sort(able.begin(), able.begin() + static_cast<std::ptrdiff_t>(kept), able.end());
  able.resize(kept);
  std::uint64_t state = number;
  std::vector<Vec3> viewpoints;
  for (int i = 0; i < samples; ++i) {
    const double x = next_unit(state), y = next_unit(state), z = next_unit(state);
    viewpoints.push_back(box.min + Vec3(x, y, z) * box.size());
  }
  for (const auto& [angle, entry] : able) {
    region.promises.push_back({entry, sampled(world, entries[entry], viewpoints)});
  }
  std::sort(region.promises.begin(), region.promises.end(),
            [](const Promise& a, const Promise& b) { return a.entry < b.entry; });
}

double OccluderRegions::sampled(const ShadowWorld& world, const PartEntry& entry, std::span<const Vec3> viewpoints) {
  const FlatObject& flat = world.object(entry.place);
  std::uint64_t hidden = 0;
  for (const Vec3& eye : viewpoints) {
    SilhouetteTrack track;
    if (!frustum_.build(*entry.part, flat.object.pose, flat.rotation, eye, track)) continue;
    hidden += count_hidden(world.static_tree(), world.boxes(), frustum_, eye);
  }
  const double all = static_cast<double>(world.static_tree().node(0).count);
  return static_cast<double>(hidden) / (all * static_cast<double>(viewpoints.size()));
}

}  // namespace gridcull
