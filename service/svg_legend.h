// The strip beside the map: what each colour means, and a scale bar.
#pragma once

#include <string>
#include <vector>

#include "gridcull/core/vec.h"

namespace gridcull {

/// One line of the legend. `style` is the class of the sample (see svg_style()).
struct LegendEntry {
  enum class Sample { area, line, disc } sample;
  std::string style;
  std::string text;
};

/// Drawn from `corner` (pixels) downwards.
std::string svg_legend(const std::vector<LegendEntry>& entries, const Vec2& corner);

/// A bar of a round number of metres, at most `widest` pixels wide, its left end at `left`.
std::string svg_scale_bar(double pixels_a_metre, double widest, const Vec2& left);

/// The style sheet: every colour of the picture stands here.
std::string svg_style();

}  // namespace gridcull
