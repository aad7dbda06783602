#include "gridcull/grid/silhouette_2d.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gridcull {

Placed2D placed(const Outline2D& outline, const Pose& pose, const Vec2* points) {
  const Vec2& m = outline.middle();
  const Vec3 centre = to_world(pose, rotation_of(pose.orientation), {m.x, m.y, 0.0});
  // The centre and the points are off by a few ulp of the coordinates.
  const double blur = 0x1p-48 * (std::fabs(centre.x) + std::fabs(centre.y) + outline.radius());
  return {&outline, Vec2(centre), outline.radius() + blur, points};
}

namespace {

/// Asks for memory that is needed unless the disc around the object turns out to be hidden. Outlines have 4 points and
/// more.
void ask_for(const Placed2D& object) {
  const char *outline = reinterpret_cast<const char*>(object.outline),
             *points = reinterpret_cast<const char*>(object.points);
  __builtin_prefetch(outline);
  __builtin_prefetch(outline + sizeof(Outline2D) - 1);
  __builtin_prefetch(points);
  __builtin_prefetch(points + 3 * sizeof(Vec2));
}

}  // namespace

void Silhouettes2D::begin(const ViewVolume& volume) {
  volume_ = &volume;
  sight_.begin(volume);
  candidates_.clear();
}

bool Silhouettes2D::shows_disc(const Vec2& centre, double radius) const {
  const Vec2 c = centre - sight_.eye();
  return sight_.look_at_disc(c, glm::dot(c, c), radius) != Sight2D::Disc::hidden;
}

bool Silhouettes2D::enter(Slot slot, const Placed2D& object, bool occluder) {
  if (object.outline != nullptr) ask_for(object);
  const Vec2 centre = object.centre - sight_.eye();
  const double square = glm::dot(centre, centre);
  const Sight2D::Disc where = sight_.look_at_disc(centre, square, object.radius);
  if (where == Sight2D::Disc::hidden) return false;
  Candidate c{object, slot, false, !within_range(square, object.radius)};
  if (where == Sight2D::Disc::around && holds_viewer(object)) {
    c.seen = true;
  } else if (object.outline != nullptr) {
    if (!enter_outline(c, occluder) && !Sight2D::seems_tiny(square, object.radius)) return false;
  } else {
    c.seen = where == Sight2D::Disc::around && volume_->may_touch_ball({object.centre, 0.0}, object.radius);
    if (occluder) sight_.hide_behind_disc(centre, object.radius, static_cast<std::uint32_t>(candidates_.size()));
  }
  candidates_.push_back(c);
  return true;
}

// An object that may hold the viewer or seems tiny needs its disc; so does a disc, and what reaches beyond the range.
// (Outlines whose edges are nearer than some ties count as about the viewer, and then only the disc says whether they
// are in the field of view: the gap is beyond that, and beyond the roundings here.)
bool Silhouettes2D::enter_boxed(Slot slot, const Placed2D& object, bool occluder, const Box2D& box) {
  const Vec2 centre = object.centre - sight_.eye();
  const double square = glm::dot(centre, centre);
  const Vec2 low = box.low - sight_.eye(), high = box.high - sight_.eye();
  const double gap = std::max({low.x, -high.x, low.y, -high.y});
  const bool clear = gap > 1e-9 * (std::fabs(centre.x) + std::fabs(centre.y) + object.radius) + 256.0 * sight_.blur();
  if (!clear || object.outline == nullptr || !within_range(square, object.radius) ||
      Sight2D::seems_tiny(square, object.radius)) {
    return enter(slot, object, occluder);
  }
  Candidate c{object, slot, false, false};
  if (!enter_outline(c, occluder)) return false;
  candidates_.push_back(c);
  return true;
}

// An outline that is the nearest nowhere may still be open: where it coincides with what is.
bool Silhouettes2D::enter_outline(Candidate& c, bool occluder) {
  const Outline2D& outline = *c.object.outline;
  const bool clear = face_all(c.object);
  c.seen = !clear && touches_cone();
  const Facing back = clear ? back_of(outline) : Facing::radial;
  if (occluder && outline.solid(magnitude(c.object))) {
    const auto owner = static_cast<std::uint32_t>(candidates_.size());
    if (outline.clean() ? hide_behind_outline(back, owner) : hide_behind_parts(outline, owner)) return true;
  }
  return c.seen || outline_open(back, false);
}

// Neighbouring edges share the direction of their common point, unless the outline turns back there.
bool Silhouettes2D::hide_behind_outline(Facing back, std::uint32_t owner) {
  bool nearest = false, known = false;
  Bearing end{};  // of the edge before, where `known`
  for (std::size_t i = 0; i < edges_; ++i) {
    if (skipped(facing_[i], back)) {
      known = false;
      continue;
    }
    const double way = facing_[i] == Facing::left ? 1.0 : -1.0;
    const bool from_free = begin_free(i), to_free = end_free(i);
    const Vec2 a = from_free ? sight_.drawn_back(points_[i], way) : points_[i];
    const Vec2 b = to_free ? sight_.drawn_back(points_[i + 1], -way) : points_[i + 1];
    const Bearing begin = known && !from_free ? end : bearing_of(a);
    end = bearing_of(b);
    known = !to_free;
    if ((from_free || to_free) && !(way * cross2(a, b) > 0.0)) continue;  // narrower than that: turned round
    const EdgeLine line = line_of(i);
    nearest = sight_.hide_behind_edge(way > 0.0 ? begin : end, way > 0.0 ? end : begin, line, owner) || nearest;
  }
  return nearest;
}

bool Silhouettes2D::hide_behind_parts(const Outline2D& outline, std::uint32_t owner) {
  bool nearest = false;
  for (const Outline2D::Part& part : outline.parts()) {
    if (!skipped(facing_[part.edge], Facing::radial)) nearest = hide_behind_part(part, owner) || nearest;
  }
  return nearest;
}

// A part's ends lie on its edge but for roundings of the edge's points, which parts keep far from everything else.
bool Silhouettes2D::hide_behind_part(const Outline2D::Part& part, std::uint32_t owner) {
  const Vec2 &a = points_[part.edge], &b = points_[part.edge + 1];
  const double way = facing_[part.edge] == Facing::left ? 1.0 : -1.0;
  Vec2 p = part.t0 > 0.0 ? a + part.t0 * (b - a) : a, q = part.t1 < 1.0 ? a + part.t1 * (b - a) : b;
  if (part.t0 == 0.0 && begin_free(part.edge)) p = sight_.drawn_back(p, way);
  if (part.t1 == 1.0 && end_free(part.edge)) q = sight_.drawn_back(q, -way);
  if (!(way * cross2(p, q) > 0.0)) return false;  // narrower than that: turned round
  if (way < 0.0) std::swap(p, q);
  return sight_.hide_behind_edge(bearing_of(p), bearing_of(q), line_of(part.edge), owner);
}

void Silhouettes2D::finish(std::vector<Slot>& visible) {
  sight_.buffer().for_each_owner([&](std::uint32_t owner) {
    Candidate& c = candidates_[owner];
    c.seen = c.seen || !c.straddles;
  });
  for (const Candidate& c : candidates_) {
    if (c.seen || test(c)) visible.push_back(c.slot);
  }
}

bool Silhouettes2D::test(const Candidate& c) {
  const Vec2 centre = c.object.centre - sight_.eye();
  const double square = glm::dot(centre, centre);
  if (c.object.outline == nullptr || Sight2D::seems_tiny(square, c.object.radius)) {
    return sight_.look_at_disc(centre, square, c.object.radius) == Sight2D::Disc::open;
  }
  const bool clear = face_all(c.object);
  return outline_open(clear ? back_of(*c.object.outline) : Facing::radial, c.straddles);
}

bool Silhouettes2D::outline_open(Facing back, bool straddles) const {
  double width = 0.0;
  for (std::size_t i = 0; i < edges_; ++i) {
    if (skipped(facing_[i], back)) continue;
    const Vec2 &a = points_[i], &b = points_[i + 1];
    const EdgeLine line = line_of(i);
    const bool left = facing_[i] == Facing::left;
    const double enough = sight_.least() - width;
    width +=
        straddles ? sight_.open_width_in_range(a, b, left, line, enough) : sight_.open_width(a, b, left, line, enough);
    if (width > sight_.least()) return true;
  }
  return false;
}

bool Silhouettes2D::face_all(const Placed2D& object) {
  const std::size_t count = object.outline->points().size();
  closed_ = object.outline->closed();
  edges_ = object.outline->edges();
  if (easy_.size() < edges_) {
    points_.resize(edges_ + 1);
    easy_.resize(edges_);
    facing_.resize(edges_ + 1);
  }
  const Vec2 eye = sight_.eye();
  Vec2* const points = points_.data();
  for (std::size_t i = 0; i < count; ++i) points[i] = object.points[i] - eye;
  if (closed_) points[count] = points[0];
  const bool clear = face_easily() || face_with_care();
  facing_[edges_] = facing_[0];
  return clear;
}

bool Silhouettes2D::face_easily() {
  const double blur = sight_.blur();
  const Vec2* const points = points_.data();
  double* const easy = easy_.data();
  Facing* const facing = facing_.data();
  bool all = true;
  for (std::size_t i = 0, count = edges_; i < count; ++i) {
    const EasyEdge edge = easy_edge(points[i], points[i + 1], blur);
    easy[i] = edge.easy ? edge.c : 0.0;
    facing[i] = edge.c > 0.0 ? Facing::left : Facing::right;
    all = all && edge.easy;
  }
  return all;
}

bool Silhouettes2D::face_with_care() {
  bool clear = true;
  for (std::size_t i = 0; i < edges_; ++i) {
    facing_[i] = turn_of_edge(points_[i], points_[i + 1], sight_.blur()).facing;
    clear = clear && facing_[i] != Facing::touches;
  }
  return clear;
}

/// The object in hand against the sides of the field of view: it is met at no distance, so all directions count.
bool Silhouettes2D::touches_cone() const {
  const auto end = points_.begin() + static_cast<std::ptrdiff_t>(edges_ + 1);
  const auto touches = [&](const HalfSpace& side) {
    return std::any_of(points_.begin(), end, [&](const Vec2& p) {
      const double slack = 1e-15 * (std::fabs(p.x) + std::fabs(p.y)) + 1e-3 * sight_.blur();
      return glm::dot(Vec2(side.normal), p) >= -slack;
    });
  };
  if (volume_->all_round()) return true;
  return volume_->convex() ? std::all_of(volume_->begin(), volume_->end(), touches)
                           : std::any_of(volume_->begin(), volume_->end(), touches);
}

/// The open interior, judged as interior_holds() does (core/view_volume.h), on the points at hand.
bool Silhouettes2D::holds_viewer(const Placed2D& object) const {
  const Vec2& eye = sight_.eye();
  if (object.outline == nullptr) {
    const Vec2 d = eye - object.centre;
    return glm::dot(d, d) < object.radius * object.radius;
  }
  if (!object.outline->closed()) return false;
  const std::size_t count = object.outline->points().size();
  bool inside = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 &a = object.points[i], &b = object.points[i + 1 < count ? i + 1 : 0];
    const Vec2 from = a - eye, to = b - eye;
    if (cross2(from, to) == 0.0 && glm::dot(from, to) <= 0.0) return false;
    if ((a.y > eye.y) == (b.y > eye.y)) continue;
    const double side = cross2(b - a, eye - a);
    if (b.y > a.y ? side > 0.0 : side < 0.0) inside = !inside;
  }
  return inside;
}

double Silhouettes2D::magnitude(const Placed2D& object) const {
  const Vec2 &e = sight_.eye(), &c = object.centre;
  return std::max({std::fabs(e.x), std::fabs(e.y), std::fabs(c.x), std::fabs(c.y)}) + object.radius;
}

std::uint64_t Silhouettes2D::bytes() const {
  return candidates_.capacity() * sizeof(Candidate) + points_.capacity() * sizeof(Vec2) +
         easy_.capacity() * sizeof(double) + facing_.capacity() * sizeof(Facing) + sight_.buffer().bytes();
}

}  // namespace gridcull
