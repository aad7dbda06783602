// The matrices and objects that all viewers of a frame share. While viewers run, everything here is frozen
// but the poses of hidden objects that somebody reveals.
#pragma once

#include <mutex>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/grid/hollow_tbv.h"
#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/object_table.h"
#include "gridcull/grid/tbv_matrix.h"

namespace gridcull {

struct GridWorld {
  explicit GridWorld(const Lattice& cells) : lattice(cells), matrix(lattice), tbv(lattice), hollow(lattice) {}

  Lattice lattice;
  IdentifierMatrix matrix;  // I, O, O_s
  TbvMatrix tbv;            // T, solid
  HollowTbv hollow;         // T, outlines
  ObjectTable objects;
  /// Slots that reach beyond the lattice, active objects and hidden volumes: tested one by one.
  std::vector<Slot> outside;

  PositionSource* source = nullptr;
  std::uint64_t frame = 0;
  std::uint64_t positions_read = 0;

  /// The object's pose in this frame: asked from the source once a frame, counted. Any thread.
  Pose read(Slot slot);

 private:
  std::mutex reading_;
};

/// Throws Error(bad_frame) unless position and orientation are finite and within 1e9.
void check_pose(const Pose& pose, ObjectId object);

}  // namespace gridcull
