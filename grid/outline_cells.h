// Hollow outlines of temporal bounding volumes (Batagelo and Wu 2002, sections 4.1 and 5.2): a circle of cells
// in 2D, the faces of a box of cells in 3D. A viewer that moves from cell to neighbouring cell (diagonals
// count) cannot get inside, and no line of sight from outside reaches the object, without meeting a cell of
// the outline. They hold only while the viewer is outside and only if they lie wholly in the lattice.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gridcull/grid/cover.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

/// A digital disc: the cells with (x - centre.x)^2 + (y - centre.y)^2 <= radius^2 + radius. Its outline are
/// its cells that have one of their eight neighbours outside it: a 4-connected circle, the cells of
/// Bresenham's circle with the corners of its steps filled.
struct CircleOutline {
  Cell centre;
  std::int64_t radius = 0;  ///< cells, >= 0
  bool whole = false;       ///< lies wholly in the lattice
};

/// The least circle about the centre's cell whose digital disc holds every cell that the closed disc touches.
CircleOutline circle_outline(const Lattice& lattice, const Vec3& centre, double radius);

/// The outline's cells as touched bits; nothing but `outside` when it is not whole.
void cover_circle_outline(const Lattice& lattice, const CircleOutline& circle, Cover& out);
void cover_circle_outline(const Lattice& lattice, const Vec3& centre, double radius, Cover& out);

/// Whether the cell lies inside or on the outline.
bool circle_encloses(const CircleOutline& circle, const Cell& cell);
bool circle_encloses(const Lattice& lattice, const Vec3& centre, double radius, const Cell& cell);

/// A box of cells, both ends inclusive: every cell that a closed ball's bounding box touches.
struct CubeCells {
  Cell low, high;
  bool whole = false;  ///< lies wholly in the lattice
};

CubeCells cube_cells(const Lattice& lattice, const Vec3& centre, double radius);
bool cube_encloses(const CubeCells& cube, const Cell& cell);

/// The planes onto which the edges of the faces are projected: T_xy, T_xz, T_yz.
enum class CubePlane { xy, xz, yz };

/// 4 x 4 cells of a plane, aligned with the bricks of the lattice; bit u + 4 v, where (u, v) is (x, y), (x, z)
/// or (y, z).
struct PlanarBrick {
  std::uint32_t brick;  ///< planar_brick_index
  std::uint16_t mask;   ///< never 0
};

/// Index of the planar brick at brick coordinates b (the plane's missing coordinate is ignored); u fastest.
inline std::size_t planar_brick_index(const Lattice& lattice, CubePlane plane, const Cell& b) {
  const Cell n = lattice.bricks();
  switch (plane) {
    case CubePlane::xy: return static_cast<std::size_t>(b.y * n.x + b.x);
    case CubePlane::xz: return static_cast<std::size_t>(b.z * n.x + b.x);
    case CubePlane::yz: break;
  }
  return static_cast<std::size_t>(b.z * n.y + b.y);
}
inline std::size_t planar_brick_count(const Lattice& lattice, CubePlane plane) {
  const Cell n = lattice.bricks();
  return static_cast<std::size_t>(plane == CubePlane::xy ? n.x * n.y : plane == CubePlane::xz ? n.x * n.z : n.y * n.z);
}

/// The projected outlines of a cube's faces: per plane, ascending.
struct CubeOutline {
  std::array<std::vector<PlanarBrick>, 3> plane;  ///< by CubePlane
  bool outside = false;                           ///< not whole: the planes are empty
};

void cover_cube_outline(const Lattice& lattice, const CubeCells& cube, CubeOutline& out);
void cover_cube_outline(const Lattice& lattice, const Vec3& centre, double radius, CubeOutline& out);

/// The existence test of section 5.2, for the 64 cells of a brick at once: from the three planes' masks of one
/// id there, the cells of the brick that lie on the cube's faces.
inline std::uint64_t cells_on_faces(std::uint16_t xy, std::uint16_t xz, std::uint16_t yz) {
  const std::uint64_t over_z = std::uint64_t{xy} * 0x0001'0001'0001'0001ull;
  // One of the four rows of a planar mask into each layer of 16 bits ...
  const auto layers = [](std::uint64_t m) {
    return (m & 0xF) | (m & 0xF0) << 12 | (m & 0xF00) << 24 | (m & 0xF000) << 36;
  };
  const std::uint64_t over_y = layers(xz) * 0x1111;
  // ... and for yz its four bits to the first bit of each row of the layer: bit y to bit 4 y.
  const std::uint64_t rows = layers(yz);
  const std::uint64_t apart = (rows & 0x0001'0001'0001'0001ull) | (rows & 0x0002'0002'0002'0002ull) << 3 |
                              (rows & 0x0004'0004'0004'0004ull) << 6 | (rows & 0x0008'0008'0008'0008ull) << 9;
  const std::uint64_t over_x = apart * 0xF;
  return (over_z & over_y) | (over_z & over_x) | (over_y & over_x);
}

}  // namespace gridcull
