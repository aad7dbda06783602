// One face of the coverage mask: where its pixels lie in the world, and where their bits are.
//
// A face is a window in the plane at depth 1 before the viewpoint, symmetric about its middle. Pixel (x, y) of
// it, fractions allowed, is the direction forward + (x / scale_x - tangent_x) right + (y / scale_y - tangent_y) up.
#pragma once

#include <cstdint>

#include "gridcull/core/vec.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/grid/mask_kernels.h"

namespace gridcull {

/// One cache line: eight rows of 64 pixels.
struct alignas(64) MaskBlock {
  std::uint64_t rows[masking::block_height];
};

struct MaskFace {
  masking::Window window;
  Vec3 right, up, forward;                  ///< orthonormal up to 2^-48
  double tangent_x = 0.0, tangent_y = 0.0;  ///< half the window
  double scale_x = 0.0, scale_y = 0.0;      ///< pixels to a unit of tangent
  double step_y = 0.0;                      ///< 1 / scale_y
  double norm_x = 0.0, norm_y = 0.0;        ///< sqrt(1 + tangent^2)

  Vec3 to_face(const Vec3& d) const { return {glm::dot(right, d), glm::dot(up, d), glm::dot(forward, d)}; }
  Vec3 direction(double x, double y) const {
    return forward + (x / scale_x - tangent_x) * right + (y / scale_y - tangent_y) * up;
  }
  bool covered(int x, int y) const;
};

/// Axes, forms and margins; tangents 2^-40 .. 2.5, resolution 8 .. 8192 pixels along the longer side, at least 8
/// along the other.
void set_geometry(MaskFace& face, const Vec3& right, const Vec3& up, const Vec3& forward, double tangent_x,
                  double tangent_y, int resolution);

/// Face 0 .. 5 of the cube about the viewpoint: +x, -x, +y, -y, +z, -z.
void set_cube_face(MaskFace& face, int index, int resolution);

/// The window that holds a whole view pyramid; false when its tangents exceed 2.5 or there is no pyramid.
bool set_window(MaskFace& face, const ViewVolume& volume, int resolution);

/// Blocks, and words of `full` and `columns`, that the face takes.
std::size_t block_count(const MaskFace& face);
std::size_t coarse_count(const MaskFace& face);

/// All pixels uncovered, in the memory given: `coarse` for `full` and `columns`.
void clear(MaskFace& face, MaskBlock* blocks, std::uint64_t* coarse);

/// The part of a cube face that lies wholly beyond a side plane of the view (normal . d < 0), as a polygon;
/// false when there is none.
bool beyond_side(const MaskFace& face, const Vec3& normal, masking::Polygon& out);

}  // namespace gridcull
