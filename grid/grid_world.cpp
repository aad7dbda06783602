#include "gridcull/grid/grid_world.h"

#include <cmath>
#include <string>

#include "gridcull/core/error.h"

namespace gridcull {

namespace {

Lattice one_cell(const Lattice& lattice) {
  const Vec3 low = lattice.box().min;
  return {lattice.dimension(), {low, low}, lattice.cell(), std::uint64_t{1} << 20};
}

/// Side of the finest nodes wished for: 2D walks take up to 16 objects at once, so finer nodes would only be passed.
double node_side(const Lattice& lattice) { return (lattice.dimension() == 2 ? 32.0 : 4.0) * lattice.cell(); }

}  // namespace

GridWorld::GridWorld(const Lattice& cells, bool with_silhouettes, std::optional<BoundKind> bound, StoreKind store,
                     std::uint64_t memory)
    : lattice(cells),
      silhouettes(with_silhouettes
                      ? std::make_unique<SilhouetteWorld>(cells.dimension(), cells.box(), node_side(cells), bound)
                      : nullptr),
      voxels(with_silhouettes ? one_cell(cells) : cells),
      matrix(voxels, make_static_store(store, voxels)),
      tbv(voxels),
      hollow(voxels),
      seen_in(tbv.block_count()),
      max_memory(memory) {}

void refuse_pose(const Pose& pose, ObjectId object, int dimension) {
  const Vec3& p = pose.position;
  const std::string where = "object " + std::to_string(object) + ": ";
  if (!(std::fabs(p.x) <= 1e9 && std::fabs(p.y) <= 1e9 && std::fabs(p.z) <= 1e9)) {
    throw Error(ErrorCode::bad_frame, where + "expected a finite position of magnitude at most 1e9");
  }
  if (dimension == 2 && p.z != 0.0) throw Error(ErrorCode::bad_frame, where + "expected z = 0 in 2D");
  throw Error(ErrorCode::bad_frame, where + "expected an orientation of length 1");
}

bool GridWorld::near_seen(const TbvMatrix::Ball& ball) const {
  const TbvMatrix::BlockSpan span = tbv.span_of(ball);
  const auto now = static_cast<std::uint32_t>(frame);
  for (std::int64_t z = span.low[2]; z <= span.high[2]; ++z) {
    for (std::int64_t y = span.low[1]; y <= span.high[1]; ++y) {
      const std::size_t row = tbv.block_index(0, y, z);
      for (std::int64_t x = span.low[0]; x <= span.high[0]; ++x) {
        if (now - seen_in[row + static_cast<std::size_t>(x)] <= 1) return true;
      }
    }
  }
  return false;
}

Pose GridWorld::read(Slot slot) {
  const std::lock_guard lock(reading_);
  return read_alone(slot);
}

const Pose& GridWorld::read_alone(Slot slot) {
  ObjectState& state = objects[slot];
  if (source != nullptr && state.read_frame != static_cast<std::uint32_t>(frame)) {
    const Pose pose = source->pose(state.id);
    check_pose(pose, state.id, lattice.dimension());
    objects.whereabouts(slot).pose = pose;
  }
  note_read(state);
  return objects.pose(slot);
}

}  // namespace gridcull
