#include "gridcull/service/tbv_tape.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "gridcull/core/drawing.h"
#include "gridcull/core/error.h"
#include "gridcull/grid/engine.h"
#include "gridcull/grid/tbv_matrix.h"
#include "gridcull/service/bench_course.h"
#include "gridcull/service/interrupt.h"

namespace gridcull {
namespace {

constexpr std::uint64_t most_memory = std::uint64_t{4} << 30;  // bytes, for the engine's matrices

/// The drawing of one frame.
class Picture final : public DrawSink {
 public:
  Picture(const Lattice& lattice, const TbvMatrix& matrix) : lattice_(lattice), matrix_(matrix) {}

  void begin(const Cell& viewer) {
    viewer_ = viewer;
    looks_.clear();
    volumes.clear();
    revealed.clear();
  }

  /// A run of cells along x.
  void cells(CellLayer layer, const Vec3& low, const Vec3& high) override {
    if (layer != CellLayer::visited) return;
    const double half = 0.5 * lattice_.cell();
    const Cell last = lattice_.cell_of(high - Vec3(half));
    for (Cell c = lattice_.cell_of(low + Vec3(half)); c.x <= last.x; ++c.x) {
      const std::int64_t shell =
          std::max({std::llabs(c.x - viewer_.x), std::llabs(c.y - viewer_.y), std::llabs(c.z - viewer_.z)});
      looks_[{shell, lattice_.brick_of(c)}] |= std::uint64_t{1} << lattice_.bit_of(c);
    }
  }

  void tbv(ObjectId object, const Vec3& centre, double radius, bool was_revealed) override {
    const TbvBall ball{centre, radius};
    if (!matrix_.fits(ball)) return;
    volumes.push_back({object, ball});
    if (was_revealed) revealed.push_back(object);
  }

  std::vector<TbvTape::Look> looks() const {
    std::vector<TbvTape::Look> out;
    out.reserve(looks_.size());
    for (const auto& [key, bits] : looks_) out.push_back({static_cast<std::uint32_t>(key.second), bits});
    return out;
  }

  std::vector<TbvTape::Volume> volumes{};
  std::vector<Slot> revealed{};

 private:
  const Lattice& lattice_;
  const TbvMatrix& matrix_;
  Cell viewer_{};
  std::map<std::pair<std::int64_t, std::size_t>, std::uint64_t> looks_{};  // by shell and brick
};

/// The volumes as they stand, by slot.
using Standing = std::vector<std::optional<TbvBall>>;

bool same(const TbvBall& a, const TbvBall& b) { return a.centre == b.centre && a.radius == b.radius; }

/// What leads from `standing` to `now`; `standing` becomes `now`.
void note_changes(Standing& standing, const std::vector<TbvTape::Volume>& now, TbvTape::Frame& frame) {
  std::vector<std::uint8_t> there(standing.size(), 0);
  for (const TbvTape::Volume& volume : now) {
    std::optional<TbvBall>& old = standing[volume.slot];
    there[volume.slot] = 1;
    if (!old) {
      frame.born.push_back(volume);
    } else if (!same(*old, volume.ball)) {
      frame.renewed.push_back(volume);
    }
    old = volume.ball;
  }
  for (Slot slot = 0; slot < standing.size(); ++slot) {
    if (!standing[slot] || there[slot] != 0) continue;
    standing[slot].reset();
    frame.removed.push_back(slot);
  }
}

std::size_t slots_of(const Scene& scene) {
  ObjectId last = 0;
  for (const SceneObject& object : scene.objects) last = std::max(last, object.object.id);
  return std::size_t{last} + 1;
}

GridOptions options_of(const BenchScene& scene) {
  GridOptions options;
  options.dimension = 3;
  options.bounds = scene.choice.bounds;
  options.cell = scene.choice.cell;
  options.max_memory = most_memory;
  options.hiding = Hiding::voxel;
  return options;
}

}  // namespace

TbvTape record_tbv_tape(const BenchScene& scene, std::uint64_t frames, const std::function<void()>& tick) {
  if (scene.scene.dimension != 3 || scene.scene.viewers.size() != 1) {
    throw Error(ErrorCode::usage, scene.label + ": expected a 3D scene with one viewer");
  }
  GridEngine engine(options_of(scene));
  for (const SceneObject& object : scene.scene.objects) engine.add(object.object);
  TbvTape tape{engine.lattice(), slots_of(scene.scene)};
  const TbvMatrix matrix(engine.lattice());
  Picture picture(engine.lattice(), matrix);
  Standing standing(tape.slots);
  Answers answers;
  Course course(scene, frames);
  for (CourseFrame now; course.next(now);) {
    stop_if_interrupted();
    feed(engine, now);
    const View& view = now.views.at(0);
    picture.begin(engine.lattice().cell_of(view.pose.position));
    engine.draw_next(view.viewer, &picture);
    engine.query(now.time, now.views, answers);
    TbvTape::Frame& frame = tape.frames.emplace_back();
    std::sort(picture.volumes.begin(), picture.volumes.end(),
              [](const auto& a, const auto& b) { return a.slot < b.slot; });
    std::sort(picture.revealed.begin(), picture.revealed.end());
    note_changes(standing, picture.volumes, frame);
    frame.looks = picture.looks();
    frame.revealed = picture.revealed;
    frame.hidden = picture.volumes.size();
    tick();
  }
  return tape;
}

}  // namespace gridcull
