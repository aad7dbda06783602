#include "gridcull/methods/extended_outlook.h"

#include <algorithm>
#include <cmath>

namespace gridcull::extended {
namespace {

double size_of(const Vec3& p) { return std::fabs(p.x) + std::fabs(p.y) + std::fabs(p.z); }

/// A difference and a turn: below 10 roundings of 2^-53 of the point's distance from the cell; the world's coordinates
/// count once more because whoever judges has rounded them too.
Bounds grown(const Bounds& box, double world) {
  const Vec3 by(1e-14 * (size_of(box.min) + size_of(box.max)) + 1e-15 * world);
  return {box.min - by, box.max + by};
}

bool meets(const Bounds& box, const Vec3& half) {
  for (int k = 0; k < 3; ++k) {
    if (box.min[k] > half[k] || box.max[k] < -half[k]) return false;
  }
  return true;
}

/// Two halves of the longest side, parted at the cell's side where that runs through it.
void halve(const Bounds& box, const Vec3& half, Bounds& a, Bounds& b) {
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  double at = 0.5 * (box.min[axis] + box.max[axis]);
  for (const double side : {half[axis] * (1.0 + 1e-6), -half[axis] * (1.0 + 1e-6)}) {
    if (box.min[axis] < side && side < box.max[axis]) at = side;
  }
  a = b = box;
  a.max[axis] = b.min[axis] = at;
}

}  // namespace

Cover Outlooks::cover(const Bounds& box, std::uint64_t& looked_at) const {
  if (meets(box, cell.half)) return Cover::some;
  bool none = true;
  for (const Outlook& o : planes) {
    const Bounds turned = o.facing(box);
    if (!(turned.max.z > o.plane.half.z)) continue;
    const Cover c = look_at(o.plane, o.map, turned, looked_at);
    if (c == Cover::all) return c;
    none = none && c == Cover::none;
  }
  return none ? Cover::none : Cover::some;
}

bool Outlooks::hides(const Bounds& box, int halvings, std::uint64_t& looked_at) const {
  const Cover c = cover(box, looked_at);
  if (c == Cover::all) return true;
  if (c == Cover::none || halvings == 0 || meets(box, cell.half)) return false;
  Bounds a, b;
  halve(box, cell.half, a, b);
  return hides(a, halvings - 1, looked_at) && hides(b, halvings - 1, looked_at);
}

Bounds box_in(const ViewCell& cell, const Bounds& world) {
  return grown(into_cell(cell, world), size_of(world.min) + size_of(world.max));
}

Bounds box_in(const ViewCell& cell, const Occludee& occludee) {
  Bounds box;
  if (occludee.ball) {
    box.add_ball(into_cell(cell, occludee.centre), occludee.radius);
  } else {
    for (const Vec3& p : occludee.points) box.add(into_cell(cell, p));
  }
  return grown(box, size_of(occludee.box.min) + size_of(occludee.box.max));
}

}  // namespace gridcull::extended
