// The kernels of the coverage mask: what they work on, and one table of them for each instruction set. Plain
// data only: these types cross into files that are compiled for wider registers.
//
// Pixels. A face has width x height pixels; pixel (i, j) is the closed square [i, i+1] x [j, j+1]. A direction d
// (world axes, any length) with form_w . d > 0 falls on (form_x . d, form_y . d) / (form_w . d).
// Blocks. 64 x 8 pixels, eight words, a word a row, lowest bit leftmost: one cache line. `full` has one bit a
// block, in words of 64 blocks along a row of blocks; `columns` a word a block, the eight rows and-ed. Bits beyond the
// face's edge are set from the start.
#pragma once

#include <cstdint>

#include "gridcull/grid/instruction_set.h"

namespace gridcull::masking {

inline constexpr int block_width = 64;
inline constexpr int block_height = 8;
/// 64 rays, four more corners from clipping, up to a multiple of eight.
inline constexpr int max_vertices = 72;

/// One face as the kernels see it.
struct Window {
  double form_x[3], form_y[3], form_w[3];
  int width = 0, height = 0;          ///< pixels
  double guard_x = 0, guard_y = 0;    ///< pixels from the middle, below 2^18: beyond them polygons are clipped
  double slack_x = 0, slack_y = 0;    ///< bound of the error of a form over the largest coordinate of d
  double margin_x = 0, margin_y = 0;  ///< pixels: see coverage_mask.cpp
  /// A pixel's corner is the direction corner + x per_x + y per_y; `step`: the length of per_x.
  double corner[3], per_x[3], per_y[3], step = 0;
  int blocks = 0;                    ///< along a row
  int strips = 0;                    ///< rows of blocks
  int coarse = 0;                    ///< words of `full` for a strip
  int open_blocks = 0;               ///< blocks that are not full; 0: the three below may hold anything
  std::uint64_t* words = nullptr;    ///< blocks * strips * 8
  std::uint64_t* full = nullptr;     ///< coarse * strips
  std::uint64_t* columns = nullptr;  ///< blocks * strips; eight words behind them can be read
};

/// A convex polygon on a face, its corners in pixels, multiples of 2^-32, within the guards; beyond `count` the
/// last corner again, up to a multiple of eight.
struct alignas(64) Polygon {
  double x[max_vertices];
  double y[max_vertices];
  int count = 0;
  double margin_x = 0, margin_y = 0;  ///< pixels that the corners may be off
};

/// The cone that up to seven rays span, with what all faces need of it (mask_cone_body.h).
struct alignas(64) Cone {
  static constexpr int max_rays = 7;
  double x[8], y[8], z[8];     ///< the rays, the last one again beyond `count`
  double nx[8], ny[8], nz[8];  ///< inward normals of the planes through lane k's ray and the next one
  double margin[8];            ///< how far inside a plane a direction must be
  double low[3], high[3];      ///< bounds of the rays
  int count;
};

/// The outline of a ball on a face: x = alpha + beta y -+ gamma sqrt((high_y - y)(y - low_y)), all in pixels.
struct Ellipse {
  double low_x, high_x, low_y, high_y;
  double y_at_low_x, y_at_high_x;
  double alpha, beta, gamma;
  double tolerance;  ///< bound of the error of y_at_*
};

/// Pixel columns [x0, x1), rows [y0, y1), within the face.
struct Rectangle {
  int x0, x1, y0, y1;
};

enum class Projection {
  outside,  ///< on the far side of one of the face's sides: touches no pixel
  inside,   ///< wholly within the guards: projected
  crossing  ///< neither: has to be clipped first
};

/// From where balls are looked at, and at what.
struct Outlook {
  double apex[3];    ///< the viewpoint, world
  double apex_size;  ///< sum of its magnitudes
  double rounding;   ///< of a ball's place relative to the viewpoint, times the coordinates that go in
  double limit;      ///< what has a greater key is left out
  bool cube;         ///< six faces with world axes; else one window with these:
  double right[3], up[3], forward[3];
  double tangent_x, tangent_y, scale_x, scale_y, norm_x, norm_y;  ///< as in MaskFace, of all faces
};

/// Up to eight balls in the world.
struct Balls {
  alignas(64) double x[8]{}, y[8]{}, z[8]{}, radius[8]{};
  alignas(64) double wide[8]{}, tall[8]{};  ///< upright objects: 255ths of the radius that they fill; else wide < 0
  int count = 0;
};

/// What is to know of each of them (mask_batch_body.h); lanes of what is left out hold anything.
struct Batch {
  alignas(64) double key[8];
  double x[8], y[8], z[8], wide[8], tall[8];  ///< the box about it: its middle relative to the viewpoint, its halves
  int face[8], x0[8], x1[8], y0[8], y1[8];    ///< pixels it may touch; Rectangle, but for x0 >= x1: none
  unsigned kept;                              ///< a bit each: neither beyond the limit nor beside the window
  unsigned single;                            ///< its pixels are told; the others have to be asked about one by one
};

struct Kernels {
  /// Rays (three doubles each, 3 .. 64 of them) onto the face.
  Projection (*project)(const Window&, const double* rays, int count, Polygon& out);
  /// An axis-aligned box (low, then high) as the rectangle of pixels it may touch; `inside` when that is valid.
  Projection (*project_box)(const Window&, const double* low, const double* high, Rectangle& out);
  /// Keys and rectangles of up to eight balls; `window`: the one window, or any face of the cube.
  void (*place_balls)(const Outlook&, const Window& window, const Balls&, Batch& out);
  /// Sets the pixels that lie wholly inside; returns how many blocks became full. Each counts the strips that it
  /// works on in `strips`.
  int (*cover_polygon)(Window&, const Polygon&, std::uint64_t& strips);
  /// Sets up a cone of 3 .. 7 rays in cyclic order; false where they spread too far: it has to be clipped.
  bool (*span_cone)(const double* rays, int count, Cone& out);
  int (*cover_cone)(Window&, const Cone&, std::uint64_t& strips);
  int (*cover_ellipse)(Window&, const Ellipse&, std::uint64_t& strips);
  /// Whether a pixel that the shape may touch is uncovered.
  bool (*open_polygon)(const Window&, const Polygon&, std::uint64_t& strips);
  bool (*open_ellipse)(const Window&, const Ellipse&, std::uint64_t& strips);
  bool (*open_rectangle)(const Window&, const Rectangle&, std::uint64_t& strips);
};

namespace scalar {
const Kernels& kernels();
}
#if defined(__x86_64__)
namespace avx2 {
const Kernels& kernels();
}
namespace avx512 {
const Kernels& kernels();
}
#endif

/// The table of a supported set.
inline const Kernels& kernels_of(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return avx512::kernels();
  if (set == InstructionSet::avx2) return avx2::kernels();
#endif
  (void)set;
  return scalar::kernels();
}

}  // namespace gridcull::masking
