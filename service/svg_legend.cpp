#include "gridcull/service/svg_legend.h"

#include "gridcull/service/svg_frame.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

constexpr double line_height = 25.0, sample_width = 28.0;

std::string sample(const LegendEntry& entry, double x, double y) {
  const std::string shape = " class=\"" + entry.style + "\"/>\n";
  switch (entry.sample) {
    case LegendEntry::Sample::area:
      return "<rect x=\"" + px(x) + "\" y=\"" + px(y - 7) + "\" width=\"" + px(sample_width) + "\" height=\"14\"" +
             shape;
    case LegendEntry::Sample::line: return "<path d=\"M" + px(x) + " " + px(y) + "h" + px(sample_width) + "\"" + shape;
    case LegendEntry::Sample::disc:
      return "<circle cx=\"" + px(x + 0.5 * sample_width) + "\" cy=\"" + px(y) + "\" r=\"7\"" + shape;
  }
  return {};
}

}  // namespace

std::string svg_legend(const std::vector<LegendEntry>& entries, const Vec2& corner) {
  std::string svg;
  double y = corner.y;
  for (const LegendEntry& entry : entries) {
    svg += sample(entry, corner.x, y);
    svg += "<text x=\"" + px(corner.x + sample_width + 10) + "\" y=\"" + px(y + 4.5) + "\">" + escaped(entry.text) +
           "</text>\n";
    y += line_height;
  }
  return svg;
}

std::string svg_scale_bar(double pixels_a_metre, double widest, const Vec2& left) {
  double metres = 1e-3;
  for (double power = 1e-3; power < 1e10; power *= 10.0) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (step * power * pixels_a_metre <= widest) metres = step * power;
    }
  }
  return "<path d=\"M" + px(left.x) + " " + px(left.y - 5) + "v5h" + px(metres * pixels_a_metre) +
         "v-5\" class=\"scale\"/>\n<text x=\"" + px(left.x) + "\" y=\"" + px(left.y + 16) + "\">" +
         number_text(metres) + " m</text>\n";
}

std::string svg_style() {
  return R"(<style>
text{font:14px "Helvetica Neue",Helvetica,Arial,"DejaVu Sans",sans-serif;fill:#2b3440}
.title{font-size:20px;font-weight:bold}
.subtitle{fill:#5d6775}
.page{fill:#fbfaf7}
.map{fill:#f1f2f4}
.border{fill:none;stroke:#b9c0ca}
.visited{fill:#fff3c2}
.met{fill:#e6e9ee}
.region{fill:#ffedad;stroke:#e8c95c;stroke-width:.8}
.hidden{fill:#c6ccd8}
.touched{fill:#5aa9e6;fill-opacity:.38}
.opaque{fill:#3b4554}
.tbvcell{fill:#a56cd6;fill-opacity:.30}
.sight{fill:#ff9f1c;fill-opacity:.85}
.lattice{fill:none;stroke:#1f2a3a;stroke-opacity:.09;stroke-width:.6}
.volume{fill:none;stroke:#e07a00;stroke-width:1.8}
.tbv{fill:none;stroke:#7b2fbf;stroke-width:1.4;stroke-dasharray:5 3}
.revealed{fill:none;stroke:#e0218a;stroke-width:1.8}
.seen{fill:#19b394;fill-opacity:.55;stroke:#00594a;stroke-width:1.8;stroke-linejoin:round}
.unseen{fill:#ffffff;fill-opacity:.25;stroke:#58636f;stroke-width:1.3;stroke-dasharray:3 2.2;stroke-linejoin:round}
.beyond{fill:#ffffff;fill-opacity:.55;stroke:#b4bcc7;stroke-width:1;stroke-linejoin:round}
.chain{fill:none}
.own{fill:#d62828;fill-opacity:.35;stroke:#8f1414;stroke-width:1.6;stroke-linejoin:round}
.eye{fill:#d62828;stroke:#ffffff;stroke-width:1.5}
.scale{fill:none;stroke:#2b3440;stroke-width:1.6}
</style>
)";
}

}  // namespace gridcull
