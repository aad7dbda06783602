#include "gridcull/methods/extended_scene.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace gridcull::extended {
namespace {

constexpr std::uint32_t leaf_size = 2;

}  // namespace

void BoxTree::build(std::span<const Bounds> boxes) {
  nodes_.clear();
  items_.resize(boxes.size());
  std::iota(items_.begin(), items_.end(), 0u);
  if (boxes.empty()) return;
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(boxes.size()), 0});
  split(0, boxes);
}

void BoxTree::split(std::uint32_t node, std::span<const Bounds> boxes) {
  const std::uint32_t first = nodes_[node].first, count = nodes_[node].count;
  Bounds box, middles;
  for (std::uint32_t i = first; i < first + count; ++i) {
    box.add(boxes[items_[i]].min);
    box.add(boxes[items_[i]].max);
    middles.add(boxes[items_[i]].centre());
  }
  nodes_[node].box = box;
  if (count <= leaf_size) return;
  const Vec3 size = middles.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto begin = items_.begin() + first, half = begin + count / 2;
  std::nth_element(begin, half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double x = boxes[a].centre()[axis], y = boxes[b].centre()[axis];
    return x != y ? x < y : a < b;
  });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].left = left;
  nodes_.push_back({{}, first, count / 2, 0});
  nodes_.push_back({{}, first + count / 2, count - count / 2, 0});
  split(left, boxes);
  split(left + 1, boxes);
}

namespace {

/// The height at which most upright occluders stand; none where more than a tenth of the occludees reaches below it,
/// since those would never be hidden.
Floor choose_floor(const std::vector<Occluder>& occluders, const std::vector<Occludee>& occludees) {
  Floor floor;
  Bounds all;
  std::map<double, std::size_t> standing;
  for (const Occluder& o : occluders) {
    all.add(o.box.min);
    all.add(o.box.max);
    if (o.upright) ++standing[o.box.min.z];
  }
  std::size_t most = 0;
  for (const auto& [height, count] : standing) {
    if (count > most) most = count, floor.height = height;
  }
  const auto below =
      std::count_if(occludees.begin(), occludees.end(), [&](const Occludee& o) { return o.box.min.z < floor.height; });
  if (most == 0 || 10 * static_cast<std::size_t>(below) > occludees.size()) return {};
  // More than a row of any map: a map is at most 1.5 times as high as it is far away.
  floor.depth = glm::length(all.size());
  return floor;
}

}  // namespace

StaticScene make_static_scene(std::span<const Object* const> objects, double least_angle) {
  std::vector<const Object*> sorted;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(sorted),
               [](const Object* o) { return o->is_static; });
  std::sort(sorted.begin(), sorted.end(), [](const Object* a, const Object* b) { return a->id < b->id; });
  StaticScene scene;
  std::vector<Bounds> boxes, occluder_boxes;
  for (const Object* object : sorted) {
    scene.occludees.push_back(make_occludee(*object));
    boxes.push_back(scene.occludees.back().box);
    if (!object->occluder) continue;
    Occluder occluder = make_occluder(*object);
    if (occluder.pieces.empty()) continue;
    occluder_boxes.push_back(occluder.box);
    scene.occluders.push_back(std::move(occluder));
  }
  scene.floor = choose_floor(scene.occluders, scene.occludees);
  scene.tree.build(boxes);
  scene.worth.build(occluder_boxes, least_angle);
  return scene;
}

}  // namespace gridcull::extended
