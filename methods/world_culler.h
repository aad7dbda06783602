// The half of Culler's contract that is the same for every method that keeps its objects in a world of its own: who is
// there and where. What is left to the method is query().
#pragma once

#include <span>
#include <utility>

#include "gridcull/core/culler.h"

namespace gridcull {

/// `World`: FlatWorld, or one that keeps a FlatWorld and takes the same calls.
template <class World>
class WorldCuller : public Culler {
 public:
  void add(const Object& object) override { world_.add(object); }
  void remove(ObjectId object) override { world_.remove(object); }
  void move(ObjectId object, const Pose& pose) override { world_.move(object, pose); }
  void move_all(std::span<const Move> moves) override {
    for (const Move& m : moves) world_.announce_jump(m.object);  // throws where nobody is; nothing else is done there
    for (const Move& m : moves) world_.move(m.object, m.pose);
  }
  void set_source(PositionSource* source) override { world_.set_source(source); }
  void announce_jump(ObjectId object) override { world_.announce_jump(object); }

 protected:
  template <class... Args>
  explicit WorldCuller(Args&&... args) : world_(std::forward<Args>(args)...) {}

  World world_;
};

}  // namespace gridcull
