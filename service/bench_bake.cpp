#include "gridcull/service/bench_bake.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/service/interrupt.h"
#include "gridcull/service/progress.h"

namespace gridcull {
namespace {

namespace fs = std::filesystem;

/// A bar, and Ctrl-C; nothing is kept to go on from.
class Listener final : public BakeListener {
 public:
  explicit Listener(const std::string& what) : bar_("thousandths, " + what, whole) {}
  bool progress(double share) override {
    bar_.update(static_cast<std::uint64_t>(share * whole));
    return !interrupted();
  }
  void checkpoint(std::span<const std::byte>) override {}

 private:
  static constexpr std::uint64_t whole = 1000;
  Progress bar_;
};

}  // namespace

BakeFolder::BakeFolder() {
  std::string name = (fs::temp_directory_path() / "gridcull-bench-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw Error(ErrorCode::io, name + ": cannot be made");
  path_ = name;
}

BakeFolder::~BakeFolder() {
  std::error_code none;
  fs::remove_all(path_, none);
}

BakeCost bake_for_bench(const BenchScene& scene, const MethodEntry& method, const MethodOptions& options,
                        const std::string& file) {
  std::vector<Object> objects;
  for (const SceneObject& object : scene.scene.objects) objects.push_back(object.object);
  Listener listener("baking " + std::string(method.info.name) + ", " + scene.label);
  const auto start = std::chrono::steady_clock::now();
  const auto payload = method.baking.bake(objects, options, {}, listener);
  if (!payload) throw Stopped{};
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_baked(file, {std::string(method.info.name), method.baking.version, static_world_hash(objects)}, *payload);
  return {seconds, options.threads, fs::file_size(file)};
}

}  // namespace gridcull
