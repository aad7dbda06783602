#include "gridcull/sim/imported.h"

#include <charconv>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

[[noreturn]] void refuse(std::string_view text) {
  throw Error(ErrorCode::usage,
              "viewers: expected \"all\", a number or ids with commas, found \"" + std::string(text) + "\"");
}

}  // namespace

ViewerChoice parse_viewer_choice(std::string_view text) {
  ViewerChoice out;
  if (text == "all") return out;
  out.all = false;
  std::uint64_t count = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (fault == std::errc{} && end == text.data() + text.size()) {
    out.count = count;
    return out;
  }
  if (text.ends_with(',')) text.remove_suffix(1);
  for (std::string_view rest = text;;) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = rest.substr(0, comma);
    if (name.empty()) refuse(text);
    out.names.emplace_back(name);
    if (comma == std::string_view::npos) return out;
    rest.remove_prefix(comma + 1);
  }
}

}  // namespace gridcull
