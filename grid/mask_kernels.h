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
  int blocks = 0;                     ///< along a row
  int strips = 0;                     ///< rows of blocks
  int coarse = 0;                     ///< words of `full` for a strip
  int open_blocks = 0;                ///< blocks that are not full; 0: the three below may hold anything
  std::uint64_t* words = nullptr;     ///< blocks * strips * 8
  std::uint64_t* full = nullptr;      ///< coarse * strips
  std::uint64_t* columns = nullptr;   ///< blocks * strips; eight words behind them can be read
};

/// A convex polygon on a face, its corners in pixels, multiples of 2^-32, within the guards; beyond `count` the
/// last corner again, up to a multiple of eight.
struct alignas(64) Polygon {
  double x[max_vertices];
  double y[max_vertices];
  int count = 0;
  double margin_x = 0, margin_y = 0;  ///< pixels that the corners may be off
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

struct Kernels {
  /// Rays (three doubles each, 3 .. 64 of them) onto the face.
  Projection (*project)(const Window&, const double* rays, int count, Polygon& out);
  /// An axis-aligned box (low, then high) as the rectangle of pixels it may touch; `inside` when that is valid.
  Projection (*project_box)(const Window&, const double* low, const double* high, Rectangle& out);
  /// Sets the pixels that lie wholly inside; returns how many blocks became full. Each counts the strips that it
  /// works on in `strips`.
  int (*cover_polygon)(Window&, const Polygon&, std::uint64_t& strips);
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
