// The paper that a picture is drawn on: which part of the world, at what scale, and small SVG helpers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/vec.h"
#include "gridcull/core/view.h"
#include "gridcull/grid/lattice.h"

namespace gridcull {

/// Maps metres (y up) to pixels (y down) of the picture's map area.
struct SvgFrame {
  Bounds crop{};       ///< the part of the world that is shown, metres
  double scale = 1.0;  ///< pixels a metre
  Vec2 corner{0.0};    ///< the map's upper left corner, pixels

  double x(double metres) const { return corner.x + (metres - crop.min.x) * scale; }
  double y(double metres) const { return corner.y + (crop.max.y - metres) * scale; }
  double width() const { return crop.size().x * scale; }
  double height() const { return crop.size().y * scale; }
};

/// What the viewer can reach, or the whole lattice where nothing limits it; the viewer is always inside.
SvgFrame frame_for(const View& view, const Lattice& lattice, const Vec2& corner, double greatest_side);

/// Pixels with one decimal, no trailing zero.
std::string px(double value);

/// Text with & < > " replaced, and what may not stand in XML (bytes that are no UTF-8, control characters) by U+FFFD.
std::string escaped(const std::string& text);

/// Path data of an outline in pixels.
std::string outline_path(const SvgFrame& frame, std::span<const Vec2> points, bool closed);

}  // namespace gridcull
