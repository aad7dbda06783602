// What `run`, `check` and `info` share: a scene, its frames, the grid and the method.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/grid/choose_lattice.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/service/file_roles.h"
#include "gridcull/service/static_world.h"
#include "gridcull/service/survey.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/replay.h"
#include "gridcull/sim/scene.h"

namespace CLI {
class App;
}

namespace gridcull {

struct WorldOptions {
  std::string scene{};
  std::string frames{};
  std::optional<double> cell{};  ///< metres; overrides the scene's
  std::uint64_t max_memory = MethodOptions{}.max_memory;
  // Not for `info`:
  std::string method{default_method()};
  int threads = 1;
  std::string tbv = MethodOptions{}.tbv;
  bool pull = false;
  std::string resolution{};  ///< R or WxH; "": the method's default
  std::string baked{};       ///< file that gridcull bake wrote; "": none
  double view_box = MethodOptions{}.view_box;
  std::string bounds{};  ///< a name of core/bound_kind.h; "": the method's default
  int occluders = MethodOptions{}.occluders;
  std::string store{};  ///< dense or openvdb; "": openvdb where the scene has a static volume, else dense
  std::optional<std::uint64_t> static_memory{};  ///< bytes; none: all static cells are kept
  std::string criteria{MethodOptions{}.criteria};
  std::string unions{MethodOptions{}.unions};
  std::string overlap{MethodOptions{}.overlap};
};

/// The lattice; a refusal of the cell begins with where it comes from: "--cell", "s.json: /grid/cell".
Lattice make_lattice(int dimension, const Bounds& bounds, double cell, std::uint64_t max_memory,
                     const std::string& source, Room room = Room::whole);

/// SCENE and, where they are named, --frames and --baked.
std::vector<NamedFile> input_files(const WorldOptions& options);

/// `--bounds` by name. Throws Error(usage).
BoundKind parse_bounds(const std::string& name);

/// SCENE, --frames, --cell and --max-memory.
void add_scene_options(CLI::App& command, WorldOptions& options);
/// --method, --threads, --tbv, --pull, and the settings of single methods.
void add_method_options(CLI::App& command, WorldOptions& options);

/// A scene that was read, and the grid for it.
struct PreparedWorld {
  Scene scene;
  std::optional<Survey> survey;  ///< where the bounds or cell had to be derived, or it was asked for
  LatticeChoice choice;
  Lattice lattice;
  std::optional<StaticVolume> volume{};
  StoreKind store = StoreKind::dense;
};

/// Reads and chooses. Throws what readers throw and Error(limit) when the grid needs more than
/// max_memory, whatever the method will be.
PreparedWorld prepare_world(const WorldOptions& options, bool always_survey = false);

/// The same for a scene that is in memory; options.scene is its name.
PreparedWorld prepare_scene(const WorldOptions& options, Scene scene, bool always_survey = false);

/// What the method is told, but for its resolution and a baked file.
MethodOptions method_options(const WorldOptions& options, const PreparedWorld& world);

/// The method on that grid.
std::unique_ptr<Culler> make_culler(const WorldOptions& options, const PreparedWorld& world);

/// The frames file, nothing where none is named.
std::unique_ptr<FrameReader> open_frames(const WorldOptions& options, const PreparedWorld& world);

/// How many frames a progress bar is for; nothing where that is not known or nobody looks.
std::optional<std::uint64_t> expected_frames(const WorldOptions& options, const PreparedWorld& world);

inline Feed feed_of(const WorldOptions& options) { return options.pull ? Feed::pull : Feed::push; }

/// "50 x 30 x 50 cells of 2 m".
std::string lattice_text(const Lattice& lattice);

}  // namespace gridcull
