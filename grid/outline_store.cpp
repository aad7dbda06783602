#include "gridcull/grid/outline_store.h"

namespace gridcull {

void OutlineStore::reserve(std::size_t slots) {
  if (slots > bodies_.capacity()) bodies_.reserve(slots + slots / 8);
  if (slots > bodies_.size()) bodies_.resize(slots);
}

std::shared_ptr<const OutlineStore::Kept> OutlineStore::kept_for(const Shape& shape) {
  const auto* rectangle = std::get_if<Rectangle>(&shape);
  if (rectangle == nullptr) return std::make_shared<const Kept>(Kept{Outline2D(shape)});
  const Size size{rectangle->size.x, rectangle->size.y};
  std::weak_ptr<const Kept>& known = rectangles_[size];
  std::shared_ptr<const Kept> kept = known.lock();
  if (!kept) known = kept = std::make_shared<const Kept>(Kept{Outline2D(shape), size});
  return kept;
}

void OutlineStore::add(Slot slot, const Shape& shape) {
  Body& body = bodies_[slot];
  body = {};
  if (const auto* disc = std::get_if<Disc>(&shape)) {
    body.placed.radius = disc->radius;
  } else {
    body.kept = kept_for(shape);
    const std::size_t count = body.kept->outline.points().size();
    if (count > FewPoints{}.points.size()) {
      body.many = std::make_unique<Vec2[]>(count);
    } else {
      make_block(slot / in_block);
    }
  }
}

void OutlineStore::make_block(std::size_t block) {
  if (block >= few_.size()) few_.resize(block + 1);
  if (!few_[block]) few_[block] = std::make_unique<FewPoints[]>(in_block);
}

void OutlineStore::remove(Slot slot) {
  const std::shared_ptr<const Kept>& kept = bodies_[slot].kept;
  if (kept.use_count() == 1) rectangles_.erase(kept->size);
  bodies_[slot] = {};
}

void OutlineStore::place(Slot slot, const Pose& pose) {
  Body& body = bodies_[slot];
  if (!body.kept) {
    body.placed.centre = Vec2(pose.position);
    return;
  }
  Vec2* const points = points_of(slot);
  body.kept->outline.place(pose, points);
  body.placed = placed(body.kept->outline, pose, points);
}

Placed2D OutlineStore::place(Slot slot, const Pose& pose, std::vector<Vec2>& points) const {
  const Body& body = bodies_[slot];
  if (!body.kept) return {nullptr, Vec2(pose.position), body.placed.radius, nullptr};
  points.resize(body.kept->outline.points().size());
  body.kept->outline.place(pose, points.data());
  return placed(body.kept->outline, pose, points.data());
}

std::uint64_t OutlineStore::bytes() const {
  std::uint64_t bytes = bodies_.capacity() * sizeof(Body);
  for (const auto& block : few_) bytes += block ? in_block * sizeof(FewPoints) : 0;
  for (const Body& body : bodies_) {
    if (!body.kept) continue;
    const std::uint64_t shared = sizeof(Kept) + body.kept->outline.bytes();
    bytes += shared / static_cast<std::uint64_t>(body.kept.use_count());
    if (body.many) bytes += body.kept->outline.points().size() * sizeof(Vec2);
  }
  return bytes;
}

}  // namespace gridcull
