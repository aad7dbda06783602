// Making a shadow frustum: silhouette, sides, near plane, faces. The claim and its proof are in shadow_frustum.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "gridcull/methods/shadow_frustum.h"

namespace gridcull {
namespace {

using Kind = OccluderPart::Kind;

/// More faces than these towards the viewer, and only the near plane counts: each costs a test.
constexpr std::size_t most_front_faces = 8;
/// Vertices nearer than so many blurs are not looked at: second-order terms stay below a tenth of the margins.
constexpr double least_distance_in_blurs = 64.0;
/// Solids and outlines narrower than so many blurs hide nothing: what has no area but for rounding has no interior
/// (three corners in a row, say), and core/exact.h takes walls nearer to each other than that for one place.
constexpr double least_width_in_blurs = 16.0;

/// All terms of a plane's error, twice over (second order, rounding of the margins themselves): `lean` is by how much
/// its normal may be off, from `spread`: the vertices' share, over the length of the vector product it was made of,
/// and `product`: the product of its factors' lengths over the same.
double lean_of(double spread, double product) { return 2.0 * spread + 0x1p-48 * product + 0x1p-48; }

/// The plane of a face through `a` that spans e1, e2 (made of points known up to `blur`); `outward` unit.
ShadowPlane face_plane(const Vec3& outward, const Vec3& a, double lean, double blur) {
  const double length = glm::length(a);
  return {-outward, -glm::dot(outward, a), lean, lean * length + 4.0 * blur};
}

enum class Facing { front, back, unsure };

/// Where the viewpoint, 0, is seen from the face.
Facing facing(const ShadowPlane& plane) {
  if (plane.offset > plane.base) return Facing::front;
  if (-plane.offset > plane.base) return Facing::back;
  return Facing::unsure;
}

/// Leans too much to say anything: holds nothing, faces nobody.
constexpr ShadowPlane no_plane{Vec3(0.0), 0.0, 0.0, std::numeric_limits<double>::infinity()};

ShadowPlane plane_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, double blur) {
  const Vec3 e1 = b - a, e2 = c - a, n = glm::cross(e1, e2);
  const double length = glm::length(n), l1 = glm::length(e1), l2 = glm::length(e2);
  if (!(length > 0.0)) return no_plane;
  return face_plane(n / length, a, lean_of(2.0 * blur * (l1 + l2) / length, l1 * l2 / length), blur);
}

/// 2D: outside is to the right of a -> b.
ShadowPlane plane_of_edge(const Vec3& a, const Vec3& b, double blur) {
  const Vec3 e = b - a;
  const double length = glm::length(e);
  if (!(length > 0.0)) return no_plane;
  return face_plane(Vec3(e.y, -e.x, 0.0) / length, a, lean_of(2.0 * blur / length, 1.0), blur);
}

ShadowPlane turned(const ShadowPlane& p) { return {-p.normal, -p.offset, p.slope, p.base}; }

/// Follows the edges between faces that look at the viewer and others; counter-clockwise as the viewer sees it. False
/// when they are not one loop.
bool walk_silhouette(const OccluderPart& part, std::uint64_t front, std::vector<std::uint16_t>& loop) {
  constexpr std::uint16_t none = 0xFFFF;
  std::array<std::uint16_t, 2 * OccluderPart::most_faces> next;
  next.fill(none);
  std::size_t count = 0;
  std::uint16_t start = none;
  const auto is_front = [front](std::uint16_t face) { return (front >> face & 1) != 0; };
  for (const OccluderPart::Edge& edge : part.edges) {
    if (is_front(edge.left) == is_front(edge.right)) continue;
    const std::uint16_t from = is_front(edge.left) ? edge.from : edge.to;
    if (next[from] != none) return false;
    next[from] = is_front(edge.left) ? edge.to : edge.from;
    start = std::min(start, from);
    ++count;
  }
  loop.clear();
  if (count < 3) return false;
  for (std::uint16_t at = start; loop.size() < count && at != none; at = next[at]) loop.push_back(at);
  return loop.size() == count && next[loop.back()] == start;
}

}  // namespace

bool ShadowFrustum::build(const OccluderPart& part, const Pose& pose, const Rotation& rotation, const Vec3& eye,
                          SilhouetteTrack& track) {
  sides_.clear();
  faces_.clear();
  points_.clear();
  silhouette_.clear();
  has_near_ = cone_ = false;
  const double blur = blur_of(pose.position, part.reach, eye);
  if (part.kind == Kind::ball) return build_ball(part, pose, eye, blur);
  const bool has_interior = part.kind == Kind::solid || part.kind == Kind::outline;
  if (has_interior && !(part.width > least_width_in_blurs * blur)) return false;
  for (const Vec3& v : part.vertices) {
    Vec3 p = to_world(pose, rotation, v) - eye;
    if (part.flat) p.z = 0.0;
    if (!(glm::length(p) > least_distance_in_blurs * blur)) return false;
    points_.push_back(p);
  }
  switch (part.kind) {
    case Kind::solid: return build_solid(part, blur, track);
    case Kind::face: return build_face(blur);
    case Kind::outline: return build_outline(blur);
    default: return build_wall(blur);
  }
}

bool ShadowFrustum::build_solid(const OccluderPart& part, double blur, SilhouetteTrack& track) {
  std::uint64_t mask = 0;
  bool any_front = false, few = true;
  for (std::size_t f = 0; f < part.faces.size(); ++f) {
    const auto& [a, b, c] = part.faces[f];
    const ShadowPlane plane = plane_of_triangle(points_[a], points_[b], points_[c], blur);
    if (plane.offset > 0.0) mask |= std::uint64_t{1} << f;
    const Facing side = facing(plane);
    any_front = any_front || side == Facing::front;
    if (side == Facing::back) continue;
    if (faces_.size() < most_front_faces) {
      faces_.push_back(plane);
    } else {
      few = false;
    }
  }
  if (!any_front) return false;
  if (!few) faces_.clear();
  if (!track.known || track.facing != mask) {
    track.known = walk_silhouette(part, mask, track.loop);
    track.facing = mask;
    ++track.walks;
  }
  if (!track.known || !add_sides(track.loop, blur)) return false;
  set_near_plane(track.loop, blur);
  return has_near_ || !faces_.empty();
}

bool ShadowFrustum::build_face(double blur) {
  ShadowPlane plane = plane_of_triangle(points_[0], points_[1], points_[2], blur);
  if (facing(plane) == Facing::back) plane = turned(plane);
  if (facing(plane) != Facing::front) return false;
  faces_.push_back(plane);
  constexpr std::array<std::uint16_t, 3> loop{0, 1, 2};
  return add_sides(loop, blur);
}

/// Sides of a loop run either way round; the loop's middle must be within all of them.
bool ShadowFrustum::add_sides(std::span<const std::uint16_t> loop, double blur) {
  Vec3 middle(0.0);
  for (const std::uint16_t i : loop) {
    middle += points_[i];
    if (!cone_) silhouette_.push_back(points_[i]);
  }
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &a = points_[loop[i]], &b = points_[loop[(i + 1) % loop.size()]];
    const Vec3 n = glm::cross(b, a);
    const double length = glm::length(n), la = glm::length(a), lb = glm::length(b);
    if (!(length > 0.0)) return false;
    sides_.push_back({n / length, 0.0, lean_of(blur * (la + lb) / length, la * lb / length), 0.0});
  }
  const bool turn_all = glm::dot(sides_.front().normal, middle) < 0.0;
  for (ShadowPlane& side : sides_) {
    if (turn_all) side.normal = -side.normal;
    if (!(glm::dot(side.normal, middle) > 0.0)) return false;
  }
  return true;
}

/// Section 5: normal along the sight to the loop's farthest point.
void ShadowFrustum::set_near_plane(std::span<const std::uint16_t> loop, double blur) {
  Vec3 farthest(0.0);
  for (const std::uint16_t i : loop) {
    if (glm::dot(points_[i], points_[i]) > glm::dot(farthest, farthest)) farthest = points_[i];
  }
  const double length = glm::length(farthest), error = 2.0 * blur + 0x1p-48 * length;
  near_.normal = farthest / length;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const std::uint16_t i : loop) {
    const double depth = glm::dot(near_.normal, points_[i]);
    least = std::min(least, depth), most = std::max(most, depth);
  }
  has_near_ = least > error;
  near_.offset = most;
  near_.slope = 0x1p-48;
  near_.base = 2.0 * error;
}

/// 2D: the two silhouette points, clockwise and counter-clockwise end of what is seen.
bool ShadowFrustum::add_two_sides(const Vec3& right, const Vec3& left, double blur) {
  const double lr = glm::length(right), ll = glm::length(left);
  sides_.push_back({Vec3(-right.y, right.x, 0.0) / lr, 0.0, lean_of(blur / lr, 1.0), 0.0});
  sides_.push_back({Vec3(left.y, -left.x, 0.0) / ll, 0.0, lean_of(blur / ll, 1.0), 0.0});
  return glm::dot(sides_[0].normal, left) > sides_[0].slope * ll &&
         glm::dot(sides_[1].normal, right) > sides_[1].slope * lr;
}

bool ShadowFrustum::build_outline(double blur) {
  const std::size_t n = points_.size();
  bool any_front = false, few = true;
  std::array<std::uint16_t, 2> loop{};  // left, right
  int begins = 0, ends = 0;
  bool before = plane_of_edge(points_[n - 1], points_[0], blur).offset > 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const ShadowPlane plane = plane_of_edge(points_[i], points_[(i + 1) % n], blur);
    const bool front = plane.offset > 0.0;
    if (front && !before) loop[0] = static_cast<std::uint16_t>(i), ++begins;
    if (!front && before) loop[1] = static_cast<std::uint16_t>(i), ++ends;
    before = front;
    any_front = any_front || facing(plane) == Facing::front;
    if (facing(plane) == Facing::back) continue;
    if (faces_.size() < most_front_faces) {
      faces_.push_back(plane);
    } else {
      few = false;
    }
  }
  if (!any_front || begins != 1 || ends != 1) return false;
  if (!few) faces_.clear();
  if (!add_two_sides(points_[loop[1]], points_[loop[0]], blur)) return false;
  set_near_plane(loop, blur);
  return has_near_ || !faces_.empty();
}

bool ShadowFrustum::build_wall(double blur) {
  ShadowPlane plane = plane_of_edge(points_[0], points_[1], blur);
  const bool swap = facing(plane) == Facing::back;
  if (swap) plane = turned(plane);
  if (facing(plane) != Facing::front) return false;
  faces_.push_back(plane);
  return add_two_sides(points_[swap ? 0 : 1], points_[swap ? 1 : 0], blur);
}

/// The cone about the ball, cut off at the circle where it touches. An angle's sine is known up to its relative error
/// in radius and distance, the angle itself up to that times the tangent; where the ball fills nearly half of all
/// directions it is left out. For unions (methods/image_polygon.h) there is a pyramid on points of that circle.
bool ShadowFrustum::build_ball(const OccluderPart& part, const Pose& pose, const Vec3& eye, double blur) {
  constexpr double least_cosine = 0x1p-10;
  const Vec3 to_centre = pose.position - eye;
  const double d = glm::length(to_centre), r = part.radius;
  if (!(d - r > least_distance_in_blurs * blur)) return false;
  sin_ = r / d;
  cos_ = std::sqrt((1.0 - sin_) * (1.0 + sin_));
  if (!(cos_ > least_cosine)) return false;
  cone_ = true;
  axis_ = to_centre / d;
  const double lean = 2.0 * blur / d + 0x1p-48;
  cone_slope_ = 2.0 * lean * (2.0 + sin_ / cos_);
  const double depth = (d - r) * (1.0 + sin_);
  near_ = {axis_, depth, 2.0 * lean, 8.0 * blur + 0x1p-46 * d};
  has_near_ = true;
  // A little inside the circle: the sines below, and all roundings, stay within the ball.
  const double across = r * cos_ * (1.0 - 0x1p-30);
  if (!(across * 0x1p-32 > blur)) return true;
  const Vec3 helper = std::fabs(axis_.z) < 0.75 ? Vec3(0.0, 0.0, 1.0) : Vec3(1.0, 0.0, 0.0);
  const Vec3 u = glm::normalize(glm::cross(helper, axis_)), v = glm::cross(axis_, u);
  if (part.flat) {
    if (!add_two_sides(depth * axis_ - across * u, depth * axis_ + across * u, blur)) sides_.clear();
    return true;
  }
  constexpr double h = 0.86602540378443864;
  for (const Vec2& turn : {Vec2(1, 0), Vec2(h, 0.5), Vec2(0.5, h), Vec2(0, 1), Vec2(-0.5, h), Vec2(-h, 0.5),
                           Vec2(-1, 0), Vec2(-h, -0.5), Vec2(-0.5, -h), Vec2(0, -1), Vec2(0.5, -h), Vec2(h, -0.5)}) {
    points_.push_back(depth * axis_ + across * (turn.x * u + turn.y * v));
  }
  constexpr std::array<std::uint16_t, 12> loop{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  if (!add_sides(loop, blur)) sides_.clear();
  return true;
}

}  // namespace gridcull
