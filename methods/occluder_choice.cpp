#include "gridcull/methods/occluder_choice.h"

#include <algorithm>
#include <numbers>

namespace gridcull {
namespace {

/// Steradians (2D: radians): what seems smaller hides next to nothing (section 4.1's threshold).
constexpr double least_angle = 1e-4;
/// Candidates looked at for each occluder wanted, at most.
constexpr std::size_t looks = 8;
/// Silhouettes remembered for each occluder wanted.
constexpr std::size_t tracks = 4;

/// Only to choose, so without margins. Near and far planes do not matter for an occluder, the range does.
bool may_hide_in(const ViewVolume& volume, const Vec3& sight, double radius) {
  if (glm::length(sight) - radius > volume.range()) return false;
  if (volume.all_round()) return true;
  bool outside_all = true;
  for (const HalfSpace& side : volume) {
    const bool outside = glm::dot(side.normal, sight) < -radius;
    if (outside && volume.convex()) return false;
    outside_all = outside_all && outside;
  }
  return !outside_all;
}

}  // namespace

void RankedList::update(std::span<const RankedPart> candidates, std::span<std::uint32_t> places) {
  for (std::uint32_t i = 0; i < candidates.size(); ++i) places[candidates[i].entry] = i;
  std::size_t kept = 0;
  for (const RankedPart& old : parts_) {
    std::uint32_t& place = places[old.entry];
    if (place == no_place) continue;
    parts_[kept++] = candidates[place];
    place = no_place;
  }
  parts_.resize(kept);
  for (const RankedPart& candidate : candidates) {
    std::uint32_t& place = places[candidate.entry];
    if (place != no_place) parts_.push_back(candidate);
    place = no_place;
  }
  insertion_sort();
}

/// Far out of order, as in a viewer's first frame, it would be quadratic: then it is sorted otherwise. The order being
/// total, the result is the same.
void RankedList::insertion_sort() {
  const std::uint64_t most_moves = 8 * parts_.size();
  moves_ = 0;
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const RankedPart part = parts_[i];
    std::size_t at = i;
    for (; at > 0 && part.before(parts_[at - 1]); --at) parts_[at] = parts_[at - 1];
    parts_[at] = part;
    moves_ += i - at;
    if (moves_ > most_moves) {
      std::sort(parts_.begin(), parts_.end(), [](const RankedPart& a, const RankedPart& b) { return a.before(b); });
      return;
    }
  }
}

void OccluderChoice::begin_frame(const ShadowWorld& world, std::size_t views) {
  ++frame_;
  regions_.begin_frame(world);
  // Viewers that are gone are forgotten, now and then.
  if (viewers_.size() > 2 * views + 64) {
    std::erase_if(viewers_, [this](const auto& v) { return v.second.frame + 1 < frame_; });
  }
  if (entries_version_ == world.entries_version()) return;
  entries_version_ = world.entries_version();
  places_.assign(world.entries().size(), RankedList::no_place);
  for (auto& [id, viewer] : viewers_) {
    viewer.ranked.forget();
    // An id may have come back with another shape.
    for (Track& track : viewer.tracks) track.silhouette.known = false;
  }
}

void OccluderChoice::add_candidate(const ShadowWorld& world, std::uint32_t entry, double sampled, const Vec3& eye) {
  const double angle = world.area_angle_of(world.entries()[entry], eye);
  if (!(angle > least_angle)) return;
  const double all_directions = (world.dimension() == 2 ? 2.0 : 4.0) * std::numbers::pi;
  const double worth = weights_.angle * angle / all_directions + weights_.sampled * sampled;
  candidates_.push_back({world.entries()[entry].key(), entry, worth});
}

/// Static parts that promise something from the viewer's region, and all moving ones: by entry.
void OccluderChoice::rank(const ShadowWorld& world, const Vec3& eye, Viewer& viewer) {
  candidates_.clear();
  if (const auto* promises = regions_.at(world, eye)) {
    for (const OccluderRegions::Promise& p : *promises) add_candidate(world, p.entry, p.hidden, eye);
  } else {
    for (std::uint32_t i = 0; i < world.static_count(); ++i) add_candidate(world, i, 0.0, eye);
  }
  for (std::uint32_t i = world.static_count(); i < world.entries().size(); ++i) add_candidate(world, i, 0.0, eye);
  if (weights_.recent > 0.0) add_recent(world, viewer);
  viewer.ranked.update(candidates_, places_);
}

/// What hid well in the viewer's last frame will do so again.
void OccluderChoice::add_recent(const ShadowWorld& world, const Viewer& viewer) {
  const double all = static_cast<double>(world.boxes().size());
  for (const Track& track : viewer.tracks) {
    if (track.hidden == 0 || track.frame + 1 != frame_) continue;
    const auto found = std::lower_bound(candidates_.begin(), candidates_.end(), track.entry,
                                        [](const RankedPart& c, std::uint32_t entry) { return c.entry < entry; });
    if (found == candidates_.end() || found->key != track.key) continue;
    found->worth += weights_.recent * static_cast<double>(track.hidden) / all;
  }
}

std::span<const ShadowFrustum* const> OccluderChoice::choose(const ShadowWorld& world, const View& view,
                                                             const ViewVolume& volume,
                                                             std::span<const std::uint32_t> holders) {
  Viewer& viewer = viewers_[view.viewer];
  viewer.frame = frame_;
  const Vec3& eye = volume.apex();
  rank(world, eye, viewer);
  used_.clear();
  used_tracks_.clear();
  std::size_t looked_at = 0;
  for (const RankedPart& ranked : viewer.ranked.parts()) {
    if (used_.size() == count_ || looked_at == looks * count_) break;
    const PartEntry& entry = world.entries()[ranked.entry];
    if (entry.object == view.rides || std::find(holders.begin(), holders.end(), entry.place) != holders.end()) continue;
    if (!may_hide_in(volume, world.sight_of(entry, eye), entry.part->radius)) continue;
    ++looked_at;
    if (lies_in_shadow(world.boxes()[entry.place], eye)) continue;
    const FlatObject& flat = world.object(entry.place);
    Track& track = track_of(viewer, ranked.key);
    track.entry = ranked.entry;
    ShadowFrustum& frustum = frusta_[used_.size()];
    if (!frustum.build(*entry.part, flat.object.pose, flat.rotation, eye, track.silhouette)) continue;
    used_.push_back(&frustum);
    used_tracks_.push_back(&track);
  }
  return used_;
}

bool OccluderChoice::lies_in_shadow(const Bounds& box, const Vec3& eye) const {
  std::uint64_t tests = 0;
  const SightBox sight(box, eye);
  return std::any_of(used_.begin(), used_.end(),
                     [&](const ShadowFrustum* frustum) { return frustum->overlap(sight, tests) == Overlap::inside; });
}

/// The part's track, or the one not used for longest; there are more than one view uses.
OccluderChoice::Track& OccluderChoice::track_of(Viewer& viewer, std::uint64_t key) {
  if (viewer.tracks.empty()) viewer.tracks.resize(tracks * count_);
  Track* oldest = &viewer.tracks.front();
  for (Track& track : viewer.tracks) {
    if (track.frame != 0 && track.key == key) {
      track.frame = frame_;
      return track;
    }
    if (track.frame < oldest->frame) oldest = &track;
  }
  oldest->key = key;
  oldest->frame = frame_;
  oldest->hidden = 0;
  oldest->silhouette.known = false;
  return *oldest;
}

void OccluderChoice::learn(std::span<const std::uint64_t> hidden_by) {
  for (std::size_t i = 0; i < used_tracks_.size() && i < hidden_by.size(); ++i) used_tracks_[i]->hidden = hidden_by[i];
}

}  // namespace gridcull
