// What do hidden objects cost? The spheres of DESIGN's scene A about one large solid box that is full of small movers
// nobody can see (as bench/hidden_movers.h has them, here as frames).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// Adds, with the ids that follow, the box (x, y 24 .. 76, z 3 .. 57) and `movers` balls of 0.25 m inside it, at least
/// 14 m from its faces.
void add_hidden_movers(Scene& scene, std::uint32_t movers);

/// The frames of `spheres`, with the movers going back and forth at 0.5 .. 2 m/s.
class HiddenMovers final : public FrameSource {
 public:
  /// `first`: the id of the first mover, as add_hidden_movers() gave it.
  HiddenMovers(std::unique_ptr<FrameSource> spheres, std::uint32_t movers, ObjectId first);
  bool next(Frame& out) override;

 private:
  friend void add_hidden_movers(Scene& scene, std::uint32_t movers);
  struct Track {
    Vec3 centre, along;
    double speed, phase;
    Vec3 at(double time) const;
  };
  static std::vector<Track> tracks(std::uint32_t movers);

  std::unique_ptr<FrameSource> spheres_;
  std::vector<Track> tracks_;
  ObjectId first_;
};

}  // namespace gridcull
