#include "depth_culling.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "gridcull/core/trigonometry.h"

namespace gridcull::bench {
namespace {

constexpr double near_plane = 1e-3;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// An icosahedron's faces divided in four twice: the paper's 320 triangles; corners at length 1.
struct UnitSphere {
  std::vector<Vec3> vertices;
  Triangles triangles;
  double inradius = 1.0;

  UnitSphere() {
    const double t = 0.5 * (1.0 + std::sqrt(5.0));
    for (const auto& [a, b] : {std::array{1.0, t}, {1.0, -t}, {-1.0, t}, {-1.0, -t}}) {
      vertices.insert(vertices.end(),
                      {glm::normalize(Vec3(0, a, b)), glm::normalize(Vec3(a, b, 0)), glm::normalize(Vec3(b, 0, a))});
    }
    triangles.clear();
    const ConvexBoundary hull = bound_of(vertices, BoundKind::hull).bare;
    vertices = hull.vertices;
    for (const auto& f : hull.faces) {
      triangles.push_back({hull.loops[f.first], hull.loops[f.first + 1], hull.loops[f.first + 2]});
    }
    divide();
    divide();
    for (const auto& f : triangles) {
      const Vec3 n = glm::normalize(glm::cross(vertices[f[1]] - vertices[f[0]], vertices[f[2]] - vertices[f[0]]));
      inradius = std::min(inradius, glm::dot(n, vertices[f[0]]));
    }
  }

  void divide() {
    Triangles finer;
    for (const auto& f : triangles) {
      const auto base = static_cast<std::uint32_t>(vertices.size());
      for (std::size_t k = 0; k < 3; ++k) {
        vertices.push_back(glm::normalize(vertices[f[k]] + vertices[f[(k + 1) % 3]]));
      }
      finer.insert(
          finer.end(),
          {{f[0], base, base + 2}, {f[1], base + 1, base}, {f[2], base + 2, base + 1}, {base, base + 1, base + 2}});
    }
    triangles = finer;
  }
};

void set_bound(BoundTree::Node& node, const std::vector<Vec3>& points, BoundKind kind) {
  static const UnitSphere sphere;
  const BoundingVolume bound = bound_of(points, kind);
  if (bound.round) {
    const double scale = bound.ball.radius / sphere.inradius;
    for (const Vec3& v : sphere.vertices) node.vertices.push_back(bound.ball.centre + scale * v);
    node.triangles = sphere.triangles;
    return;
  }
  node.vertices = bound.boundary.vertices;
  for (const auto& face : bound.boundary.faces) {
    for (std::uint32_t i = 1; i + 1 < face.count; ++i) {
      node.triangles.push_back({bound.boundary.loops[face.first], bound.boundary.loops[face.first + i],
                                bound.boundary.loops[face.first + i + 1]});
    }
  }
}

}  // namespace

void DepthBuffer::begin(const View& view) {
  eye_ = view.pose.position;
  axes_ = rotation_of(view.pose.orientation);
  const SinCos half = stable_sincos(0.5 * view.frustum->fov_y);
  tangent_y_ = half.sin / half.cos;
  tangent_x_ = tangent_y_ * view.frustum->aspect;
  std::fill(depth_.begin(), depth_.end(), 0.0f);
}

DepthBuffer::Seen DepthBuffer::project(const Vec3& p) const {
  const double w = 1.0 / p.x;
  return {0.5 * width * (1.0 - p.y * w / tangent_x_), 0.5 * height * (1.0 - p.z * w / tangent_y_), w};
}

/// Calls pixel(index, 1 / depth) for pixel centres inside the triangle, until it says true.
template <class Pixel>
bool DepthBuffer::each_pixel(const Seen& a, const Seen& b, const Seen& c, const Pixel& pixel) const {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0.0) return false;
  const auto clamp = [](double v, int top) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(top))); };
  const int left = clamp(std::ceil(std::min({a.x, b.x, c.x}) - 0.5), width);
  const int right = clamp(std::floor(std::max({a.x, b.x, c.x}) + 0.5), width);
  const int top = clamp(std::ceil(std::min({a.y, b.y, c.y}) - 0.5), height);
  const int bottom = clamp(std::floor(std::max({a.y, b.y, c.y}) + 0.5), height);
  const double over = 1.0 / area;
  // Barycentric coordinates of b and c, and 1 / depth, are affine in the picture.
  const double bx = (c.y - a.y) * over, by = (a.x - c.x) * over, cx = (a.y - b.y) * over, cy = (b.x - a.x) * over;
  const double wx = bx * (b.w - a.w) + cx * (c.w - a.w);
  for (int y = top; y < bottom; ++y) {
    const double dx = left + 0.5 - a.x, dy = y + 0.5 - a.y;
    double s = bx * dx + by * dy, t = cx * dx + cy * dy, w = a.w + s * (b.w - a.w) + t * (c.w - a.w);
    for (int x = left; x < right; ++x, s += bx, t += cx, w += wx) {
      if (s < 0.0 || t < 0.0 || s + t > 1.0) continue;
      if (pixel(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x), static_cast<float>(w))) return true;
    }
  }
  return false;
}

void DepthBuffer::draw(const std::vector<Vec3>& vertices, const Triangles& triangles) {
  local_.clear();
  for (const Vec3& v : vertices) local_.push_back(axes_.inverse(v - eye_));
  for (const auto& f : triangles) {
    // Cut at the near plane: three or four corners are left.
    std::array<Vec3, 4> corner;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &p = local_[f[k]], &q = local_[f[(k + 1) % 3]];
      if (p.x >= near_plane) corner[count++] = p;
      if ((p.x >= near_plane) != (q.x >= near_plane))
        corner[count++] = p + ((near_plane - p.x) / (q.x - p.x)) * (q - p);
    }
    for (std::size_t i = 1; i + 1 < count; ++i) {
      each_pixel(project(corner[0]), project(corner[i]), project(corner[i + 1]), [&](std::size_t at, float w) {
        depth_[at] = std::max(depth_[at], w);
        return false;
      });
    }
  }
}

bool DepthBuffer::shows(const std::vector<Vec3>& vertices, const Triangles& triangles) {
  seen_.clear();
  for (const Vec3& v : vertices) {
    const Vec3 p = axes_.inverse(v - eye_);
    if (p.x < near_plane) return true;
    seen_.push_back(project(p));
  }
  for (const auto& f : triangles) {
    const Seen &a = seen_[f[0]], &b = seen_[f[1]], &c = seen_[f[2]];
    // y runs down the picture: front faces turn clockwise in it.
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) >= 0.0) continue;
    if (each_pixel(a, b, c, [&](std::size_t at, float w) { return w > depth_[at]; })) return true;
  }
  return false;
}

BoundTree::BoundTree(const Model& model, BoundKind kind) : model_(model) {
  std::vector<std::uint32_t> parts(model.parts.size());
  for (std::uint32_t i = 0; i < parts.size(); ++i) parts[i] = i;
  build(parts, 0, parts.size(), kind);
}

/// Halves at the median of the boxes' centres along the longest side.
std::uint32_t BoundTree::build(std::vector<std::uint32_t>& parts, std::size_t first, std::size_t last, BoundKind kind) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  Bounds box;
  std::vector<Vec3> points;
  for (std::size_t i = first; i < last; ++i) {
    for (const Vec3& v : model_.parts[parts[i]].vertices) box.add(v), points.push_back(v);
  }
  nodes_[index].box = box;
  nodes_[index].part = parts[first];
  set_bound(nodes_[index], points, kind);
  if (last - first == 1) return index;
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto centre = [&](std::uint32_t p) {
    Bounds b;
    for (const Vec3& v : model_.parts[p].vertices) b.add(v);
    return b.centre()[axis];
  };
  const std::size_t middle = (first + last) / 2;
  std::stable_sort(parts.begin() + static_cast<std::ptrdiff_t>(first),
                   parts.begin() + static_cast<std::ptrdiff_t>(last),
                   [&](std::uint32_t a, std::uint32_t b) { return centre(a) < centre(b); });
  const std::uint32_t left = build(parts, first, middle, kind), right = build(parts, middle, last, kind);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

namespace {

/// Whether the box is not wholly beyond one side of the view.
bool in_view(const Bounds& box, const DepthBuffer& buffer) {
  const Vec3 centre = buffer.axes().inverse(box.centre() - buffer.eye()), half = 0.5 * box.size();
  const Rotation& r = buffer.axes();
  const auto support = [&](const Vec3& n) {
    const Vec3 world = r * n;
    return glm::dot(n, centre) + glm::dot(glm::abs(world), half);
  };
  return support({1, 0, 0}) > 0.0 && support({buffer.tangent_x(), 1, 0}) > 0.0 &&
         support({buffer.tangent_x(), -1, 0}) > 0.0 && support({buffer.tangent_y(), 0, 1}) > 0.0 &&
         support({buffer.tangent_y(), 0, -1}) > 0.0;
}

double distance_to(const Bounds& box, const Vec3& eye) {
  const Vec3 off = glm::max(glm::max(box.min - eye, eye - box.max), Vec3(0.0));
  return glm::length(off);
}

void draw_part(const BoundTree& tree, const BoundTree::Node& node, DepthBuffer& buffer, CullResult& result) {
  const Part& part = tree.model().parts[node.part];
  buffer.draw(part.vertices, part.triangles);
  ++result.drawn_parts;
  result.drawn_triangles += part.triangles.size();
}

}  // namespace

CullResult cull_sequential(const BoundTree& tree, const View& view, double untested, DepthBuffer& buffer) {
  buffer.begin(view);
  std::vector<std::pair<double, std::uint32_t>> leaves;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const std::uint32_t at = stack.back();
    stack.pop_back();
    const BoundTree::Node& node = tree.nodes()[at];
    if (!in_view(node.box, buffer)) continue;
    if (node.left == 0) {
      leaves.emplace_back(distance_to(node.box, buffer.eye()), at);
    } else {
      stack.insert(stack.end(), {node.left, node.right});
    }
  }
  std::sort(leaves.begin(), leaves.end());
  CullResult result;
  const auto first = static_cast<std::size_t>(untested * static_cast<double>(leaves.size()));
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const BoundTree::Node& node = tree.nodes()[leaves[i].second];
    if (i >= first) {
      ++result.queries;
      if (!buffer.shows(node.vertices, node.triangles)) continue;
    }
    draw_part(tree, node, buffer, result);
  }
  return result;
}

CullResult cull_hierarchical(const BoundTree& tree, const View& view, DepthBuffer& buffer) {
  buffer.begin(view);
  using Item = std::pair<double, std::uint32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  queue.push({0.0, 0});
  CullResult result;
  while (!queue.empty()) {
    const BoundTree::Node& node = tree.nodes()[queue.top().second];
    queue.pop();
    if (!in_view(node.box, buffer)) continue;
    ++result.queries;
    if (!buffer.shows(node.vertices, node.triangles)) continue;
    if (node.left == 0) {
      draw_part(tree, node, buffer, result);
      continue;
    }
    for (const std::uint32_t child : {node.left, node.right}) {
      queue.push({distance_to(tree.nodes()[child].box, buffer.eye()), child});
    }
  }
  return result;
}

}  // namespace gridcull::bench
