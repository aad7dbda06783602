// The depth buffer over slopes of method `silhouette` in 2D (DESIGN section 5.2): a z-buffer without pixels, after
// the lower envelope of segments (M. Sharir and P. K. Agarwal, "Davenport-Schinzel sequences and their geometric
// applications", 1995, section 1), kept as a sorted list of pieces in each quadrant and grown edge by edge.
//
// Claim: over every piece the stored line is the `low` line (grid/slope_edge.h) of one edge whose slopes hold the
// piece. So whatever lies below it is behind that edge, whichever edges came in which order: order is a matter of cost
// and of how much is hidden early, never of correctness. A crossing computed a little off only makes one true line
// stand for another. An answer "hidden" is final, since it rests on real edges only.
//
// Cost: a binary search and a step for each piece that the edge spans; an edge behind all of them changes nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "gridcull/grid/slope_edge.h"

namespace gridcull {

/// A disc as seen from outside it, in the frame of one quadrant.
struct DiscSight {
  Vec2 centre{0.0};
  double radius = 0.0;
  double power = 0.0;  ///< |centre|^2 - radius^2 > 0
};

class SlopeBuffer {
 public:
  static constexpr std::uint32_t nobody = 0xFFFF'FFFFu;

  struct Piece {
    double from;     ///< first slope; the next piece's is the last
    SlopeLine line;  ///< w; infinite where closed, 0 where open
    double steep;    ///< length of (a, b): 1 / distance of the edge's line
    std::uint32_t owner;
  };

  /// Everything open.
  void reset();
  /// Nothing can be seen in these slopes.
  void close(int quadrant, double from, double to);
  /// Enters an edge. Whether it is the nearest anywhere.
  bool insert(int quadrant, double from, double to, const SlopeLine& low, std::uint32_t owner);

  /// Width of the slopes in which the line is not behind the buffer; stops adding beyond `enough`.
  double open_width(int quadrant, double from, double to, const SlopeLine& high, double enough) const;
  /// The same for the near side of a disc, between its tangents; counts whole pieces, so it may be too much.
  double open_width(int quadrant, double from, double to, const DiscSight& disc, double enough) const;

  /// Calls f(owner) for every piece that has one and counts as more than a ray.
  template <class F>
  void for_each_owner(F&& f) const {
    for (const auto& list : pieces_) {
      for (std::size_t i = 0; i + 1 < list.size(); ++i) {
        if (list[i].owner != nobody && list[i + 1].from - list[i].from > least_width) f(list[i].owner);
      }
    }
  }
  std::size_t size() const;
  const std::vector<Piece>& pieces(int quadrant) const { return pieces_[static_cast<std::size_t>(quadrant)]; }
  std::uint64_t bytes() const;

 private:
  static std::size_t find(const std::vector<Piece>& list, double slope);
  void splice(std::vector<Piece>& list, std::size_t first, std::size_t end, std::size_t fresh);

  /// The last piece of each list begins at 1 and stands for the end.
  std::array<std::vector<Piece>, 4> pieces_{};
  std::vector<Piece> fresh_;
};

}  // namespace gridcull
