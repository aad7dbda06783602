// The matrices and objects that all viewers of a frame share. While viewers run, everything here is frozen
// but the poses of hidden objects that somebody reveals.
#pragma once

#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/grid/hollow_tbv.h"
#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/object_table.h"
#include "gridcull/grid/silhouette_world.h"
#include "gridcull/grid/tbv_matrix.h"
#include "gridcull/grid/tile_stream.h"

namespace gridcull {

struct GridWorld {
  /// `silhouettes`: objects go into the loose index, the matrices stay as small as can be.
  /// `bound`: what those test 3D objects with.
  /// `memory`: bytes that a viewer's window may take.
  GridWorld(const Lattice& cells, bool with_silhouettes, std::optional<BoundKind> bound, StoreKind store,
            std::uint64_t memory);

  Lattice lattice;
  std::unique_ptr<SilhouetteWorld> silhouettes;  // method `silhouette`; then I, O and T stay empty
  Lattice voxels;                                // the lattice, or one cell of it
  IdentifierMatrix matrix;                       // I, O, O_s
  TbvMatrix tbv;                                 // T, solid
  HollowTbv hollow;                              // T, outlines
  ObjectTable objects;
  std::unique_ptr<TileStream> tiles;  // static cells that are read as viewers come near; mostly none
  /// Slots that reach beyond the lattice, active objects and hidden volumes: tested one by one.
  std::vector<Slot> outside;

  /// Per block of T: the last frame (low 32 bits) in which somebody saw a cell of it.
  LazyArray<std::uint32_t> seen_in;

  std::uint64_t max_memory;
  PositionSource* source = nullptr;
  std::uint64_t frame = 1;  ///< counts queries from 2, so that nothing counts as seen before the first
  std::uint64_t positions_read = 0;

  /// Any thread, while views are answered: all write the same value.
  void note_seen(std::size_t block) {
    std::atomic_ref(seen_in[block]).store(static_cast<std::uint32_t>(frame), std::memory_order_relaxed);
  }
  /// Whether a block that the ball reaches was seen in this or the last frame. The ball lies in the lattice.
  bool near_seen(const TbvMatrix::Ball& ball) const;

  /// Hints that a hidden object will be read and its volume renewed soon.
  void prefetch(Slot slot) const {
    objects.prefetch(slot);
    if (silhouettes) {
      silhouettes->index.prefetch(slot);
    } else {
      tbv.prefetch(slot);
    }
  }

  /// The object's pose in this frame: asked from the source once a frame, counted. Any thread.
  Pose read(Slot slot);
  /// The same while no views are being answered.
  const Pose& read_alone(Slot slot);
  /// Counts the object's position as read in this frame, once.
  void note_read(ObjectState& state) {
    if (state.read_frame == static_cast<std::uint32_t>(frame)) return;
    state.read_frame = static_cast<std::uint32_t>(frame);
    ++positions_read;
  }

 private:
  std::mutex reading_;
};

/// Throws Error(bad_frame) where check_pose() does.
[[noreturn]] void refuse_pose(const Pose& pose, ObjectId object, int dimension);

/// Throws Error(bad_frame) unless the position is finite and within 1e9 (2D: z = 0) and the orientation of length 1.
inline void check_pose(const Pose& pose, ObjectId object, int dimension) {
  const Vec3& p = pose.position;
  const Quat& q = pose.orientation;
  const double length = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  const bool good = std::fabs(p.x) <= 1e9 && std::fabs(p.y) <= 1e9 && std::fabs(p.z) <= 1e9 &&
                    (dimension == 3 || p.z == 0.0) && std::fabs(length - 1.0) <= 1e-9;
  if (!good) refuse_pose(pose, object, dimension);
}

}  // namespace gridcull
