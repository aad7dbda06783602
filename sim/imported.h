// What importers have in common: whom to give a viewer, and what comes out.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// Takes the frames of an import in their order.
using FrameSink = std::function<void(const Frame&)>;

/// Which movers carry a viewer (its object's id is its viewer id).
struct ViewerChoice {
  bool all = true;
  /// Not all: keep this many alive, filled up by the lowest ids that carry none.
  std::optional<std::uint64_t> count{};
  /// Not all and no count: these, by the imported file's own ids.
  std::vector<std::string> names{};
};

/// "all", a number, or ids with commas ("17,18"; a single id that looks like a number: "17,"). Throws
/// Error(usage).
ViewerChoice parse_viewer_choice(std::string_view text);

struct Imported {
  Scene scene{};                     ///< static objects, bounds; movers come and go in the frames
  std::vector<std::string> notes{};  ///< one line each: what was skipped and why
  std::uint64_t frames = 0;
  std::uint64_t movers = 0;  ///< different ones over all frames
};

}  // namespace gridcull
