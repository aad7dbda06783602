// What can be seen from a viewing cell (paper section 6.1).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gridcull/methods/extended_outlook.h"
#include "gridcull/methods/extended_scene.h"
#include "gridcull/methods/extended_sweep.h"

namespace gridcull::extended {

struct CellSettings {
  int resolution = 256;  ///< pixels along a map's side
  int occluders = 64;    ///< for each of the six directions on average; more where much is still visible
  int planes = 4;        ///< in each direction at most; 1: the one plane whose map fills best
  bool sweep = true;     ///< each plane also gets what the one before it hides
  int halvings = 3;      ///< of an occludee that one plane alone does not hide
};

/// Occluders smaller than this many pixels of a map are not worth it.
inline constexpr double least_pixels = 8.0;
/// The solid angle of that many pixels of a map of this resolution.
double least_angle(int resolution);

struct CellView {
  Outlooks outlooks{};
  std::vector<std::uint32_t> visible{};  ///< places in the scene's occludees, ascending
  std::vector<ObjectId> used{};          ///< occluders that may have hidden somebody, ascending
  std::vector<ObjectId> touching{};      ///< those among them that the cell touches, to within rounding
  std::uint64_t drawn = 0;               ///< occluders put into maps
};

/// The most that the maps of one cell take, and what a looker takes besides.
std::uint64_t view_bytes(const CellSettings& settings);
std::uint64_t looker_bytes(const CellSettings& settings);

/// Looks out of cells of one scene; storage is reused. Not for two threads at once.
class CellLooker {
 public:
  CellLooker(const StaticScene& scene, const CellSettings& settings) : scene_(scene), settings_(settings) {}

  /// Occluders that may hold a viewpoint of the cell do not count, nor does `without`. `candidates`: the places of
  /// the occludees to test, ascending (those that the parent cell sees: its other occludees are hidden from this cell
  /// too, and its other occluders are not worth it); nothing: all. Objects that meet the cell are visible.
  /// `above_floor`: the answer is for viewpoints at or above the scene's floor.
  void look(const ViewCell& cell, bool above_floor, ObjectId without, const std::vector<std::uint32_t>* candidates,
            CellView& out);

 private:
  struct Candidate {
    std::uint32_t occluder = 0;
    double angle = 0.0;
    Bounds box{};  ///< in the cell's axes
    bool touches = false;
    std::uint32_t polytopes = 0;  ///< first in polytopes_; none: nowhere
  };
  static constexpr std::uint32_t nowhere = 0xFFFF'FFFFu;

  void find_candidates(const ViewCell& cell, ObjectId without, const std::vector<std::uint32_t>* candidates);
  void draw_directions(const ViewCell& cell, CellView& out);
  bool worth_in(const Candidate& c, const Facing& facing, const Vec3& half) const;
  void choose_distances(const ViewCell& cell, const Facing& facing, std::span<const std::uint32_t> chosen);
  std::uint64_t filled_at(double distance, const ViewCell& cell, const Facing& facing,
                          std::span<const std::uint32_t> chosen);
  bool draw(Outlook& outlook, const ViewCell& cell, std::uint32_t candidate, CellView& out);
  std::span<const Polytope> local(const ViewCell& cell, std::uint32_t candidate);
  void test(const std::vector<std::uint32_t>* candidates, bool closely, CellView& out);
  void test_tree(std::uint32_t node, CellView& out);
  void draw_more(const ViewCell& cell, CellView& out);
  void sweep(CellView& out);

  const StaticScene& scene_;
  CellSettings settings_;
  bool above_floor_ = false;
  OccluderProjector projector_{};
  Sweep sweep_{};
  std::vector<double> distances_{};
  std::vector<Candidate> candidates_{};              ///< by falling solid angle
  std::vector<std::vector<std::uint32_t>> lists_{};  ///< for each facing, places in candidates_ worth it there
  std::vector<std::size_t> drawn_{};                 ///< for each facing, how many of its list
  std::vector<Polytope> polytopes_{};
  std::vector<std::uint32_t> found_{};
  Polytope turned_{};
  DepthMap rough_{};
};

}  // namespace gridcull::extended
