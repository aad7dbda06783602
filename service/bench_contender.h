// Who runs in a benchmark: a method with one setting and one number of threads.
#pragma once

#include <string>
#include <vector>

#include "gridcull/methods/catalog.h"
#include "gridcull/service/bench_bake.h"
#include "gridcull/service/bench_scene.h"
#include "gridcull/service/resolution.h"

namespace gridcull {

/// What the command line asks for; empty lists mean the defaults.
struct BenchChoice {
  std::vector<std::string> methods{};     ///< all that take the scene
  std::vector<int> threads{};             ///< 1; 1 and 2 for scenes with many viewers
  std::vector<Resolution> resolutions{};  ///< R for methods that take R, WxH for those that take WxH
  std::vector<double> cells{};            ///< metres; 2, 1 and 1/2 of the scene's
  std::vector<int> occluders{};           ///< 1 .. 64 each; 1, 2, 4, 8, 16, 32
  std::vector<BoundKind> bounds{};        ///< what objects are tested with; empty: the method's own choice
  std::uint64_t max_memory = MethodOptions{}.max_memory;
  std::vector<std::string> baked{};  ///< files; each is for the method and the world that it names
  bool bake = false;                 ///< methods that bake do it first, and their cost is told
};

struct Contender {
  const MethodEntry* method = nullptr;
  MethodOptions options{};
  std::string setting_name{};  ///< "cell", "resolution", "occluders" or ""
  std::string setting{};       ///< "2 m", "256", "128x72", "auto", "baked"
  bool is_default = true;      ///< the setting used where nobody asks for another
  bool to_bake = false;        ///< its file is still to be made
  BakeCost bake{};             ///< what that cost

  /// "voxel, cell 2 m, 1 thread"
  std::string label() const;
};

/// All contenders on a scene, in the order of the catalog or of the choice. Methods that do not take the scene's
/// dimension are left out.
std::vector<Contender> choose_contenders(const BenchScene& scene, const BenchChoice& choice);

}  // namespace gridcull
