// The depth buffer over slopes of method `silhouette` in 2D (DESIGN section 5.2): a z-buffer without pixels, after
// the lower envelope of segments (M. Sharir and P. K. Agarwal, "Davenport-Schinzel sequences and their geometric
// applications", 1995, section 1), kept as a sorted list of pieces in each quadrant and grown edge by edge.
//
// Claim: over every piece the stored line is the `low` line (grid/slope_edge.h) of one edge whose slopes hold the
// piece. So whatever lies below it is behind that edge, whichever edges came in which order: order is a matter of cost
// and of how much is hidden early, never of correctness. A crossing computed a little off only makes one true line
// stand for another. An answer "hidden" is final, since it rests on real edges only.
//
// Cost: a binary search and a step for each piece that the edge spans; an edge behind all of them changes nothing. Most
// edges lie in front of a part of a single piece, which has a short way of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
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

  /// Whether the buffer is nearer than `most` (w) all over the slopes.
  bool nearer(int quadrant, double from, double to, double most) const;
  /// Width of the slopes in which the line is not behind the buffer; stops adding beyond `enough`.
  double open_width(int quadrant, double from, double to, const SlopeLine& high, double enough) const;
  /// The same for the near side of a disc, between its tangents; counts whole pieces, so it may be too much.
  double open_width(int quadrant, double from, double to, const DiscSight& disc, double enough) const;

  /// Calls f(owner) for every piece that has one and counts as more than a ray.
  template <class F>
  void for_each_owner(F&& f) const {
    for (const List& list : lists_) {
      for (std::size_t i = 0; i + 1 < list.size; ++i) {
        const Piece& p = list.pieces[i];
        if (p.owner != nobody && list.pieces[i + 1].from - p.from > least_width) f(p.owner);
      }
    }
  }
  std::size_t size() const;
  std::span<const Piece> pieces(int quadrant) const {
    const List& list = lists_[static_cast<std::size_t>(quadrant)];
    return {list.pieces.data(), list.size};
  }
  std::uint64_t bytes() const;

 private:
  /// The last piece begins at 1 and stands for the end. Room beyond `size` is kept, so that it costs nothing to grow.
  struct List {
    std::vector<Piece> pieces{};
    std::size_t size = 0;
  };
  static std::size_t find(const List& list, double slope);
  static void resize_hole(List& list, std::size_t end, std::size_t new_end);
  void insert_into_one(List& list, std::size_t at, double to, const Piece& edge);
  void insert_into_many(List& list, std::size_t first, double to, const Piece& edge);

  std::array<List, 4> lists_{};
  std::vector<Piece> fresh_;
};

}  // namespace gridcull
