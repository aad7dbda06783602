// Which occluders a viewer uses in a frame: Hudson et al. 1997, section 4.2.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "gridcull/core/view_volume.h"
#include "gridcull/methods/occluder_regions.h"
#include "gridcull/methods/shadow_frustum.h"
#include "gridcull/methods/shadow_world.h"

namespace gridcull {

/// What counts for how much when occluders are ranked (section 4). All three are shares of what there is to hide:
/// of all directions covered, of the static objects hidden from nearby viewpoints, of all objects hidden in the
/// viewer's last frame.
struct OccluderWeights {
  double angle = 1.0, sampled = 1.0, recent = 1.0;
};

/// A candidate and what it is worth.
struct RankedPart {
  std::uint64_t key = 0;
  std::uint32_t entry = 0;
  double worth = 0.0;

  /// The best first; a total order.
  bool before(const RankedPart& other) const {
    return worth > other.worth || (worth == other.worth && key < other.key);
  }
};

/// A viewer's candidates, best first, kept in order from frame to frame.
class RankedList {
 public:
  /// Entries have other numbers from now on.
  void forget() { parts_.clear(); }

  /// Takes the new candidates, each entry once. Those that were there stay where they were, others come last, then the
  /// list is sorted by insertion: where little has changed, in linear time (section 4.2, "coherence"). `places` is a
  /// buffer, as long as there are entries and full of `no_place` before and after.
  void update(std::span<const RankedPart> candidates, std::span<std::uint32_t> places);
  static constexpr std::uint32_t no_place = 0xFFFF'FFFFu;

  std::span<const RankedPart> parts() const { return parts_; }
  /// Steps of the last update's sort.
  std::uint64_t moves() const { return moves_; }

 private:
  void insertion_sort();

  std::vector<RankedPart> parts_{};
  std::uint64_t moves_ = 0;
};

/// Chooses and builds. What it remembers of each viewer changes which occluders are tried, never what is true.
class OccluderChoice {
 public:
  /// `count` at most, 1 .. 64.
  OccluderChoice(std::size_t count, const OccluderWeights& weights)
      : count_(count), weights_(weights), frusta_(count) {}

  /// Call once a frame, after the world's begin_frame().
  void begin_frame(const ShadowWorld& world, std::size_t views);

  /// The frusta for one view, valid until the next call. `holders`: places of what holds the viewpoint.
  std::span<const ShadowFrustum* const> choose(const ShadowWorld& world, const View& view, const ViewVolume& volume,
                                               std::span<const std::uint32_t> holders);

  /// Tells what each frustum of the last choose() hid.
  void learn(std::span<const std::uint64_t> hidden_by);

 private:
  struct Track {
    std::uint64_t key = 0;
    std::uint64_t frame = 0;  ///< last used
    SilhouetteTrack silhouette{};
    std::uint32_t entry = 0;
    std::uint64_t hidden = 0;  ///< objects, when last used
  };
  /// What is kept of a viewer from frame to frame.
  struct Viewer {
    RankedList ranked{};
    std::vector<Track> tracks{};
    std::uint64_t frame = 0;
  };

  void rank(const ShadowWorld& world, const Vec3& eye, Viewer& viewer);
  void add_candidate(const ShadowWorld& world, std::uint32_t entry, double sampled, const Vec3& eye);
  void add_recent(const ShadowWorld& world, const Viewer& viewer);
  bool lies_in_shadow(const Bounds& box, const Vec3& eye) const;
  Track& track_of(Viewer& viewer, std::uint64_t key);

  std::size_t count_;
  OccluderWeights weights_;
  OccluderRegions regions_{};
  std::vector<ShadowFrustum> frusta_;
  std::vector<const ShadowFrustum*> used_{};
  std::vector<Track*> used_tracks_{};
  std::unordered_map<ViewerId, Viewer> viewers_{};
  std::vector<RankedPart> candidates_{};
  std::vector<std::uint32_t> places_{};
  std::uint64_t frame_ = 0, entries_version_ = 0;
};

}  // namespace gridcull
