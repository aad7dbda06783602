// The walk of method `silhouette` in 2D over the loose index: what hangs in it by its least distance from the viewer,
// nodes that are wholly behind the slope buffer skipped with all below (DESIGN sections 5.2, 5.6).
//
// Claim: every ball that `meet` is not called for is hidden or beyond the range. It hangs in a node, and it (that is,
// the square around it) or the box of that node or of one above was found beyond the range, or behind the buffer as it
// was then, which is final (silhouette_2d.h). The order is a matter of cost only.
//
// Cost: a test of a node for each `crowd` entries that are not skipped, some nanoseconds an entry for the queue; in
// worlds that do not fit into the cache, waiting for memory costs more than all that, so it is asked for ahead.
#pragma once

#include <span>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/grid/loose_index.h"
#include "gridcull/grid/near_first.h"
#include "gridcull/grid/silhouette_2d.h"
#include "gridcull/grid/silhouette_drawing.h"

namespace gridcull {

class SilhouetteWalk2D {
 public:
  /// Calls meet(item) about front to back for what hangs in the index and for `outside`, balls that it only remembers;
  /// meet may enter objects into `silhouettes`. The order depends on distances and slots only. Some time before, `ask`
  /// is called for the slot, to ask for memory.
  template <class Ask, class Meet>
  void run(const LooseIndex& index, std::span<const Slot> outside, Silhouettes2D& silhouettes, WorkCounts& work,
           Ask&& ask, Meet&& meet) {
    const auto ask_all = [&] {
      for (const Slot slot : pushed_) ask(slot);
      pushed_.clear();
    };
    begin(index, outside, silhouettes.sight());
    ask_all();
    queue_.take_all(
        [&](std::uint32_t spot) {
          open(spot, silhouettes, work);
          ask_all();
        },
        [&](Slot, BallRows::Place place) {
          ++work.object_tests;
          const BallRows::Item& item = index.item(place);
          if (!silhouettes.hides_square(Vec2(item.ball.centre), item.ball.radius)) meet(item);
        });
  }

  /// Keeps the nodes that the runs to come meet; nullptr: no longer.
  void note_nodes(WalkedNodes* nodes) { noted_ = nodes; }

  std::uint64_t bytes() const {
    return queue_.bytes() + spots_.capacity() * sizeof(Spot) + (rows_.capacity() + pushed_.capacity()) * sizeof(Slot);
  }

 private:
  /// A node and the middle of its box.
  struct Spot {
    LooseIndex::NodeId id;
    Vec2 middle;
  };
  /// A test of a node costs about as much as some objects that turn out to be hidden; below this its entries are
  /// taken at once.
  static constexpr std::uint32_t crowd = 16;

  void begin(const LooseIndex& index, std::span<const Slot> outside, const Sight2D& sight);
  void open(std::uint32_t spot, const Silhouettes2D& silhouettes, WorkCounts& work);
  void take(const Spot& spot, const LooseIndex::Node& node);
  void gather(const LooseIndex::NodeId& id, const LooseIndex::Node& node);
  void push(const BallRows::Item& item, BallRows::Place place);
  void add_row(std::uint32_t first);
  void push_rows();
  /// Half the side of a node's loose box.
  double reach(int level) const { return index_->side(level) + slack_; }

  const LooseIndex* index_ = nullptr;
  const Sight2D* sight_ = nullptr;
  double limit_ = 0.0;  // metres: the range, rounded up
  double slack_ = 0.0;  // metres: of the loose boxes
  NearFirst queue_;
  std::vector<Spot> spots_;
  std::vector<std::uint32_t> rows_;  // of the index, to be pushed when their memory has come
  std::vector<Slot> pushed_;         // since the last time that memory was asked for
  WalkedNodes* noted_ = nullptr;
};

}  // namespace gridcull
