#include "gridcull/sim/world_files.h"

#include <filesystem>
#include <optional>
#include <system_error>

#include "gridcull/core/error.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

namespace fs = std::filesystem;

}  // namespace

struct WorldFiles::Detail {
  fs::path folder;
  bool made = false;  ///< the folder is ours
  bool committed = false;
  std::optional<FrameWriter> frames{};

  explicit Detail(fs::path folder_) : folder(std::move(folder_)) {}
  ~Detail() {
    frames.reset();
    std::error_code none;
    if (made && !committed) fs::remove(folder, none);  // only when empty
  }
  Detail(const Detail&) = delete;
  Detail& operator=(const Detail&) = delete;
};

WorldFiles::WorldFiles(const std::string& folder, int dimension) : detail_(std::make_unique<Detail>(folder)) {
  Detail& d = *detail_;
  std::error_code fault;
  d.made = fs::create_directories(d.folder, fault);
  if (fault || !fs::is_directory(d.folder)) {
    throw Error(ErrorCode::io, folder + ": cannot be made a folder: " + (fault ? fault.message() : "it is a file"));
  }
  d.frames.emplace(frames_path(), dimension);
}
WorldFiles::~WorldFiles() = default;
WorldFiles::WorldFiles(WorldFiles&&) noexcept = default;
WorldFiles& WorldFiles::operator=(WorldFiles&&) noexcept = default;

std::string WorldFiles::scene_path() const { return (detail_->folder / "scene.json").string(); }
std::string WorldFiles::frames_path() const { return (detail_->folder / "frames.jsonl").string(); }

void WorldFiles::write(const Frame& frame) { detail_->frames->write(frame); }

void WorldFiles::commit(const Scene& scene) {
  // The scene is written beside its name before either file appears.
  TextWriter scene_file(scene_path());
  scene_file.write(scene_text(scene));
  detail_->frames->commit();
  scene_file.commit();
  detail_->committed = true;
}

}  // namespace gridcull
