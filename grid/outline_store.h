// The 2D objects of a world as silhouettes: outlines made once a shape, points placed once a pose. Frozen while views
// are answered.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "gridcull/grid/silhouette_2d.h"

namespace gridcull {

class OutlineStore {
 public:
  void reserve(std::size_t slots);
  void add(Slot slot, const Shape& shape);
  void remove(Slot slot);

  /// The object stands at `pose` from now on.
  void place(Slot slot, const Pose& pose);
  const Placed2D& at(Slot slot) const { return bodies_[slot].placed; }
  /// Asks for the memory of at().
  void prefetch(Slot slot) const { __builtin_prefetch(&bodies_[slot]); }

  /// The object at another pose, for one view: `points` is filled and must stay.
  Placed2D place(Slot slot, const Pose& pose, std::vector<Vec2>& points) const;

  std::uint64_t bytes() const;

 private:
  using Size = std::array<double, 2>;
  struct Kept {
    Outline2D outline;
    Size size{};  ///< of a rectangle: all of that size share this
  };
  struct Body {
    Placed2D placed{};
    std::shared_ptr<const Kept> kept{};  ///< nullptr: a disc
    std::unique_ptr<Vec2[]> points{};    ///< of the outline, in the world
  };
  std::shared_ptr<const Kept> kept_for(const Shape& shape);

  std::vector<Body> bodies_;
  /// Of rectangles one for all of a size: those of a town's cars stay in the cache.
  std::map<Size, std::weak_ptr<const Kept>> rectangles_;
};

}  // namespace gridcull
