// A folder with a scene and its frames, as `gridcull make` and `gridcull import` write it.
#pragma once

#include <memory>
#include <string>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// Writes DIR/scene.json and DIR/frames.jsonl, both or none: without commit() no file is left, nor a
/// folder that was made for them. Throws Error(io).
class WorldFiles {
 public:
  WorldFiles(const std::string& folder, int dimension);
  ~WorldFiles();
  WorldFiles(WorldFiles&&) noexcept;
  WorldFiles& operator=(WorldFiles&&) noexcept;

  std::string scene_path() const;
  std::string frames_path() const;

  void write(const Frame& frame);
  void commit(const Scene& scene);

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull
