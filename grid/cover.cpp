// Discretisation of every shape: chooses the kernel (see cover_kernels.h) and sets it up.
#include "gridcull/grid/cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

#include "gridcull/core/hull.h"
#include "gridcull/core/volume.h"
#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_kernels.h"

namespace gridcull {
namespace {

using namespace covering;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Directions shorter than this (metres, or square metres) say nothing: their products may underflow.
constexpr double least_length = 1e-150;

double size_of(const Vec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// The slab in direction `a` that just holds the points.
ConvexSlab slab_around(const Vec3& a, const Vec3& reference, std::span<const Vec3> points) {
  ConvexSlab s{a, infinite, -infinite, 0.0, 0.0};
  for (const Vec3& p : points) {
    const double along = glm::dot(a, p - reference);
    s.low = std::min(s.low, along);
    s.high = std::max(s.high, along);
  }
  return s;
}

/// Slabs perpendicular to an edge of the body and to an edge of the cell along x, y or z, where `bounds[k]`
/// says that the edge may bound the body's projection along axis k: the cross products of the separating-axis
/// test. Any direction is right, since the slab holds all points; a missing one only loosens.
void add_edge_slabs(ConvexBody& body, const Vec3& edge, const std::array<bool, 3>& bounds,
                    std::span<const Vec3> points) {
  if (!(size_of(edge) > least_length)) return;
  if (bounds[0]) body.yz.push_back(slab_around({0.0, -edge.z, edge.y}, body.reference, points));
  if (bounds[1]) body.xz.push_back(slab_around({edge.z, 0.0, -edge.x}, body.reference, points));
  if (bounds[2]) body.xy.push_back(slab_around({-edge.y, edge.x, 0.0}, body.reference, points));
}

/// An edge of a hull, local axes.
struct HullEdge {
  Vec3 along;
  Vec3 left, right;  ///< normals of the two triangles that meet in it, any length

  /// Whether the edge is on the outline of the hull seen along each axis of the world.
  std::array<bool, 3> on_outline(const Rotation& r) const {
    const Vec3 product = (r * left) * (r * right);
    return {product.x <= 0.0, product.y <= 0.0, product.z <= 0.0};
  }
};

/// Every edge once, with the normals at both sides; edges inside a face have equal ones and never matter.
std::vector<HullEdge> edges_of(const Hull& hull, const std::vector<Vec3>& points) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vec3> left;  // of each directed edge
  for (const auto& t : hull.triangles) {
    const Vec3 normal = glm::cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    for (std::size_t k = 0; k < 3; ++k) left[{t[k], t[(k + 1) % 3]}] = normal;
  }
  std::vector<HullEdge> edges;
  for (const auto& [ends, normal] : left) {
    const auto other = left.find({ends.second, ends.first});
    if (ends.first > ends.second && other != left.end()) continue;
    const Vec3 beyond = other != left.end() ? other->second : -normal;
    edges.push_back({points[ends.second] - points[ends.first], normal, beyond});
  }
  return edges;
}

/// Whether a box grown by `margin` lies wholly beyond the lattice.
bool beyond(const Lattice& lattice, const Bounds& bounds, double margin) {
  const Bounds box = lattice.box();
  for (int k = 0; k < 3; ++k) {
    if (bounds.max[k] + margin < box.min[k] || bounds.min[k] - margin > box.max[k]) return true;
  }
  return false;
}

/// Merges the covers of several bodies.
void merge_bricks(std::vector<BrickCover>& bricks) {
  std::sort(bricks.begin(), bricks.end(), [](const BrickCover& a, const BrickCover& b) { return a.brick < b.brick; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    if (kept > 0 && bricks[kept - 1].brick == bricks[i].brick) {
      bricks[kept - 1].touched |= bricks[i].touched;
      bricks[kept - 1].opaque |= bricks[i].opaque;
    } else {
      bricks[kept++] = bricks[i];
    }
  }
  bricks.resize(kept);
}

// Shapes without anything prepared.
template <class S>
constexpr bool is_plain =
    std::is_same_v<S, Disc> || std::is_same_v<S, Sphere> || std::is_same_v<S, Rectangle> || std::is_same_v<S, Cuboid>;

void cover_plain(const Disc& s, const Lattice& lattice, const Pose& pose, CoverScratch&, Cover& out) {
  ball(lattice, pose.position, s.radius, true, out);
}
void cover_plain(const Sphere& s, const Lattice& lattice, const Pose& pose, CoverScratch&, Cover& out) {
  ball(lattice, pose.position, s.radius, true, out);
}
void cover_plain(const Rectangle& s, const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) {
  set_box(scratch.body, pose, {0.5 * s.size.x, 0.5 * s.size.y, 0.0}, true);
  convex_planar(lattice, scratch.body, lattice.margin(magnitude_of(scratch.body.bounds)), out.bricks, out.outside);
}
void cover_plain(const Cuboid& s, const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) {
  const bool upright = is_upright(rotation_of(pose.orientation));
  ConvexBody& body = scratch.body;
  set_box(body, pose, 0.5 * s.size, upright);
  const double margin = lattice.margin(magnitude_of(body.bounds));
  if (!upright) return convex(lattice, body, margin, out);
  scratch.tiles.clear();
  convex_planar(lattice, body, margin, scratch.tiles, out.outside);
  extrude(lattice, scratch.tiles, body.bounds.min.z, body.bounds.max.z, margin, out);
}

}  // namespace

struct PreparedShape::Detail {
  explicit Detail(const Shape& s) : shape(s) {
    if (const auto* p = std::get_if<Polygon>(&shape)) outline = merged_outline(p->vertices);
    if (const auto* p = std::get_if<Prism>(&shape)) outline = merged_outline(p->vertices);
    if (const auto* p = std::get_if<Polyline>(&shape)) outline = p->vertices;
    if (const auto* p = std::get_if<Convex>(&shape)) prepare(*p);
  }

  Shape shape;
  std::vector<Vec2> outline;                            ///< local
  std::vector<ConvexSlab> sides;                        ///< Convex: local, reference 0
  std::vector<HullEdge> edges;                          ///< Convex
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Convex: facets, outward

  void prepare(const Convex& s);
  void place(const Vec3* local, std::size_t count, const Pose& pose, ConvexBody& body, std::vector<Vec3>& world) const;

  template <class S>
  requires is_plain<S>
  void cover(const S&, const Lattice&, const Pose&, CoverScratch&, Cover&) const {}  // never kept here
  void cover(const Polygon&, const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) const {
    cover_plane(lattice, pose, true, scratch, out);
  }
  void cover(const Polyline&, const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) const {
    cover_plane(lattice, pose, false, scratch, out);
  }
  void cover(const Prism& s, const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) const {
    prism(lattice, outline, s.height, pose, scratch, out);
  }
  void cover(const Convex& s, const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) const;
  void cover(const Faces& s, const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) const;

  void cover(const Volume& s, const Lattice& lattice, const Pose& pose, CoverScratch&, Cover& out) const {
    covering::volume(lattice, s, pose, out);
  }

  void cover_plane(const Lattice& lattice, const Pose& pose, bool closed, CoverScratch& scratch, Cover& out) const {
    const Rotation r = rotation_of(pose.orientation);
    scratch.outline.clear();
    double magnitude = 0.0;
    for (const Vec2& p : outline) {
      const Vec2 world(to_world(pose, r, {p.x, p.y, 0.0}));
      scratch.outline.push_back(world);
      magnitude = std::max({magnitude, std::abs(world.x), std::abs(world.y)});
    }
    covering::outline(lattice, scratch.outline, closed, lattice.margin(magnitude), scratch, out.bricks, out.outside);
  }
};

void PreparedShape::Detail::prepare(const Convex& s) {
  const Hull hull = convex_hull(s.vertices);
  edges = edges_of(hull, s.vertices);
  triangles = hull.triangles;
  for (const HalfSpace& side : hull.sides) {
    ConvexSlab slab = slab_around(side.normal, Vec3(0.0), s.vertices);
    slab.inner_low = side.offset + hull.margin;
    slab.inner_high = infinite;
    sides.push_back(slab);
  }
}

/// World points of a body, its bounds and its reference.
void PreparedShape::Detail::place(const Vec3* local, std::size_t count, const Pose& pose, ConvexBody& body,
                                  std::vector<Vec3>& world) const {
  const Rotation r = rotation_of(pose.orientation);
  body.clear();
  body.bounds = {};
  body.reference = pose.position;
  world.clear();
  for (std::size_t i = 0; i < count; ++i) {
    world.push_back(to_world(pose, r, local[i]));
    body.bounds.add(world.back());
  }
}

void PreparedShape::Detail::cover(const Convex& s, const Lattice& lattice, const Pose& pose, CoverScratch& scratch,
                                  Cover& out) const {
  ConvexBody& body = scratch.body;
  place(s.vertices.data(), s.vertices.size(), pose, body, scratch.vertices);
  const Rotation r = rotation_of(pose.orientation);
  for (ConvexSlab side : sides) {
    side.direction = r * side.direction;
    body.full.push_back(side);
  }
  body.has_inside = true;
  for (const HullEdge& e : edges) add_edge_slabs(body, r * e.along, e.on_outline(r), scratch.vertices);
  convex(lattice, body, lattice.margin(magnitude_of(body.bounds)), out);
}

void PreparedShape::Detail::cover(const Faces& s, const Lattice& lattice, const Pose& pose, CoverScratch& scratch,
                                  Cover& out) const {
  ConvexBody& body = scratch.body;
  place(s.vertices.data(), s.vertices.size(), pose, body, scratch.vertices);
  const double margin = lattice.margin(magnitude_of(body.bounds));
  for (const auto& t : s.triangles) {
    const std::array<Vec3, 3> p{scratch.vertices[t[0]], scratch.vertices[t[1]], scratch.vertices[t[2]]};
    body.clear();
    body.bounds = {};
    for (const Vec3& v : p) body.bounds.add(v);
    if (beyond(lattice, body.bounds, margin)) {
      out.outside = true;
      continue;
    }
    body.reference = p[0];
    const Vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    if (size_of(normal) > least_length) body.full.push_back(slab_around(normal, p[0], p));
    for (std::size_t k = 0; k < 3; ++k) add_edge_slabs(body, p[(k + 1) % 3] - p[k], {true, true, true}, p);
    convex(lattice, body, margin, out);
  }
  if (s.triangles.size() > 1) merge_bricks(out.bricks);
  if (!s.closed) return;
  fill_mesh(lattice, scratch.vertices, s.triangles, scratch, out);
  merge_bricks(out.bricks);
}

PreparedShape::PreparedShape(const Shape& shape) {
  const auto take = [&](const auto& s) {
    if constexpr (is_plain<std::decay_t<decltype(s)>>) {
      shape_ = s;
    } else {
      shape_ = std::make_unique<const Detail>(shape);
    }
  };
  std::visit(take, shape);
}
PreparedShape::~PreparedShape() = default;
PreparedShape::PreparedShape(PreparedShape&&) noexcept = default;
PreparedShape& PreparedShape::operator=(PreparedShape&&) noexcept = default;

/// Calls f(const Shape&).
template <class F>
auto PreparedShape::with_shape(F&& f) const {
  const auto call = [&](const auto& s) {
    if constexpr (requires { s->shape; }) {
      return f(s->shape);
    } else {
      return f(Shape(s));
    }
  };
  return std::visit(call, shape_);
}

Shape PreparedShape::shape() const {
  return with_shape([](const Shape& s) { return s; });
}

double PreparedShape::reach() const {
  return with_shape([](const Shape& s) { return reach_of(s); });
}

std::uint64_t PreparedShape::bytes() const {
  const auto* held = std::get_if<std::unique_ptr<const Detail>>(&shape_);
  if (held == nullptr) return 0;
  const Detail& d = **held;
  std::uint64_t bytes = sizeof(Detail) + d.outline.capacity() * sizeof(Vec2) + d.sides.capacity() * sizeof(ConvexSlab) +
                        d.edges.capacity() * sizeof(HullEdge) + d.triangles.capacity() * sizeof(d.triangles[0]);
  const auto add = [&](const auto& s) {
    if constexpr (requires { s.vertices; }) bytes += s.vertices.capacity() * sizeof(s.vertices[0]);
    if constexpr (requires { s.triangles; }) bytes += s.triangles.capacity() * sizeof(s.triangles[0]);
    if constexpr (requires { s.field; }) bytes += bytes_of(s);
  };
  std::visit(add, d.shape);
  return bytes;
}

bool PreparedShape::holds(const Pose& pose, const Vec3& point) const {
  if (const auto* held = std::get_if<std::unique_ptr<const Detail>>(&shape_)) {
    if (const auto* hull = std::get_if<Convex>(&(*held)->shape)) {
      return hull_holds(hull->vertices, (*held)->triangles,
                        rotation_of(pose.orientation).inverse(point - pose.position));
    }
  }
  return with_shape([&](const Shape& s) { return interior_holds(s, pose, point); });
}

bool PreparedShape::may_touch(const ViewVolume& volume, const Pose& pose) const {
  return with_shape([&](const Shape& s) { return volume.may_touch(s, pose); });
}

void PreparedShape::cover(const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) const {
  out.clear();
  const auto fill = [&](const auto& s) {
    if constexpr (requires { s->shape; }) {
      std::visit([&](const auto& t) { s->cover(t, lattice, pose, scratch, out); }, s->shape);
    } else {
      cover_plain(s, lattice, pose, scratch, out);
    }
  };
  std::visit(fill, shape_);
}

}  // namespace gridcull
