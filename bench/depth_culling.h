// Occlusion culling with a depth buffer: Bartz, Klosowski, Staneker 2005, section 4, in software. A bound is hidden
// when none of its pixels (their centres, as graphics hardware samples them) is nearer than the buffer.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bounds_models.h"
#include "gridcull/core/bounding_volume.h"
#include "gridcull/core/bounds.h"

namespace gridcull::bench {

/// Depths of one view; nearer is greater.
class DepthBuffer {
 public:
  static constexpr int width = 320, height = 240;

  void begin(const View& view);
  void draw(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles);
  /// Whether a pixel of the front faces is nearer than what was drawn; true where the bound reaches the eye's plane.
  bool shows(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles);

  const Vec3& eye() const { return eye_; }
  const Rotation& axes() const { return axes_; }
  double tangent_x() const { return tangent_x_; }
  double tangent_y() const { return tangent_y_; }

 private:
  struct Seen {
    double x, y, w;  ///< pixels; 1 / depth
  };
  Seen project(const Vec3& p) const;
  template <class Pixel>
  bool each_pixel(const Seen& a, const Seen& b, const Seen& c, const Pixel& pixel) const;

  Vec3 eye_{0.0};
  Rotation axes_{};
  double tangent_x_ = 1.0, tangent_y_ = 1.0;
  std::vector<float> depth_ = std::vector<float>(static_cast<std::size_t>(width) * height);
  std::vector<Vec3> local_{};
  std::vector<Seen> seen_{};
};

/// A tree over a model's parts, every node with its box and one kind of bound as triangles.
class BoundTree {
 public:
  BoundTree(const Model& model, BoundKind kind);

  struct Node {
    Bounds box{};
    std::vector<Vec3> vertices{};
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    std::uint32_t part = 0;
    std::uint32_t left = 0, right = 0;  ///< nodes; 0: a leaf
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  const Model& model() const { return model_; }

 private:
  std::uint32_t build(std::vector<std::uint32_t>& parts, std::size_t first, std::size_t last, BoundKind kind);

  const Model& model_;
  std::vector<Node> nodes_{};
};

struct CullResult {
  std::uint64_t drawn_triangles = 0, drawn_parts = 0, queries = 0;
};

/// Leaves in the view, nearest first; the first `untested` share of them is drawn without a query.
CullResult cull_sequential(const BoundTree& tree, const View& view, double untested, DepthBuffer& buffer);
/// Nodes from the root on, nearest first: what is hidden ends there.
CullResult cull_hierarchical(const BoundTree& tree, const View& view, DepthBuffer& buffer);

}  // namespace gridcull::bench
