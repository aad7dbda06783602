#include "gridcull/grid/silhouette_world.h"

#include "gridcull/grid/object_table.h"

namespace gridcull {
namespace {

/// Middle of the box around the shape's vertices, and the greatest distance from it.
LooseBall ball_around(const Shape& shape) {
  Bounds box;
  std::vector<Vec3> points = world_vertices(shape, Pose{});
  if (dimension_of(shape) == 2) {
    for (const Vec2& p : world_outline(shape, Pose{})) points.emplace_back(p, 0.0);
  }
  for (const Vec3& p : points) box.add(p);
  if (points.empty()) return {{}, reach_of(shape)};  // round
  LooseBall ball{box.centre(), 0.0};
  for (const Vec3& p : points) ball.radius = std::fmax(ball.radius, glm::length(p - ball.centre));
  return ball;
}

std::unique_ptr<SilhouetteWorld::Solid> make_solid(const Shape& shape) {
  Bounds box;
  for (const Vec3& p : world_vertices(shape, Pose{})) box.add(p);
  const Vec3 half = 0.5 * box.size() + Vec3(1e-8 * reach_of(shape));
  return std::make_unique<SilhouetteWorld::Solid>(
      SilhouetteWorld::Solid{make_occluder_pieces(shape), make_outer_hull(shape), box.centre(), half});
}

}  // namespace

void SilhouetteWorld::reserve(std::size_t slots) {
  index.reserve(slots);
  if (index.dimension() == 2) outlines.reserve(slots);
  if (slots > bodies_.capacity()) bodies_.reserve(slots + slots / 8);
  if (slots > bodies_.size()) bodies_.resize(slots);
}

void SilhouetteWorld::add(Slot slot, const Shape& shape) {
  Body& body = bodies_[slot];
  body.ball = ball_around(shape);
  const double reach = reach_of(shape);
  body.solid.reset();
  if (index.dimension() == 2) outlines.add(slot, shape);
  if (dimension_of(shape) == 3 && !std::holds_alternative<Sphere>(shape)) {
    body.solid = make_solid(shape);
  }
  body.centred = body.ball.radius > 0.75 * reach;
  if (body.centred)
    body.ball = {{}, reach};
  else
    body.ball.radius *= 1.0 + 1e-8;
}

void SilhouetteWorld::remove(Slot slot) {
  index.erase(slot);
  if (index.dimension() == 2) outlines.remove(slot);
  bodies_[slot] = {};
}

bool SilhouetteWorld::enter(Slot slot, const LooseBall& ball) {
  if (index.takes(ball)) {
    index.place(slot, ball);
    return true;
  }
  index.erase(slot);
  index.remember(slot, ball);
  return false;
}

bool SilhouetteWorld::near_seen(const LooseBall&, std::uint64_t) const { return false; }

std::uint64_t SilhouetteWorld::shape_bytes() const {
  std::uint64_t bytes = outlines.bytes() + bodies_.capacity() * sizeof(Body);
  for (const Body& body : bodies_) {
    if (body.solid) bytes += sizeof(Solid) + body.solid->pieces.bytes() + body.solid->outer.bytes();
  }
  return bytes;
}

}  // namespace gridcull
