#include "gridcull/service/svg_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace gridcull {

SvgFrame frame_for(const View& view, const Lattice& lattice, const Vec2& corner, double greatest_side) {
  const Bounds box = lattice.box();
  const Vec3& eye = view.pose.position;
  Bounds crop;
  for (int axis = 0; axis < 2; ++axis) {
    const double pad = 0.02 * std::max(box.size().x, box.size().y);
    const double low = box.min[axis] - pad, high = box.max[axis] + pad;
    const double reach = 1.04 * view.range;  // infinite without a range
    crop.min[axis] = std::min(eye[axis] - 0.02 * view.range, std::max(low, eye[axis] - reach));
    crop.max[axis] = std::max(eye[axis] + 0.02 * view.range, std::min(high, eye[axis] + reach));
    if (!std::isfinite(view.range)) {
      crop.min[axis] = std::min(eye[axis] - pad, low);
      crop.max[axis] = std::max(eye[axis] + pad, high);
    }
  }
  crop.min.z = crop.max.z = 0.0;
  SvgFrame frame{crop, 1.0, corner};
  frame.scale = greatest_side / std::max(crop.size().x, crop.size().y);
  return frame;
}

std::string px(double value) {
  char buffer[48];
  std::snprintf(buffer, sizeof buffer, "%.1f", value);
  std::string text = buffer;
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string escaped(const std::string& text) {
  // XML must be UTF-8, and knows control characters in no way but as tab and line ends.
  const std::string json = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string out;
  for (const char c : nlohmann::json::parse(json).get<std::string>()) {
    if (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') {
      out += "\uFFFD";
      continue;
    }
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string outline_path(const SvgFrame& frame, std::span<const Vec2> points, bool closed) {
  std::string path;
  for (const Vec2& p : points) {
    path += path.empty() ? "M" : "L";
    path += px(frame.x(p.x)) + " " + px(frame.y(p.y));
  }
  if (closed && !path.empty()) path += "z";
  return path;
}

}  // namespace gridcull
