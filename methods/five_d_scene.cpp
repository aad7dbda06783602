#include "gridcull/methods/five_d_scene.h"

#include <algorithm>
#include <cmath>

namespace gridcull {
namespace {

std::vector<const Object*> sorted_statics(std::span<const Object> objects) {
  std::vector<const Object*> statics;
  for (const Object& object : objects) {
    if (object.is_static) statics.push_back(&object);
  }
  std::sort(statics.begin(), statics.end(), [](const Object* a, const Object* b) { return a->id < b->id; });
  return statics;
}

Bounds joined(Bounds a, const Bounds& b) {
  if (!b.empty()) a.add(b.min), a.add(b.max);
  return a;
}

/// The box of all moving objects.
Bounds mover_heights(std::span<const Object> objects) {
  FlatWorld movers(3);
  Bounds out;
  for (const Object& object : objects) {
    if (!object.is_static) movers.add(object);
  }
  for (const FlatObject& flat : movers.objects()) out = joined(out, flat.box);
  return out;
}

/// What was asked for; where nothing was, the heights at which something moves: there viewers ride and walk.
void limit_heights(Bounds& positions, const Bounds& movers, const FiveDOptions& options) {
  const FiveDOptions standard;
  const bool asked = options.low != standard.low || options.high != standard.high;
  if (!asked && movers.empty()) return;
  const double low = std::max(positions.min.z, asked ? options.low : movers.min.z);
  const double high = std::min(positions.max.z, asked ? options.high : movers.max.z);
  if (low < high) positions.min.z = low, positions.max.z = high;
}

}  // namespace

FiveDScene::FiveDScene(std::span<const Object> objects, int dimension, const Bounds& bounds,
                       const FiveDOptions& options)
    : world_(dimension) {
  for (const Object* object : sorted_statics(objects)) world_.add(*object);
  Bounds all;
  std::vector<BucketGrid::Item> items;
  for (std::uint32_t i = 0; i < world_.objects().size(); ++i) {
    const FlatObject& flat = world_.objects()[i];
    all = joined(all, flat.box);
    boxes_.push_back(flat.box);
    surfaces_.emplace_back(flat.local);
    if (flat.object.occluder) items.push_back({flat.box, i});
  }
  grid_.build(items, all, dimension);
  space_.dimension = dimension;
  space_.bits = options.bits;
  space_.statics = static_cast<std::uint32_t>(world_.objects().size());
  const Bounds world = bounds.empty() ? all : bounds;
  const Bounds heights = dimension == 3 ? mover_heights(objects) : Bounds{};
  space_.positions = world;
  if (dimension == 3) limit_heights(space_.positions, heights, options);
  place_boxes(world, heights, options.boxes);
}

// Boxes as cubic as their number allows, over the ground plan of the world and the heights at which something moves.
void FiveDScene::place_boxes(const Bounds& world, const Bounds& heights, int wanted) {
  if (wanted == 0 || world.empty()) return;
  space_.region = world;
  if (!heights.empty()) {
    space_.region.min.z = heights.min.z;
    space_.region.max.z = heights.max.z;
  }
  const Vec3 size = space_.region.size();
  const int axes = space_.dimension;
  // The greatest edge at which the boxes are as many as wanted, halving towards it: no root, whose last bit may differ.
  const auto counts = [&](double edge) {
    std::array<double, 3> n{1, 1, 1};
    for (int k = 0; k < axes; ++k) n[static_cast<std::size_t>(k)] = std::max(1.0, std::floor(size[k] / edge + 0.5));
    return n;
  };
  double edge = std::max({size.x, size.y, axes == 3 ? size.z : 0.0, 1e-9});
  for (double factor = 0.5; factor > 0.001; factor *= 0.5) {
    for (;;) {
      const auto n = counts(edge * (1.0 - factor));
      if (n[0] * n[1] * n[2] > wanted) break;
      edge *= 1.0 - factor;
      if (edge < 1e-9) return;
    }
  }
  const auto n = counts(edge);
  for (std::size_t k = 0; k < 3; ++k) space_.boxes[k] = static_cast<std::uint32_t>(n[k]);
  for (std::uint32_t b = 0; b < space_.box_count(); ++b) boxes_.push_back(space_.box(b));
}

bool FiveDScene::is_free(const Vec3& point, Scratch& scratch) const {
  scratch.near.clear();
  scratch.holders.clear();
  grid_.near({point, point}, [&scratch](std::uint32_t i) { scratch.near.push_back(i); });
  world_.add_holders(point, scratch.near, scratch.holders);
  return scratch.holders.empty();
}

Vec3 FiveDScene::target(std::uint32_t member, Random& random) const {
  if (member >= space_.statics) {
    const Bounds& b = boxes_[member];
    return {random.uniform(b.min.x, b.max.x), random.uniform(b.min.y, b.max.y), random.uniform(b.min.z, b.max.z)};
  }
  const FlatObject& flat = world_.objects()[member];
  return flat.object.pose.position + flat.rotation * surfaces_[member].at(flat.local, random);
}

bool FiveDScene::blocks(std::uint32_t i, const Vec3& from, const Vec3& along, Scratch& scratch) const {
  const FlatObject& flat = world_.objects()[i];
  const Vec3 middle = flat.centre - from;
  const double square = glm::dot(along, along);
  const double t = square > 0.0 ? std::clamp(glm::dot(middle, along) / square, 0.0, 1.0) : 0.0;
  const Vec3 off = middle - t * along;
  if (glm::dot(off, off) > flat.radius * flat.radius) return false;
  const Vec3 d = from - flat.object.pose.position;
  if (flat.local.kind == LocalShape::Kind::ball) return blocks_segment(flat.local, d, along, scratch.cuts);
  return blocks_segment(flat.local, flat.rotation.inverse(d), flat.rotation.inverse(along), scratch.cuts);
}

// Rays from one cell at one object are mostly blocked by the same occluder: it is tried first.
bool FiveDScene::blocked(const Vec3& from, const Vec3& to, std::uint32_t member, Scratch& scratch) const {
  const Vec3 along = to - from;
  if (scratch.last != nobody && scratch.last != member && blocks(scratch.last, from, along, scratch)) return true;
  return grid_.walk(from, along, scratch.buckets, [&](std::uint32_t i) {
    if (i == member || i == scratch.last || !blocks(i, from, along, scratch)) return false;
    scratch.last = i;
    return true;
  });
}

}  // namespace gridcull
