// Discretisation: which cells an object touches and which lie wholly inside it
// (Batagelo and Wu 2002, sections 4.1 and 5.1).
//
// The paper grows each outline edge by half a cell diagonal for I and shrinks it for O, rasterises with
// pixel centres, and in 3D uses inner and outer spheres and boxes. Here both sets come from closed
// formulas per row of cells, which are tighter and need no frame buffer: a cell is *touched* when the
// closed shape may meet the closed cell, *opaque* when the closed cell lies in the interior of the shape
// (both judged with the cell grown by Lattice::margin).
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "gridcull/core/object.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/cover_scratch.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

/// What an object covers. Bricks ascend and none is empty.
struct Cover {
  std::vector<BrickCover> bricks;
  bool outside = false;  ///< the shape may reach beyond the lattice

  void clear() {
    bricks.clear();
    outside = false;
  }
};

/// A shape with what discretising it needs computed once (hull sides, merged outlines). Balls and boxes, of which
/// worlds hold most, take no memory of their own.
class PreparedShape {
 public:
  /// The shape must be valid.
  explicit PreparedShape(const Shape& shape);
  ~PreparedShape();
  PreparedShape(PreparedShape&&) noexcept;
  PreparedShape& operator=(PreparedShape&&) noexcept;

  /// A copy.
  Shape shape() const;
  double reach() const;  ///< reach_of(shape())
  /// Bytes held on the heap: the shape and what was computed for it.
  std::uint64_t bytes() const;

  /// interior_holds(shape(), pose, point), which allocates nothing here.
  bool holds(const Pose& pose, const Vec3& point) const;
  /// volume.may_touch(shape(), pose).
  bool may_touch(const ViewVolume& volume, const Pose& pose) const;

  /// Fills `out`. touched is an over-estimate, opaque an under-estimate (empty for thin shapes).
  void cover(const Lattice& lattice, const Pose& pose, CoverScratch& scratch, Cover& out) const;

 private:
  struct Detail;
  template <class F>
  auto with_shape(F&& f) const;

  std::variant<Disc, Rectangle, Sphere, Cuboid, std::unique_ptr<const Detail>> shape_;
};

/// Cells that the closed ball (2D: disc) may touch; opaque stays 0.
void cover_ball(const Lattice& lattice, const Vec3& centre, double radius, Cover& out);

}  // namespace gridcull
