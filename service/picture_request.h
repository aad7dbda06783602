// `--picture FRAME:VIEWER:FILE.svg`: which moment is drawn, and its way from request to file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/sim/replay.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {

class PictureSink;

struct PictureRequest {
  std::uint64_t frame = 0;
  ViewerId viewer = no_id;
  std::string file{};
};

/// Throws Error(usage).
PictureRequest parse_picture_request(const std::string& text);

/// Draws the requested moments while a replay runs. Files are opened at once, so that one that cannot be
/// written is refused before the work, and appear on commit() only.
class Pictures {
 public:
  /// `label` stands in the titles: the scene's name.
  Pictures(const std::vector<std::string>& requests, std::string label);

  /// Takes the replay's next step, drawing on the way what is asked for in it; false at the end.
  bool step(Replay& replay, Culler& culler, const Lattice& lattice);

  /// After the last step: throws Error(usage) when a requested moment never came.
  void check() const;
  void commit();

 private:
  struct Item {
    PictureRequest request;
    TextWriter writer;
    bool drawn = false;
    std::string others{};  ///< viewers that are there instead
  };
  void draw(Item& item, const Replay& replay, const Culler& culler, const Lattice& lattice, const PictureSink* sink);

  std::vector<Item> items_{};
  std::string label_;
  std::uint64_t frames_ = 0;
};

}  // namespace gridcull
