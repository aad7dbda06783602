// The world points of a shape one by one, for callers that must not allocate; shape.h has them as lists.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "gridcull/core/pose.h"
#include "gridcull/core/shape.h"
#include "gridcull/core/volume_body.h"

namespace gridcull {

/// Calls f(point) for the points of merged_outline(vertices), in its order.
template <class F>
void for_each_merged(const std::vector<Vec2>& vertices, F&& f) {
  std::size_t end = vertices.size();
  while (end > 1 && vertices[end - 1] == vertices.front()) --end;
  for (std::size_t i = 0; i < end; ++i) {
    if (i == 0 || vertices[i] != vertices[i - 1]) f(vertices[i]);
  }
}

/// Calls f(point) for the local points behind world_outline() (z = 0) or world_vertices(), in their order.
template <class F>
void for_each_local_point(const Shape& shape, F&& f) {
  if (const auto* rectangle = std::get_if<Rectangle>(&shape)) {
    const Vec2 h = 0.5 * rectangle->size;
    for (const Vec2& p : {Vec2(-h.x, -h.y), Vec2(h.x, -h.y), Vec2(h.x, h.y), Vec2(-h.x, h.y)}) f(Vec3(p, 0.0));
  } else if (const auto* polygon = std::get_if<Polygon>(&shape)) {
    for_each_merged(polygon->vertices, [&](const Vec2& p) { f(Vec3(p, 0.0)); });
  } else if (const auto* line = std::get_if<Polyline>(&shape)) {
    for (const Vec2& p : line->vertices) f(Vec3(p, 0.0));
  } else if (const auto* box = std::get_if<Cuboid>(&shape)) {
    for (int i = 0; i < 8; ++i) {
      f(0.5 * box->size * Vec3((i & 1) ? 1.0 : -1.0, (i & 2) ? 1.0 : -1.0, (i & 4) ? 1.0 : -1.0));
    }
  } else if (const auto* prism = std::get_if<Prism>(&shape)) {
    for (const double z : {0.0, prism->height}) {
      for_each_merged(prism->vertices, [&](const Vec2& p) { f(Vec3(p, z)); });
    }
  } else if (const auto* convex = std::get_if<Convex>(&shape)) {
    for (const Vec3& p : convex->vertices) f(p);
  } else if (const auto* faces = std::get_if<Faces>(&shape)) {
    for (const Vec3& p : faces->vertices) f(p);
  } else if (const auto* volume = std::get_if<Volume>(&shape)) {
    for (const Vec3& p : volume->body->outer) f(p);
  }
}

/// Calls f(point) for the points of world_outline() (z of the pose) or world_vertices(), in their order.
template <class F>
void for_each_world_point(const Shape& shape, const Pose& pose, F&& f) {
  const Rotation r = rotation_of(pose.orientation);
  for_each_local_point(shape, [&](const Vec3& local) { f(to_world(pose, r, local)); });
}

/// Calls f(a, b) for every edge between neighbouring points, from last to first too unless the chain is open.
/// `points(g)` calls g(point) for each point in order.
template <class Points, class F>
void for_each_edge(const Points& points, bool open, F&& f) {
  Vec2 first(0.0), before(0.0);
  bool any = false;
  points([&](const Vec2& p) {
    if (any) f(before, p);
    if (!any) first = p;
    any = true;
    before = p;
  });
  if (any && !open) f(before, first);
}

}  // namespace gridcull
