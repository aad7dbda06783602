// The kernels behind PreparedShape::cover; internal to grid/cover*.cpp.
#pragma once

#include <span>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/grid/cover.h"

namespace gridcull::covering {

/// Sphere (2D: disc).
void ball(const Lattice& lattice, const Vec3& centre, double radius, bool with_opaque, Cover& out);

/// Appends the cells of the body, bricks ascending, none empty; margin in metres. Leaves the body's slabs
/// solved for rows: set them anew before the next call.
void convex(const Lattice& lattice, ConvexBody& body, double margin, Cover& out);

/// Rectangle and oriented box: slabs and bounds of the box centred on `pose` with half edges `half` (2D: z = 0).
void set_box(ConvexBody& body, const Pose& pose, const Vec3& half, bool flat);

/// Appends planar bricks (E x E cells of the xy plane, E = 8 in 2D and 4 in 3D; brick = by * bricks().x + bx)
/// of a closed outline by the even-odd rule, or of an open chain (nothing opaque). Uses scratch.edges, .active,
/// .boundary, .crossings.
void outline(const Lattice& lattice, std::span<const Vec2> points, bool closed, double margin, CoverScratch& scratch,
             std::vector<BrickCover>& out, bool& outside);

/// Polygon swept along z.
void prism(const Lattice& lattice, std::span<const Vec2> local, double height, const Pose& pose, CoverScratch& scratch,
           Cover& out);

/// Greatest |coordinate| of a box; 0 when empty.
double magnitude_of(const Bounds& bounds);

}  // namespace gridcull::covering
