#include "gridcull/service/resolution.h"

#include <charconv>
#include <string_view>

#include "gridcull/service/text.h"

namespace gridcull {
namespace {

constexpr int least_edge = 8, most = 8192;  // a mask is made of blocks of 8 x 8 pixels

int side(std::string_view text, int least, const std::string& whole, const std::string& option) {
  int value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || value < least || value > most) {
    throw option_error(option, "R of 8 .. 8192 pixels, or WxH of 1 .. 8192 rays each",
                       whole.empty() ? "nothing" : whole);
  }
  return value;
}

}  // namespace

Resolution parse_resolution(const std::string& text, const std::string& option) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) return {.edge = side(text, least_edge, text, option)};
  const std::string_view all(text);
  return {.width = side(all.substr(0, cross), 1, text, option), .height = side(all.substr(cross + 1), 1, text, option)};
}

std::string resolution_text(const Resolution& resolution) {
  if (resolution.edge > 0) return std::to_string(resolution.edge);
  if (resolution.width > 0) return std::to_string(resolution.width) + "x" + std::to_string(resolution.height);
  return "auto";
}

bool takes_edge(const MethodEntry& method) { return method.options.find("--resolution R") != std::string_view::npos; }
bool takes_picture(const MethodEntry& method) {
  return method.options.find("--resolution WxH") != std::string_view::npos;
}

void apply_resolution(const Resolution& resolution, const MethodEntry& method, MethodOptions& options) {
  const std::string name(method.info.name);
  if (resolution.edge > 0 && takes_picture(method)) {
    throw option_error("--resolution", "WxH for " + name, resolution_text(resolution));
  }
  if (resolution.width > 0 && takes_edge(method)) {
    throw option_error("--resolution", "R for " + name, resolution_text(resolution));
  }
  options.resolution = resolution.edge;
  options.rays_width = resolution.width;
  options.rays_height = resolution.height;
}

}  // namespace gridcull
