// The scenes of a benchmark: made ones by name with parameters, and files.
//
//   spheres:5000  discs:300  town:400  maze:20  city:50:5000 (blocks a side, cars)
//   ... and any of  :viewers=V  :range=METRES  :cell=METRES  :seed=S  behind them, spheres also  :hidden=N  :moving=M
//   FOLDER or FOLDER/scene.json (with its frames.jsonl where there is one), or SCENE@FRAMES
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "gridcull/grid/choose_lattice.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// What a name says.
struct BenchSceneName {
  std::string kind{};                     ///< "spheres" ...; "" for files
  GenerateOptions options{};              ///< of a made scene
  std::uint32_t hidden = 0;               ///< spheres: so many small movers inside a solid box in the middle
  bool boxed = false;                     ///< `hidden` was named: the box is there, be it empty
  std::optional<std::uint32_t> moving{};  ///< spheres: only so many move, the others are static
  std::string scene_path{};               ///< of files
  std::string frames_path{};              ///< "": one frame
};

/// Throws Error(usage) for an unknown kind or parameter, Error(io) where a path leads nowhere.
BenchSceneName parse_bench_scene(const std::string& text);

/// A scene that can be played from the start as often as is wanted.
struct BenchScene {
  std::string label{};  ///< as it was asked for
  BenchSceneName name{};
  Scene scene{};
  LatticeChoice choice{};
  double default_cell = 1.0;  ///< metres
  std::uint64_t still = 0;    ///< a scene file without frames: asked so often as it stands; 0: once

  /// From frame 0 on. Throws what readers throw.
  std::unique_ptr<FrameSource> frames() const;
  /// The same name without counts of objects, or without viewers: rows that belong on one curve.
  std::string family_of_objects() const;
  std::string family_of_viewers() const;
};

/// Reads or makes it.
BenchScene open_bench_scene(const std::string& text);

}  // namespace gridcull
