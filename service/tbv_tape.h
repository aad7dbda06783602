// What happens to the temporal bounding volumes of a world, frame by frame, written down once so that several indexes
// can be given exactly the same: `gridcull bench --figure tbv-upkeep`.
//
// The engine itself writes it, method `voxel` with solid volumes: after every frame its volumes and the cells it looked
// at are drawn (core/drawing.h), and the tape holds the difference to the frame before. Terms and radii are therefore
// the engine's own, and so is which volumes each frame reveals, which every index must answer again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "gridcull/grid/identifier_matrix.h"
#include "gridcull/grid/lattice.h"
#include "gridcull/grid/tbv_ball.h"
#include "gridcull/service/bench_scene.h"

namespace gridcull {

struct TbvTape {
  struct Volume {
    Slot slot;  ///< the object's id
    TbvBall ball;
  };
  /// Cells of one brick that the traversal met at once.
  struct Look {
    std::uint32_t brick;
    std::uint64_t bits;
  };
  struct Frame {
    // Since the frame before, each by slot. Done in this order.
    std::vector<Slot> removed{};    ///< revealed in the frame before, mostly
    std::vector<Volume> born{};     ///< of objects that nobody saw in the frame before
    std::vector<Volume> renewed{};  ///< expired, with their new balls
    // The traversal.
    std::vector<Look> looks{};     ///< shell by shell of equal chess distance from the viewer, in a shell by brick
    std::vector<Slot> revealed{};  ///< by slot
    std::size_t hidden = 0;        ///< volumes there are while it runs
  };

  Lattice lattice;
  std::size_t slots = 0;  ///< slots are below
  std::vector<Frame> frames{};
};

/// Plays the first `frames` frames of a 3D scene with one viewer. Volumes that reach beyond the lattice are kept in no
/// index and left out. Calls `tick` after every frame. Throws Error(usage) for other scenes, what the engine throws,
/// Stopped on Ctrl-C.
TbvTape record_tbv_tape(const BenchScene& scene, std::uint64_t frames, const std::function<void()>& tick);

}  // namespace gridcull
