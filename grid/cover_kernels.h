// The kernels behind PreparedShape::cover; internal to grid/cover*.cpp.
#pragma once

#include <span>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/grid/cover.h"

namespace gridcull::covering {

/// Sphere (2D: disc).
void ball(const Lattice& lattice, const Vec3& centre, double radius, bool with_opaque, Cover& out);

/// Appends the cells of a 3D body, bricks ascending, none empty; margin in metres. Leaves the body's slabs
/// solved for rows: set them anew before the next call.
void convex(const Lattice& lattice, ConvexBody& body, double margin, Cover& out);

/// Appends planar bricks (see outline()) of a body of the xy plane, given by full slabs without z part.
void convex_planar(const Lattice& lattice, ConvexBody& body, double margin, std::vector<BrickCover>& out,
                   bool& outside);

/// Slabs and bounds of the rectangle or box of half edges `half` about `pose`; `flat` takes it as a rectangle
/// of the xy plane.
void set_box(ConvexBody& body, const Pose& pose, const Vec3& half, bool flat);

/// Appends planar bricks (E x E cells of the xy plane, E = 8 in 2D and 4 in 3D; brick = by * bricks().x + bx)
/// of a closed outline by the even-odd rule, or of an open chain (nothing opaque). Uses scratch.edges, .active,
/// .boundary, .crossings.
void outline(const Lattice& lattice, std::span<const Vec2> points, bool closed, double margin, CoverScratch& scratch,
             std::vector<BrickCover>& out, bool& outside);

/// Appends planar bricks `tiles` swept from low to high (metres): touched cells, and opaque ones in between.
void extrude(const Lattice& lattice, const std::vector<BrickCover>& tiles, double low, double high, double margin,
             Cover& out);

/// Whether the z axis of the body and of the world are one line, exactly (a heading, or upside down).
inline bool is_upright(const Rotation& r) { return r.x.z == 0.0 && r.y.z == 0.0 && r.z.x == 0.0 && r.z.y == 0.0; }

/// Polygon swept along z.
void prism(const Lattice& lattice, std::span<const Vec2> local, double height, const Pose& pose, CoverScratch& scratch,
           Cover& out);

/// Appends the cells inside a closed mesh (world vertices), as touched and opaque, in no order. `out` holds what its
/// triangles touch, bricks ascending.
void fill_mesh(const Lattice& lattice, const std::vector<Vec3>& vertices,
               std::span<const std::array<std::uint32_t, 3>> triangles, CoverScratch& scratch, Cover& out);

/// A volume; fills `out`, bricks ascending.
void volume(const Lattice& lattice, const Volume& shape, const Pose& pose, Cover& out);

/// Greatest |coordinate| of a box; 0 when empty.
double magnitude_of(const Bounds& bounds);

}  // namespace gridcull::covering
