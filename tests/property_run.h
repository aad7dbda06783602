// Plays a world script against methods and checks every answer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gridcull/methods/catalog.h"
#include "random_world.h"

namespace gridcull::test {

/// What went wrong first.
struct Fault {
  std::string rule;  ///< short and the same for the same kind of fault: shrinking keeps it
  std::string text;  ///< one line with frame, viewer and object
};

/// What a run saw: a test that hides nothing tests nothing.
struct Tally {
  std::uint64_t views = 0;
  std::uint64_t in_view = 0;   ///< objects that the view volume alone lets through
  std::uint64_t answered = 0;  ///< objects that the method reports
  std::uint64_t visible = 0;   ///< objects that the reference sees
  std::uint64_t revealed = 0, expired = 0, jumps = 0;
};

/// What the reference says of every frame and view of a script: asked once, whatever the number of methods.
class Truth {
 public:
  /// `rays` along a frustum's height in 3D; 0: no reference, only what needs none is checked.
  Truth(const WorldScript& script, int rays);
  ~Truth();

  struct Frame;
  /// nullptr without a reference.
  const Frame* frame(std::size_t index) const;

 private:
  std::vector<Frame> frames_;
};

/// Feeds fresh instances of `method` the script, one in push mode on one thread and one in pull mode on
/// script.threads (of `voxel` besides one that holds only a part of the static cells: no missed, order, ridden,
/// container), and checks in every frame and view:
///   missed      every object that the reference sees is reported (3D: that it confirms)
///   differs     both instances answer the same, work counts and positions read included
///   order       ids ascend
///   ridden      the ridden object is never reported
///   container   objects around the viewpoint are
///   out of view nobody is reported whom the view volume alone leaves out
///   error       nothing throws
std::optional<Fault> check_world(const WorldScript& script, const MethodEntry& method, const Truth& truth,
                                 Tally& tally);

/// The same with a reference of its own; what that refuses is a fault by the rule `error`.
std::optional<Fault> check_world(const WorldScript& script, const MethodEntry& method, int rays);

}  // namespace gridcull::test
