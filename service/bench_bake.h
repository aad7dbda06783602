// What methods work out in advance, baked for a benchmark: time and bytes go beside its figures.
#pragma once

#include <cstdint>
#include <string>

#include "gridcull/methods/catalog.h"
#include "gridcull/service/bench_scene.h"

namespace gridcull {

/// What a bake cost.
struct BakeCost {
  double seconds = 0.0;  ///< 0: nothing was baked, or elsewhere
  int threads = 0;
  std::uint64_t bytes = 0;  ///< of the file
};

/// A folder for baked files that is gone with this object.
class BakeFolder {
 public:
  /// Throws Error(io).
  BakeFolder();
  ~BakeFolder();
  BakeFolder(const BakeFolder&) = delete;
  BakeFolder& operator=(const BakeFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Bakes with the method's standard settings into FILE. `options`: as for the method itself. Throws what the bake
/// throws, Stopped on Ctrl-C.
BakeCost bake_for_bench(const BenchScene& scene, const MethodEntry& method, const MethodOptions& options,
                        const std::string& file);

}  // namespace gridcull
