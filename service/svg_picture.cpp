#include "gridcull/service/svg_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "gridcull/core/view_volume.h"
#include "gridcull/service/slice.h"
#include "gridcull/service/svg_frame.h"
#include "gridcull/service/svg_legend.h"
#include "gridcull/service/text.h"

namespace gridcull {
namespace {

constexpr double margin = 22.0, header = 74.0, map_side = 820.0, strip = 262.0, least_height = 480.0;
constexpr double least_cell = 5.0;    // pixels; finer lattices are not drawn as lines
constexpr double least_object = 5.0;  // pixels; smaller objects are drawn as dots of this diameter

enum class Fate { seen, unseen, beyond, own };
constexpr const char* style_of(Fate fate) {
  constexpr std::array names{"seen", "unseen", "beyond", "own"};
  return names[static_cast<std::size_t>(fate)];
}

struct LayerStyle {
  CellLayer layer;
  const char* style;
  const char* text;
};
/// In drawing order.
constexpr std::array layer_styles{
    LayerStyle{CellLayer::visited, "visited", "cells the viewer looks into"},
    LayerStyle{CellLayer::hidden, "hidden", "hidden cells"},
    LayerStyle{CellLayer::touched, "touched", "cells that objects touch (I)"},
    LayerStyle{CellLayer::tbv, "tbvcell", "cells of TBVs (T)"},
    LayerStyle{CellLayer::opaque, "opaque", "opaque cells (O)"},
    LayerStyle{CellLayer::line_of_sight, "sight", "line of sight (seed cells)"},
};

/// Where it is known what the viewer sees, cells that it merely looked into stand back.
constexpr LayerStyle met_style{CellLayer::visited, "met", "cells of the index it looked into"};

/// One picture being written.
class Painter {
 public:
  Painter(const Picture& picture, const PictureSink* sink)
      : picture_(picture),
        sink_(sink),
        frame_(frame_for(picture.view, picture.lattice, {margin, header}, map_side)),
        volume_(picture.view, picture.lattice.dimension()) {}

  std::string svg();

 private:
  const CellPlane& plane(CellLayer layer) const;
  const LayerStyle& layer_style(const LayerStyle& entry) const {
    return entry.layer == CellLayer::visited && !sink_->region().empty() ? met_style : entry;
  }
  Fate fate_of(const Object& object) const;
  bool in_crop(const Vec2& low, const Vec2& high) const;
  std::string cells() const;
  std::string region() const;
  std::string lattice_lines() const;
  std::string objects();
  std::string object_svg(const Object& object, Fate fate) const;
  std::string dot(const Vec2& centre, double diameter, const char* style) const;
  std::string tbvs();
  std::string volume() const;
  std::string eye() const;
  std::vector<LegendEntry> legend() const;

  const Picture& picture_;
  const PictureSink* sink_;
  SvgFrame frame_;
  ViewVolume volume_;
  std::array<std::size_t, 4> shown_{};  // objects by fate
  std::size_t tbvs_shown_ = 0, revealed_shown_ = 0;
};

const CellPlane& Painter::plane(CellLayer layer) const {
  const Lattice& lattice = picture_.lattice;
  return sink_->plane(layer, lattice.dimension() == 2 ? 0 : lattice.index(2, picture_.view.pose.position.z));
}

Fate Painter::fate_of(const Object& object) const {
  if (object.id == picture_.view.rides) return Fate::own;
  if (std::binary_search(picture_.visible.begin(), picture_.visible.end(), object.id)) return Fate::seen;
  return volume_.may_touch(object.shape, object.pose) ? Fate::unseen : Fate::beyond;
}

bool Painter::in_crop(const Vec2& low, const Vec2& high) const {
  return low.x <= frame_.crop.max.x && high.x >= frame_.crop.min.x && low.y <= frame_.crop.max.y &&
         high.y >= frame_.crop.min.y;
}

std::string Painter::cells() const {
  if (!sink_) return {};
  const Lattice& lattice = picture_.lattice;
  const double side = lattice.cell() * frame_.scale;
  char scale[64];
  std::snprintf(scale, sizeof scale, "%.6g -%.6g", side, side);
  std::string svg = "<g transform=\"translate(" + px(frame_.x(lattice.origin().x)) + " " +
                    px(frame_.y(lattice.origin().y)) + ") scale(" + scale + ")\">\n";
  for (const LayerStyle& entry : layer_styles) {
    std::vector<CellRect> rects = plane(entry.layer).merged();
    std::erase_if(rects, [&](const CellRect& r) {
      return !in_crop({lattice.boundary(0, r.x0), lattice.boundary(1, r.y0)},
                      {lattice.boundary(0, r.x1), lattice.boundary(1, r.y1)});
    });
    if (!rects.empty())
      svg += "<path class=\"" + std::string(layer_style(entry).style) + "\" d=\"" + path_of(rects) + "\"/>\n";
  }
  return svg + "</g>\n";
}

std::string Painter::region() const {
  if (!sink_ || sink_->region().empty()) return {};
  return "<path class=\"region\" d=\"" + outline_path(frame_, sink_->region(), true) + "\"/>\n";
}

std::string Painter::lattice_lines() const {
  const Lattice& lattice = picture_.lattice;
  if (!sink_ || lattice.cell() * frame_.scale < least_cell) return {};
  std::string path;
  const Bounds box = lattice.box();
  const double x0 = std::max(box.min.x, frame_.crop.min.x), x1 = std::min(box.max.x, frame_.crop.max.x);
  const double y0 = std::max(box.min.y, frame_.crop.min.y), y1 = std::min(box.max.y, frame_.crop.max.y);
  for (std::int64_t i = lattice.index(0, x0); lattice.boundary(0, i) <= x1; ++i) {
    path += "M" + px(frame_.x(lattice.boundary(0, i))) + " " + px(frame_.y(y1)) + "V" + px(frame_.y(y0));
  }
  for (std::int64_t i = lattice.index(1, y0); lattice.boundary(1, i) <= y1; ++i) {
    path += "M" + px(frame_.x(x0)) + " " + px(frame_.y(lattice.boundary(1, i))) + "H" + px(frame_.x(x1));
  }
  return "<path class=\"lattice\" d=\"" + path + "\"/>\n";
}

std::string Painter::dot(const Vec2& centre, double diameter, const char* style) const {
  return "<circle class=\"" + std::string(style) + "\" cx=\"" + px(frame_.x(centre.x)) + "\" cy=\"" +
         px(frame_.y(centre.y)) + "\" r=\"" + px(0.5 * diameter) + "\"/>\n";
}

std::string Painter::object_svg(const Object& object, Fate fate) const {
  const Slice slice = slice_of(object, picture_.view.pose.position.z);
  if (slice.empty()) return {};
  Bounds box;
  if (slice.radius > 0.0) box.add_ball({slice.centre.x, slice.centre.y, 0.0}, slice.radius);
  std::string path;
  for (const auto* lines : {&slice.rings, &slice.chains}) {
    for (const auto& line : *lines) {
      for (const Vec2& p : line) box.add({p.x, p.y, 0.0});
      path += outline_path(frame_, line, lines == &slice.rings);
    }
  }
  if (!in_crop({box.min.x, box.min.y}, {box.max.x, box.max.y})) return {};
  const double greatest = std::max(box.size().x, box.size().y) * frame_.scale;
  if (greatest < least_object) return dot({box.centre().x, box.centre().y}, least_object, style_of(fate));
  if (slice.radius > 0.0) return dot(slice.centre, 2.0 * slice.radius * frame_.scale, style_of(fate));
  const std::string style = std::string(style_of(fate)) + (slice.rings.empty() ? " chain" : "");
  return "<path class=\"" + style + "\" fill-rule=\"evenodd\" d=\"" + path + "\"/>\n";
}

std::string Painter::objects() {
  // What matters most is drawn last; within a kind by id, so that the same answer gives the same file.
  std::vector<const Object*> order;
  for (const Object& object : picture_.objects) order.push_back(&object);
  std::sort(order.begin(), order.end(), [](const Object* a, const Object* b) { return a->id < b->id; });
  std::array<std::string, 4> groups;
  for (const Object* object : order) {
    const Fate fate = fate_of(*object);
    const std::string text = object_svg(*object, fate);
    if (text.empty()) continue;
    groups[static_cast<std::size_t>(fate)] += text;
    ++shown_[static_cast<std::size_t>(fate)];
  }
  std::string svg;
  for (const Fate fate : {Fate::beyond, Fate::unseen, Fate::seen, Fate::own}) {
    svg += groups[static_cast<std::size_t>(fate)];
  }
  return svg;
}

std::string Painter::tbvs() {
  if (!sink_) return {};
  const double z = picture_.lattice.dimension() == 3 ? picture_.view.pose.position.z : 0.0;
  std::string svg;
  for (const PictureSink::Tbv& tbv : sink_->tbvs()) {
    const double height = picture_.lattice.dimension() == 3 ? z - tbv.centre.z : 0.0;
    const double squared = tbv.radius * tbv.radius - height * height;
    if (squared <= 0.0) continue;
    const double radius = std::sqrt(squared);
    const Vec2 centre(tbv.centre.x, tbv.centre.y);
    if (!in_crop(centre - Vec2(radius), centre + Vec2(radius))) continue;
    ++(tbv.revealed ? revealed_shown_ : tbvs_shown_);
    svg += dot(centre, 2.0 * radius * frame_.scale, tbv.revealed ? "revealed" : "tbv");
  }
  return svg;
}

std::string Painter::volume() const {
  const double reach = 2.0 * std::hypot(frame_.crop.size().x, frame_.crop.size().y);
  const std::vector<Vec2> outline = view_outline(picture_.view, picture_.lattice.dimension(), reach);
  if (outline.empty()) return {};
  return "<path class=\"volume\" d=\"" + outline_path(frame_, outline, true) + "\"/>\n";
}

/// A dot with a pointer along the viewing direction.
std::string Painter::eye() const {
  const double x = frame_.x(picture_.view.pose.position.x), y = frame_.y(picture_.view.pose.position.y);
  Vec2 ahead(volume_.axis().x, -volume_.axis().y);
  const double length = glm::length(ahead);
  std::string svg;
  if (length > 1e-9) {
    ahead /= length;
    const Vec2 side(-ahead.y, ahead.x), tip = 19.0 * ahead, left = 5.0 * side, right = -5.0 * side;
    svg += "<path class=\"eye\" d=\"M" + px(x + left.x) + " " + px(y + left.y) + "L" + px(x + tip.x) + " " +
           px(y + tip.y) + "L" + px(x + right.x) + " " + px(y + right.y) + "z\"/>\n";
  }
  return svg + "<circle class=\"eye\" cx=\"" + px(x) + "\" cy=\"" + px(y) + "\" r=\"6\"/>\n";
}

std::vector<LegendEntry> Painter::legend() const {
  using Sample = LegendEntry::Sample;
  const auto count = [&](Fate fate) { return std::to_string(shown_[static_cast<std::size_t>(fate)]); };
  std::vector<LegendEntry> entries{{Sample::disc, "eye", "viewer " + std::to_string(picture_.view.viewer)}};
  if (shown_[static_cast<std::size_t>(Fate::own)] > 0) entries.push_back({Sample::area, "own", "what it rides on"});
  entries.push_back({Sample::line, "volume", "view volume"});
  entries.push_back({Sample::area, "seen", "objects it may see: " + count(Fate::seen)});
  entries.push_back({Sample::area, "unseen", "hidden objects: " + count(Fate::unseen)});
  entries.push_back({Sample::area, "beyond", "outside the view: " + count(Fate::beyond)});
  if (!sink_) return entries;
  if (!sink_->region().empty()) entries.push_back({Sample::area, "region", "what it sees, exactly"});
  for (const LayerStyle& entry : layer_styles) {
    if (!plane(entry.layer).empty()) {
      entries.push_back({Sample::area, layer_style(entry).style, layer_style(entry).text});
    }
  }
  if (tbvs_shown_ > 0) {
    entries.push_back({Sample::disc, "tbv", "TBVs of hidden movers: " + std::to_string(tbvs_shown_)});
  }
  if (revealed_shown_ > 0) {
    entries.push_back({Sample::disc, "revealed", "TBVs just revealed: " + std::to_string(revealed_shown_)});
  }
  return entries;
}

std::string Painter::svg() {
  const double width = margin + frame_.width() + margin + strip;
  const double height = header + std::max(frame_.height(), least_height) + margin;
  const std::string size = "width=\"" + px(width) + "\" height=\"" + px(height) + "\"";
  const std::string map = "x=\"" + px(margin) + "\" y=\"" + px(header) + "\" width=\"" + px(frame_.width()) +
                          "\" height=\"" + px(frame_.height()) + "\"/>";
  const double strip_left = margin + frame_.width() + margin;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " viewBox=\"0 0 " + px(width) + " " +
                    px(height) + "\">\n<title>" + escaped(picture_.title) + "</title>\n" + svg_style();
  svg += "<clipPath id=\"map\"><rect " + map + "</clipPath>\n<rect class=\"page\" " + size + "/>\n";
  svg += "<text class=\"title\" x=\"" + px(margin) + "\" y=\"34\">" + escaped(picture_.title) + "</text>\n";
  svg += "<text class=\"subtitle\" x=\"" + px(margin) + "\" y=\"58\">" + escaped(picture_.subtitle) + "</text>\n";
  svg += "<g clip-path=\"url(#map)\">\n<rect class=\"map\" " + map + "\n";
  svg += cells() + region() + lattice_lines() + volume() + objects() + tbvs() + eye();
  svg += "</g>\n<rect class=\"border\" " + map + "\n" + svg_legend(legend(), {strip_left, header + 12});
  svg += svg_scale_bar(frame_.scale, strip - 2.0 * margin, {strip_left, height - margin - 20});
  return svg + "</svg>\n";
}

}  // namespace

void PictureSink::cells(CellLayer layer, const Vec3& low, const Vec3& high) {
  // Boundaries are multiples of the cell up to rounding, but for boxes about objects: of those, cells that are wholly
  // within are hidden, and cells that they touch are whatever else.
  const double far = std::max({std::fabs(low.x), std::fabs(low.y), std::fabs(high.x), std::fabs(high.y)});
  const double rounding = std::min(0.5 * lattice_.cell(), 1e-6 * lattice_.cell() + 0x1p-50 * far);
  const double inside = layer == CellLayer::hidden ? lattice_.cell() - rounding : rounding;
  const auto first = [&](int axis) { return lattice_.index(axis, low[axis] + inside); };
  const auto end = [&](int axis) { return lattice_.index(axis, high[axis] - inside) + 1; };
  const bool flat = lattice_.dimension() == 2;
  if (first(0) >= end(0) || first(1) >= end(1)) return;
  for (std::int64_t z = flat ? 0 : first(2); z < (flat ? 1 : end(2)); ++z) {
    planes_[{layer, z}].add({first(0), first(1), end(0), end(1)});
  }
}

const CellPlane& PictureSink::plane(CellLayer layer, std::int64_t z) const {
  static const CellPlane nothing;
  const auto found = planes_.find({layer, z});
  return found == planes_.end() ? nothing : found->second;
}

void PictureSink::tbv(ObjectId object, const Vec3& centre, double radius, bool revealed) {
  tbvs_.push_back({object, centre, radius, revealed});
}

std::string svg_picture(const Picture& picture, const PictureSink* sink) { return Painter(picture, sink).svg(); }

}  // namespace gridcull
