#include "gridcull/grid/outline_store.h"

namespace gridcull {

void OutlineStore::reserve(std::size_t slots) {
  if (slots > bodies_.capacity()) bodies_.reserve(slots + slots / 8);
  if (slots > bodies_.size()) bodies_.resize(slots);
}

void OutlineStore::add(Slot slot, const Shape& shape) {
  Body& body = bodies_[slot];
  body = {};
  if (const auto* disc = std::get_if<Disc>(&shape)) {
    body.placed.radius = disc->radius;
  } else {
    body.detail = std::make_unique<Detail>(shape);
  }
}

void OutlineStore::place(Slot slot, const Pose& pose) {
  Body& body = bodies_[slot];
  if (!body.detail) {
    body.placed.centre = Vec2(pose.position);
    return;
  }
  Detail& detail = *body.detail;
  detail.outline.place(pose, detail.points.data());
  body.placed = placed(detail.outline, pose, detail.points.data());
}

Placed2D OutlineStore::place(Slot slot, const Pose& pose, std::vector<Vec2>& points) const {
  const Body& body = bodies_[slot];
  if (!body.detail) return {nullptr, Vec2(pose.position), body.placed.radius, nullptr};
  const Outline2D& outline = body.detail->outline;
  points.resize(outline.points().size());
  outline.place(pose, points.data());
  return placed(outline, pose, points.data());
}

std::uint64_t OutlineStore::bytes() const {
  std::uint64_t bytes = bodies_.capacity() * sizeof(Body);
  for (const Body& body : bodies_) {
    if (body.detail) {
      bytes += sizeof(Detail) + body.detail->outline.bytes() + body.detail->points.capacity() * sizeof(Vec2);
    }
  }
  return bytes;
}

}  // namespace gridcull
