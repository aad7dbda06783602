// The walk of method `silhouette` in 2D over the loose index and the rows of what stands still: all in it by its least
// distance from the viewer, nodes and rows that are wholly behind the slope buffer skipped with all below (DESIGN
// sections 5.2, 5.6).
//
// Claim: every ball that `meet` is not called for is hidden or beyond the range. It hangs in a node, and it (that is,
// the square around it) or the box of that node or of one above was found beyond the range, or behind the buffer as it
// was then, which is final (silhouette_2d.h). So is what stands still and has a row (static_rows_2d.h): its box, or
// that of a row above. The order is a matter of cost only.
//
// Cost: a test of a node for each `crowd` entries that are not skipped, some nanoseconds an entry for the queue; in
// worlds that do not fit into the cache, waiting for memory costs more than all that, so it is asked for ahead.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gridcull/core/culler.h"
#include "gridcull/grid/loose_index.h"
#include "gridcull/grid/near_first.h"
#include "gridcull/grid/silhouette_2d.h"
#include "gridcull/grid/silhouette_drawing.h"
#include "gridcull/grid/static_rows_2d.h"

namespace gridcull {

class SilhouetteWalk2D {
 public:
  /// A test of a node costs about as much as some objects that turn out to be hidden; up to this many entries are
  /// taken at once, with all below the node.
  static constexpr std::uint32_t crowd = 16;

  /// Calls meet(item) about front to back for what hangs in the index and for `outside`, balls that it only remembers,
  /// and meet_static(slot, occluder, box) for what has a row; they may enter objects into `silhouettes`. The order
  /// depends on distances and slots only. Some time before, `ask` is called for the slot, to ask for memory.
  template <class Ask, class Meet, class MeetStatic>
  void run(const LooseIndex& index, const StaticRows2D& rows, std::span<const Slot> outside, Silhouettes2D& silhouettes,
           WorkCounts& work, Ask&& ask, Meet&& meet, MeetStatic&& meet_static) {
    const auto ask_all = [&] {
      for (const Slot slot : pushed_) ask(slot);
      pushed_.clear();
    };
    begin(index, rows, outside, silhouettes.sight());
    ask_all();
    queue_.take_all(
        [&](std::uint32_t spot) {
          if ((spot & is_row) != 0) {
            open_row(row_spots_[spot & ~is_row], silhouettes, work);
          } else {
            open(spot, silhouettes, work);
          }
          ask_all();
        },
        [&](Slot slot, BallRows::Place place) {
          if ((place & is_row) != 0) {
            const RowSpot& spot = row_spots_[place & ~is_row];
            if (!hides(silhouettes, spot)) meet_static(slot, spot.occluder, spot.box);
            return;
          }
          ++work.object_tests;
          const BallRows::Item& item = index.item(place);
          if (!silhouettes.hides_square(Vec2(item.ball.centre), item.ball.radius)) meet(item);
        });
  }

  /// Keeps the nodes that the runs to come meet; nullptr: no longer.
  void note_nodes(WalkedNodes* nodes) { noted_ = nodes; }

  std::uint64_t bytes() const {
    return queue_.bytes() + spots_.capacity() * sizeof(Spot) + row_spots_.capacity() * sizeof(RowSpot) +
           (rows_.capacity() + pushed_.capacity()) * sizeof(Slot);
  }

 private:
  /// A node and the middle of its box.
  struct Spot {
    LooseIndex::NodeId id;
    Vec2 middle;
  };
  /// Marks what is a row's, in the queue.
  static constexpr std::uint32_t is_row = 0x8000'0000u;
  /// A row, or one of its members, with what is asked about its box.
  struct RowSpot {
    StaticRows2D::RowId id;
    Box2D box;
    Sight2D::BoxSpan span;
    bool occluder;  ///< of a member
  };
  static bool hides(const Silhouettes2D& silhouettes, const RowSpot& spot) {
    return spot.span.quadrant >= 0 ? silhouettes.sight().hides_span(spot.span) : silhouettes.hides_box(spot.box);
  }
  /// Of its nearest point to the viewer.
  double square_of(const Box2D& box) const {
    const Vec2 d = glm::max(glm::max(box.low - sight_->eye(), sight_->eye() - box.high), Vec2(0.0));
    return glm::dot(d, d);
  }

  void begin(const LooseIndex& index, const StaticRows2D& rows, std::span<const Slot> outside, const Sight2D& sight);
  /// Unless it is beyond the range.
  void push_row(const RowSpot& spot);
  void push_member(const RowSpot& spot, Slot slot);
  void open_row(RowSpot spot, const Silhouettes2D& silhouettes, WorkCounts& work);
  void open(std::uint32_t spot, const Silhouettes2D& silhouettes, WorkCounts& work);
  void take(const Spot& spot, const LooseIndex::Node& node);
  void gather(const LooseIndex::NodeId& id, const LooseIndex::Node& node);
  void push(const BallRows::Item& item, BallRows::Place place);
  void add_row(std::uint32_t first);
  void push_rows();
  /// Half the side of a node's loose box.
  double reach(int level) const { return index_->side(level) + slack_; }

  const LooseIndex* index_ = nullptr;
  const StaticRows2D* static_rows_ = nullptr;
  const Sight2D* sight_ = nullptr;
  double limit_ = 0.0;  // metres: the range, rounded up
  double slack_ = 0.0;  // metres: of the loose boxes
  NearFirst queue_;
  std::vector<Spot> spots_;
  std::vector<RowSpot> row_spots_;
  std::array<Sight2D::BoxSpan, BoxLanes::count> spans_{};
  std::vector<std::uint32_t> rows_;  // of the index, to be pushed when their memory has come
  std::vector<Slot> pushed_;         // since the last time that memory was asked for
  WalkedNodes* noted_ = nullptr;
};

}  // namespace gridcull
