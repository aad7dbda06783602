// Prisms. Upright (the usual building): planar cells of the outline (cover_outline.cpp) times a range in z,
// exact. Tilted: cells of the oriented box around it, then each cell's box along the prism's own axes against
// outline and height; that box holds the cell, so touched errs upwards and opaque downwards, by less than a
// cell.
#include <array>
#include <cmath>

#include "gridcull/grid/cover_frame.h"
#include "gridcull/grid/cover_kernels.h"
#include "gridcull/grid/cover_words.h"

namespace gridcull::covering {
namespace {

/// The first bit of each layer of brick layer bz that lies in z: times a planar mask, its cells there.
std::uint64_t layers(std::int64_t bz, const Range& z) {
  const std::int64_t low = std::max<std::int64_t>(z.first - 4 * bz, 0);
  const std::int64_t high = std::min<std::int64_t>(z.last - 4 * bz, 3);
  std::uint64_t bits = 0;
  for (std::int64_t k = low; k <= high; ++k) bits |= std::uint64_t{1} << (16 * k);
  return bits;
}

/// A box of half edges `half` about `centre` against an edge: complete separating-axis test.
bool meets(const Vec2& a, const Vec2& b, const Vec2& centre, const Vec2& half) {
  const Vec2 p = a - centre, q = b - centre;
  if (std::min(p.x, q.x) > half.x || std::max(p.x, q.x) < -half.x) return false;
  if (std::min(p.y, q.y) > half.y || std::max(p.y, q.y) < -half.y) return false;
  const Vec2 d = q - p;
  return std::abs(cross2(d, p)) <= half.x * std::abs(d.y) + half.y * std::abs(d.x);
}

struct Local {
  std::span<const Vec2> outline;
  double height;

  /// Cell box about `centre` (local axes): touched, opaque.
  std::pair<bool, bool> classify(const Vec3& centre, const Vec3& half) const {
    if (centre.z + half.z < 0.0 || centre.z - half.z > height) return {false, false};
    const Vec2 c(centre), h(half);
    bool inside = false;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
      const Vec2 &a = outline[j], &b = outline[i];
      if (meets(a, b, c, h)) return {true, false};
      if ((a.y <= c.y) != (b.y <= c.y) && a.x + (c.y - a.y) * ((b.x - a.x) / (b.y - a.y)) < c.x) inside = !inside;
    }
    return {inside, inside && centre.z - half.z > 0.0 && centre.z + half.z < height};
  }
};

void tilted(const Lattice& lattice, const Local& shape, const Pose& pose, double margin, CoverScratch& scratch,
            Cover& out) {
  Bounds local;
  for (const Vec2& p : shape.outline) local.add({p.x, p.y, 0.0});
  local.max.z = shape.height;
  const Rotation r = rotation_of(pose.orientation);
  set_box(scratch.body, {to_world(pose, r, local.centre()), pose.orientation}, 0.5 * local.size(), false);
  scratch.body.has_inside = false;
  convex(lattice, scratch.body, margin, out);
  const double cell_half = 0.5 * lattice.cell() + margin;
  const auto along = [&](const Vec3& a) { return cell_half * (std::abs(a.x) + std::abs(a.y) + std::abs(a.z)); };
  const Vec3 half(along(r.x), along(r.y), along(r.z));
  for (BrickCover& b : out.bricks) {
    const Cell corner = lattice.brick_corner(b.brick);
    std::uint64_t touched = 0;
    for (std::uint64_t left = b.touched; left != 0; left &= left - 1) {
      const std::uint64_t bit = left & -left;
      const int i = __builtin_ctzll(left);
      const Vec3 low(lattice.boundary(0, corner.x + (i & 3)), lattice.boundary(1, corner.y + (i >> 2 & 3)),
                     lattice.boundary(2, corner.z + (i >> 4)));
      const Vec3 centre = r.inverse(low - pose.position + 0.5 * lattice.cell());
      const auto [in, opaque] = shape.classify(centre, half);
      if (in) touched |= bit;
      if (opaque) b.opaque |= bit;
    }
    b.touched = touched;
  }
  drop_empty(out.bricks, 0);
}

}  // namespace

void extrude(const Lattice& lattice, const std::vector<BrickCover>& tiles, double low, double high, double margin,
             Cover& out) {
  const Axis az(lattice, 2);
  const Range z = az.touched(low - margin, high + margin, out.outside);
  if (z.empty()) return;
  const Range opaque{ceil_within(az.in_cells(low + margin), z.first, z.last + 1),
                     floor_within(az.in_cells(high - margin), z.first, z.last + 1) - 1};
  const auto plane = static_cast<std::uint32_t>(lattice.bricks().x * lattice.bricks().y);
  for (std::int64_t bz = z.first / 4; bz <= z.last / 4; ++bz) {
    const std::uint64_t touched = layers(bz, z), inside = layers(bz, opaque);
    const auto base = static_cast<std::uint32_t>(bz) * plane;
    for (const BrickCover& tile : tiles) {
      out.bricks.push_back({base + tile.brick, tile.touched * touched, tile.opaque * inside});
    }
  }
}

void prism(const Lattice& lattice, std::span<const Vec2> local, double height, const Pose& pose, CoverScratch& scratch,
           Cover& out) {
  const Rotation r = rotation_of(pose.orientation);
  scratch.outline.clear();
  Bounds bounds;
  for (const Vec2& p : local) {
    const Vec3 bottom = to_world(pose, r, {p.x, p.y, 0.0});
    bounds.add(bottom);
    bounds.add(to_world(pose, r, {p.x, p.y, height}));
    scratch.outline.emplace_back(bottom);
  }
  const double margin = lattice.margin(magnitude_of(bounds));
  if (is_upright(r)) {
    scratch.tiles.clear();
    outline(lattice, scratch.outline, true, margin, scratch, scratch.tiles, out.outside);
    extrude(lattice, scratch.tiles, bounds.min.z, bounds.max.z, margin, out);
  } else {
    tilted(lattice, {local, height}, pose, margin, scratch, out);
  }
}

}  // namespace gridcull::covering
