#include "gridcull/grid/silhouette_world.h"

#include <algorithm>

#include "gridcull/grid/bound_piece.h"
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

std::array<double, 3> key_of(const Vec3& size) { return {size.x, size.y, size.z}; }

std::vector<Vec3> vertices_of(const ConvexPiece& piece) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < piece.vertex_count(); ++i) points.push_back(piece.vertex(i));
  return points;
}

/// 255ths of `whole`, rounded up by more than a quaternion's length may be off (SilhouetteWorld::ball_at()).
std::uint8_t part_of(double length, double whole) {
  return static_cast<std::uint8_t>(std::fmin(255.0, std::floor(255.0 * (length / whole) * (1.0 + 1e-6)) + 1.0));
}

/// The box around these points, or as good as around them.
void set_box(SilhouetteWorld::Solid& solid, const std::vector<Vec3>& points, double reach) {
  Bounds box;
  for (const Vec3& p : points) box.add(p);
  solid.box_centre = box.centre();
  solid.box_half = 0.5 * box.size() + Vec3(1e-8 * reach);
}

}  // namespace

std::unique_ptr<SilhouetteWorld::Solid> SilhouetteWorld::make_solid(const Shape& shape) const {
  const bool ball = std::holds_alternative<Sphere>(shape);
  if (ball && (!bound_ || *bound_ == BoundKind::sphere || *bound_ == BoundKind::hull)) return nullptr;
  auto solid = std::make_unique<Solid>();
  solid->pieces = make_occluder_pieces(shape);
  if (!bound_) {
    solid->outer = make_outer_hull(shape);
    set_box(*solid, world_vertices(shape, Pose{}), reach_of(shape));
  } else if (*bound_ == BoundKind::sphere) {
    const Ball around = bound_of(shape, BoundKind::sphere).ball;
    solid->ball = {around.centre, around.radius};
  } else {
    solid->outer = bound_piece(shape, *bound_);
    // Without a piece the object counts as visible unless its box is hidden.
    const bool missing = solid->outer.empty();
    set_box(*solid, missing ? bound_of(shape, BoundKind::box).boundary.vertices : vertices_of(solid->outer),
            reach_of(shape));
  }
  return solid;
}

std::shared_ptr<const SilhouetteWorld::Solid> SilhouetteWorld::solid_of(const Shape& shape) {
  const auto* box = std::get_if<Cuboid>(&shape);
  if (box == nullptr) return make_solid(shape);
  std::weak_ptr<const Solid>& kept = boxes_[key_of(box->size)];
  if (std::shared_ptr<const Solid> solid = kept.lock()) return solid;
  std::unique_ptr<Solid> solid = make_solid(shape);
  solid->size = box->size;
  std::shared_ptr<const Solid> shared = std::move(solid);
  kept = shared;
  return shared;
}

void SilhouetteWorld::reserve(std::size_t slots) {
  index.reserve(slots);
  if (index.dimension() == 2) outlines.reserve(slots);
  if (slots > bodies_.capacity()) bodies_.reserve(slots + slots / 8);
  if (slots > bodies_.size()) bodies_.resize(slots);
}

void SilhouetteWorld::add(Slot slot, const Shape& shape, bool occluder) {
  Body& body = bodies_[slot];
  body.ball = ball_around(shape);
  const double reach = reach_of(shape);
  body.solid.reset();
  if (index.dimension() == 2) outlines.add(slot, shape);
  if (dimension_of(shape) == 3) body.solid = solid_of(shape);
  body.centred = body.ball.radius > 0.75 * reach;
  if (body.centred)
    body.ball = {{}, reach};
  else
    body.ball.radius *= 1.0 + 1e-8;
  index.set_marks(slot, static_cast<std::uint8_t>((body.centred ? is_centred : 0) | (body.solid ? 0 : is_ball) |
                                                  (occluder ? is_occluder : 0)));
  set_filling(slot, shape);
}

// Turned about +z an object keeps the heights of its points over its ball's centre, and their distances beside it.
void SilhouetteWorld::set_filling(Slot slot, const Shape& shape) {
  const LooseBall& ball = bodies_[slot].ball;
  index.set_filling(slot, 255, 255);
  if (dimension_of(shape) == 2) return;
  double wide = 0.0, tall = 0.0;
  for (const Vec3& p : world_vertices(shape, Pose{})) {
    const Vec3 off = p - ball.centre;
    wide = std::fmax(wide, std::sqrt(off.x * off.x + off.y * off.y));
    tall = std::fmax(tall, std::fabs(off.z));
  }
  if (!(wide > 0.0 || tall > 0.0)) return;  // round
  index.set_filling(slot, part_of(wide, ball.radius), part_of(tall, ball.radius));
  index.set_marks(slot, index.marks(slot) | has_filling);
}

void SilhouetteWorld::remove(Slot slot) {
  leave(slot);
  if (index.dimension() == 2) outlines.remove(slot);
  const std::shared_ptr<const Solid>& solid = bodies_[slot].solid;
  if (solid.use_count() == 1) boxes_.erase(key_of(solid->size));
  bodies_[slot] = {};
}

bool SilhouetteWorld::enter(Slot slot, LooseBall ball, double room) {
  if (index.takes(ball)) {
    index.place(slot, ball, room);
    return true;
  }
  index.erase(slot);
  index.remember(slot, ball);
  return false;
}

// A disc's box is rounded by less than it is grown when it is asked about (sight_2d.h).
Box2D SilhouetteWorld::box_of(Slot slot) const {
  const Placed2D& object = outlines.at(slot);
  if (object.outline == nullptr) return {object.centre - Vec2(object.radius), object.centre + Vec2(object.radius)};
  Box2D box{object.points[0], object.points[0]};
  for (std::size_t i = 1, count = object.outline->points().size(); i < count; ++i) {
    box.low = glm::min(box.low, object.points[i]);
    box.high = glm::max(box.high, object.points[i]);
  }
  return box;
}

void SilhouetteWorld::note_static(Slot slot) {
  const std::uint8_t marks = index.marks(slot);
  if ((marks & is_unsettled) != 0 || !index.holds(slot)) return;
  if (unsettled_.size() >= 2 * marked_ + few_statics) forget_unmarked();
  unsettled_.push_back(slot);
  index.set_marks(slot, marks | is_unsettled);
  ++marked_;
}

void SilhouetteWorld::settle() {
  ++age_;
  if (!worth_settling()) return;
  for (const Slot slot : unsettled_) {
    if (!index.holds(slot)) unmark(slot);  // moved out of the lattice
  }
  build_rows();
}

// A slot that was used again may be there twice.
void SilhouetteWorld::forget_unmarked() {
  std::erase_if(unsettled_, [&](Slot slot) { return (index.marks(slot) & is_unsettled) == 0; });
  std::sort(unsettled_.begin(), unsettled_.end());
  unsettled_.erase(std::unique(unsettled_.begin(), unsettled_.end()), unsettled_.end());
}

// Nobody leaves the index before the rows are there: whoever runs out of memory here has lost nothing.
void SilhouetteWorld::build_rows() {
  forget_unmarked();
  std::vector<StaticRows2D::Member> members;
  members.reserve(rows.size() + unsettled_.size());
  rows.for_each([&](Slot slot, bool occluder, const Box2D& box) { members.push_back({slot, occluder, box}); });
  for (const Slot slot : unsettled_) members.push_back({slot, (index.marks(slot) & is_occluder) != 0, box_of(slot)});
  StaticRows2D all;
  all.build(members);
  std::swap(rows, all);
  for (const Slot slot : unsettled_) {
    unmark(slot);
    index.erase(slot);
  }
  unsettled_.clear();
  age_ = 0;
}

std::uint64_t SilhouetteWorld::shape_bytes() const {
  std::uint64_t bytes =
      outlines.bytes() + rows.bytes() + unsettled_.capacity() * sizeof(Slot) + bodies_.capacity() * sizeof(Body);
  for (const Body& body : bodies_) {
    if (!body.solid) continue;
    const std::uint64_t all = sizeof(Solid) + body.solid->pieces.bytes() + body.solid->outer.bytes();
    bytes += all / static_cast<std::uint64_t>(body.solid.use_count());
  }
  return bytes;
}

}  // namespace gridcull
