// The 2D objects of a world as silhouettes: outlines made once a shape, points placed once a pose. Frozen while views
// are answered.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gridcull/grid/silhouette_2d.h"

namespace gridcull {

class OutlineStore {
 public:
  void reserve(std::size_t slots);
  void add(Slot slot, const Shape& shape);
  void remove(Slot slot) { bodies_[slot] = {}; }

  /// The object stands at `pose` from now on.
  void place(Slot slot, const Pose& pose);
  const Placed2D& at(Slot slot) const { return bodies_[slot].placed; }
  /// Asks for the memory of at().
  void prefetch(Slot slot) const { __builtin_prefetch(&bodies_[slot]); }

  /// The object at another pose, for one view: `points` is filled and must stay.
  Placed2D place(Slot slot, const Pose& pose, std::vector<Vec2>& points) const;

  std::uint64_t bytes() const;

 private:
  struct Detail {
    explicit Detail(const Shape& shape) : outline(shape), points(outline.points().size()) {}
    Outline2D outline;
    std::vector<Vec2> points;
  };
  struct Body {
    Placed2D placed{};
    std::unique_ptr<Detail> detail{};  ///< nullptr: a disc
  };
  std::vector<Body> bodies_;
};

}  // namespace gridcull
