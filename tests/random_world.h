// Small random worlds with frames for the property tests, full of what breaks visibility methods: lattice-aligned
// coordinates, ties, abutting and coincident walls, thin and self-crossing shapes, objects and viewers outside the
// bounds, viewers inside objects, on walls and on corners, jumps, adds and removes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gridcull/core/bounds.h"
#include "gridcull/core/object.h"
#include "gridcull/core/view.h"

namespace gridcull::test {

struct ScriptMove {
  ObjectId id = no_id;
  Pose pose{};
};

/// One frame: remove, add, move in that order, then all views are asked. What names an object that is not there
/// (or adds one that is) is skipped, so that a script stays valid while it is shrunk.
struct ScriptFrame {
  double time = 0.0;  ///< seconds, greater than the frame's before
  std::vector<ObjectId> remove{};
  std::vector<Object> add{};
  std::vector<ScriptMove> moves{};
  std::vector<View> views{};
};

/// A whole test case, options of the method included.
struct WorldScript {
  int dimension = 2;
  Bounds bounds{};
  double cell = 1.0;          ///< metres
  std::string tbv = "solid";  ///< off, solid, hollow
  int threads = 4;            ///< of the second instance; the first runs on one
  std::vector<Object> objects{};
  std::vector<ScriptFrame> frames{};
};

/// The same world for the same numbers, on every machine.
WorldScript random_world(int dimension, std::uint64_t seed);

}  // namespace gridcull::test
