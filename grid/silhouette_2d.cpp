#include "gridcull/grid/silhouette_2d.h"

#include <algorithm>
#include <cmath>

#include "gridcull/core/predicates.h"

namespace gridcull {

Placed2D placed(const Outline2D& outline, const Pose& pose, const Vec2* points) {
  if (outline.kind() == Outline2D::Kind::disc) return {&outline, Vec2(pose.position), outline.radius(), nullptr};
  const Vec2& m = outline.middle();
  const Vec3 centre = to_world(pose, rotation_of(pose.orientation), {m.x, m.y, 0.0});
  // The centre and the points are off by a few ulp of the coordinates.
  const double blur = 0x1p-48 * (std::fabs(centre.x) + std::fabs(centre.y) + outline.radius());
  return {&outline, Vec2(centre), outline.radius() + blur, points};
}

void Silhouettes2D::begin(const ViewVolume& volume) {
  volume_ = &volume;
  sight_.begin(volume);
  candidates_.clear();
}

bool Silhouettes2D::shows_disc(const Vec2& centre, double radius) const {
  return sight_.look_at_disc(centre - sight_.eye(), radius) != Sight2D::Disc::hidden;
}

bool Silhouettes2D::enter(Slot slot, const Placed2D& object, bool occluder) {
  const Vec2 centre = object.centre - sight_.eye();
  const Sight2D::Disc where = sight_.look_at_disc(centre, object.radius);
  if (where == Sight2D::Disc::hidden) return false;
  Candidate c{object, slot};
  const double far = glm::length(centre) + object.radius;
  c.straddles = far * (1.0 + 0x1p-48) > sight_.range();
  if (where == Sight2D::Disc::around && holds_viewer(object)) {
    c.seen = true;
    candidates_.push_back(c);
    return true;
  }
  if (object.outline->kind() == Outline2D::Kind::disc) {
    c.seen = where == Sight2D::Disc::around && volume_->may_touch_ball({object.centre, 0.0}, object.radius);
    if (occluder) sight_.hide_behind_disc(centre, object.radius, static_cast<std::uint32_t>(candidates_.size()));
  } else if (!enter_outline(c, occluder)) {
    return false;
  }
  candidates_.push_back(c);
  return true;
}

bool Silhouettes2D::enter_outline(Candidate& c, bool occluder) {
  const Outline2D& outline = *c.object.outline;
  const auto owner = static_cast<std::uint32_t>(candidates_.size());
  const bool clear = face_all(c.object);
  c.seen = !clear;
  const Facing back = clear ? back_of(outline) : Facing::radial;
  bool open = c.seen;
  for (std::size_t i = 0; i < edges_.size() && !open; ++i) {
    const Edge& e = edges_[i];
    if (e.facing > Facing::right || e.facing == back) continue;
    open = sight_.open_width(points_[i], end_of(i), e.facing, e.line, 0.0) > 0.0;
  }
  if (!open) return false;
  if (!occluder || !outline.solid(magnitude(c.object))) return true;
  if (!outline.clean()) {
    hide_behind_parts(outline, owner);
    return true;
  }
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& e = edges_[i];
    if (e.facing > Facing::right || e.facing == back) continue;
    sight_.hide_behind_edge(points_[i], end_of(i), e.facing, e.line, owner);
  }
  return true;
}

// A part's ends lie on its edge but for roundings of the edge's points, which parts keep far from everything else.
void Silhouettes2D::hide_behind_parts(const Outline2D& outline, std::uint32_t owner) {
  for (const Outline2D::Part& part : outline.parts()) {
    const Edge& e = edges_[part.edge];
    if (e.facing > Facing::right) continue;
    const Vec2 &a = points_[part.edge], &b = end_of(part.edge);
    const Vec2 from = part.t0 > 0.0 ? a + part.t0 * (b - a) : a, to = part.t1 < 1.0 ? a + part.t1 * (b - a) : b;
    sight_.hide_behind_edge(from, to, e.facing, e.line, owner);
  }
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
  if (c.object.outline->kind() != Outline2D::Kind::disc) return test_outline(c);
  return sight_.look_at_disc(c.object.centre - sight_.eye(), c.object.radius) == Sight2D::Disc::open;
}

bool Silhouettes2D::test_outline(const Candidate& c) {
  const bool clear = face_all(c.object);
  const Facing back = clear ? back_of(*c.object.outline) : Facing::radial;
  double width = 0.0;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& e = edges_[i];
    if (e.facing > Facing::right || e.facing == back) continue;
    const double enough = least_width - width;
    width += c.straddles ? sight_.open_width_in_range(points_[i], end_of(i), e.facing, e.line, enough)
                         : sight_.open_width(points_[i], end_of(i), e.facing, e.line, enough);
    if (width > least_width) return true;
  }
  return false;
}

bool Silhouettes2D::face_all(const Placed2D& object) {
  const std::size_t count = object.outline->points().size();
  points_.resize(count);
  for (std::size_t i = 0; i < count; ++i) points_[i] = object.points[i] - sight_.eye();
  edges_.resize(object.outline->edges());
  bool clear = true;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    edges_[i].facing = face(points_[i], end_of(i), sight_.blur(), edges_[i].line);
    clear = clear && edges_[i].facing != Facing::touches;
  }
  return clear;
}

/// The open interior, by the even-odd rule on the world points, with exact signs.
bool Silhouettes2D::holds_viewer(const Placed2D& object) const {
  const Vec2& eye = sight_.eye();
  switch (object.outline->kind()) {
    case Outline2D::Kind::disc: {
      const Vec2 d = eye - object.centre;
      return glm::dot(d, d) < object.radius * object.radius;
    }
    case Outline2D::Kind::open: return false;
    case Outline2D::Kind::closed: break;
  }
  const std::size_t count = object.outline->points().size();
  bool inside = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 &a = object.points[i], &b = object.points[i + 1 < count ? i + 1 : 0];
    const int side = orientation(a, b, eye);
    if (side == 0 && glm::dot(a - eye, b - eye) <= 0.0) return false;
    if ((a.y > eye.y) != (b.y > eye.y) && side == (b.y > a.y ? 1 : -1)) inside = !inside;
  }
  return inside;
}

double Silhouettes2D::magnitude(const Placed2D& object) const {
  const Vec2 &e = sight_.eye(), &c = object.centre;
  return std::max({std::fabs(e.x), std::fabs(e.y), std::fabs(c.x), std::fabs(c.y)}) + object.radius;
}

std::uint64_t Silhouettes2D::bytes() const {
  return candidates_.capacity() * sizeof(Candidate) + points_.capacity() * sizeof(Vec2) +
         edges_.capacity() * sizeof(Edge) + sight_.buffer().bytes();
}

}  // namespace gridcull
