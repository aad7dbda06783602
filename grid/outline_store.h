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
  /// Asks for the memory of at(), and for that of the points where they are few.
  void prefetch(Slot slot) const {
    __builtin_prefetch(&bodies_[slot]);
    const std::size_t block = slot / in_block;
    if (block < few_.size() && few_[block]) __builtin_prefetch(&few_[block][slot % in_block]);
  }

  /// The object at another pose, for one view: `points` is filled and must stay.
  Placed2D place(Slot slot, const Pose& pose, std::vector<Vec2>& points) const;

  std::uint64_t bytes() const;

 private:
  using Size = std::array<double, 2>;
  struct Kept {
    Outline2D outline;
    Size size{};  ///< of a rectangle: all of that size share this
  };
  /// A cache line each.
  struct alignas(64) Body {
    Placed2D placed{};
    std::shared_ptr<const Kept> kept{};  ///< nullptr: a disc
    std::unique_ptr<Vec2[]> many{};      ///< world points, where they are more than four
  };
  /// Points of a rectangle, say: a cache line whose place the slot tells, so that it can be asked for with the body.
  struct alignas(64) FewPoints {
    std::array<Vec2, 4> points{};
  };
  static constexpr std::size_t in_block = 256;
  std::shared_ptr<const Kept> kept_for(const Shape& shape);
  void make_block(std::size_t block);
  Vec2* points_of(Slot slot) {
    Body& body = bodies_[slot];
    return body.many ? body.many.get() : few_[slot / in_block][slot % in_block].points.data();
  }

  std::vector<Body> bodies_;
  std::vector<std::unique_ptr<FewPoints[]>> few_;  // by slot / in_block; made when needed, and stays where it is
  /// Of rectangles one for all of a size: those of a town's cars stay in the cache.
  std::map<Size, std::weak_ptr<const Kept>> rectangles_;
};

}  // namespace gridcull
