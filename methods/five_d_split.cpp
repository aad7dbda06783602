// The estimate of vis(A) and vis(B) for a plane between A and B comes from the rays that were cast from the whole cell:
// a member is in vis(A) when a ray from A hit it. So its least and its greatest coordinate along an axis among the rays
// that hit it decide for all planes across that axis at once, and no ray is cast twice.
//
// A member that few rays hit may lie on one side by chance. Were it seen alike from everywhere, h hits would all fall
// on one side with probability a^h + b^h, a and b being the sides' shares of the volume. The estimate takes that off:
// what is counted is how many more members lie on one side only, in proportion to how many more could. (Without it the
// smallest cells, of which all is seen alike, seem well worth dividing: measured in a street, cut into layers instead
// of lengths.)
//
// Candidates are the planes of the boxes of objects inside the cell, as the paper has it. Changed: where none of these
// is effective (a long street holds no object, and would never be divided), the planes of the objects seen from the
// cell that cut through it, and its middles.
#include "gridcull/methods/five_d_split.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gridcull {
namespace {

constexpr std::size_t at(int axis) { return static_cast<std::size_t>(axis); }

/// Along one axis, of the members that some ray hit.
struct Extents {
  std::vector<double> low{}, high{};
};

/// Copies what was inherited and casts up to the number asked for.
void top_up(const FiveDScene& scene, int wanted, CellWork& work, CellRays& rays) {
  std::vector<KeptRay> all;
  all.reserve(work.rays.size() + scene.members());
  std::size_t next = 0;
  for (std::uint32_t member = 0; member < scene.members(); ++member) {
    int have = 0;
    for (; next < work.rays.size() && work.rays[next].member == member; ++next, ++have) all.push_back(work.rays[next]);
    if (have >= wanted || rays.eighths(member) == 0) continue;
    KeptRay ray{};
    for (int tries = 4 * wanted; have < wanted && tries > 0; --tries) {
      if (!rays.aim(member, ray)) continue;
      rays.cast(ray);
      all.push_back(ray);
      ++have;
    }
  }
  work.rays = std::move(all);
}

class Candidates {
 public:
  Candidates(const FiveDScene& scene, const CellWork& work) : scene_(scene), work_(work) {
    const std::uint32_t members = scene.members();
    std::vector<std::uint32_t> place(members, none);
    for (const KeptRay& ray : work.rays) {
      if (!ray.hit) continue;
      if (place[ray.member] == none) {
        place[ray.member] = static_cast<std::uint32_t>(seen_.size());
        seen_.push_back(ray.member);
        hits_.push_back(0);
        for (Extents& e : extents_) e.low.push_back(infinity), e.high.push_back(-infinity);
      }
      const std::uint32_t i = place[ray.member];
      most_hits_ = std::max(most_hits_, ++hits_[i]);
      for (std::size_t k = 0; k < view_axes; ++k) {
        extents_[k].low[i] = std::min(extents_[k].low[i], static_cast<double>(ray.at[k]));
        extents_[k].high[i] = std::max(extents_[k].high[i], static_cast<double>(ray.at[k]));
      }
    }
  }

  std::size_t seen() const { return seen_.size(); }

  /// The planes of the boxes of objects inside the cell.
  void try_objects_inside() {
    for (std::uint32_t i = 0; i < scene_.space().statics; ++i) {
      if (meets(scene_.box(i))) try_box(scene_.box(i));
    }
  }
  /// Of those seen from it, and its middles.
  void try_objects_seen() {
    for (const std::uint32_t member : seen_) {
      if (member < scene_.space().statics) try_box(scene_.box(member));
    }
    for (int axis = 0; axis < 3; ++axis) try_plane(axis, 0.5 * (work_.cell.low[at(axis)] + work_.cell.high[at(axis)]));
  }
  void try_directions(int count) {
    for (const int axis : {turn_axis, rise_axis}) {
      const double low = scene_.space().low(axis), high = scene_.space().high(axis);
      for (int i = 1; i <= count; ++i) try_plane(axis, low + (high - low) * i / (count + 1));
    }
  }

  const FiveDSplit& best() const { return best_; }

 private:
  static constexpr std::uint32_t none = 0xFFFF'FFFFu;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  bool meets(const Bounds& box) const {
    for (int axis = 0; axis < scene_.space().dimension; ++axis) {
      if (box.max[axis] < work_.cell.low[at(axis)] || box.min[axis] > work_.cell.high[at(axis)]) return false;
    }
    return true;
  }
  void try_box(const Bounds& box) {
    for (int axis = 0; axis < scene_.space().dimension; ++axis) {
      try_plane(axis, box.min[axis]);
      try_plane(axis, box.max[axis]);
    }
  }
  void try_plane(int axis, double where) {
    const FiveDSpace& space = scene_.space();
    const double low = work_.cell.low[at(axis)], high = work_.cell.high[at(axis)];
    if (!space.has(axis) || !(where > low && where < high)) return;
    const std::uint32_t step = space.nearest_step(axis, where);
    const double plane = space.plane(axis, step);
    if (!(plane > low && plane < high)) return;
    std::vector<std::uint32_t>& tried = tried_[at(axis)];
    const auto place = std::lower_bound(tried.begin(), tried.end(), step);
    if (place != tried.end() && *place == step) return;
    tried.insert(place, step);
    weigh(axis, step, plane);
  }
  /// The paper's measure. Ties go to the plane that was tried first.
  void weigh(int axis, std::uint32_t step, double plane) {
    const double low = work_.cell.low[at(axis)], high = work_.cell.high[at(axis)];
    const double share = (plane - low) / (high - low);
    chances_.assign(1, 2.0);
    for (double a = share, b = 1.0 - share; chances_.size() <= most_hits_; a *= share, b *= 1.0 - share) {
      chances_.push_back(a + b);
    }
    const Extents& e = extents_[at(axis)];
    double apart = 0.0, possible = 0.0;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const double chance = chances_[hits_[i]];
      apart += (e.low[i] < plane && e.high[i] >= plane ? 0.0 : 1.0) - chance;
      possible += 1.0 - chance;
    }
    const double gain = possible > 0.0 ? apart / possible : 0.0;
    const double balance = 1.0 - std::fabs((plane - low) - (high - plane)) / (high - low);
    if (gain * balance > best_.effectiveness) best_ = {axis, step, gain * balance};
  }

  const FiveDScene& scene_;
  const CellWork& work_;
  std::vector<std::uint32_t> seen_{};
  std::vector<std::uint32_t> hits_{};
  std::uint32_t most_hits_ = 0;
  std::vector<double> chances_{};  ///< by hits: that all fall on one side
  std::array<Extents, view_axes> extents_{};
  std::array<std::vector<std::uint32_t>, view_axes> tried_{};
  FiveDSplit best_{};
};

}  // namespace

std::optional<FiveDSplit> choose_split(const FiveDScene& scene, const FiveDOptions& options, CellWork& work,
                                       FiveDScene::Scratch& scratch, std::uint64_t& cast) {
  if (work.budget < 2) return std::nullopt;
  CellRays rays(scene, work.cell, work.seed, scratch);
  if (rays.solid()) return std::nullopt;
  top_up(scene, options.estimate_rays, work, rays);
  cast += rays.cast_count();
  Candidates candidates(scene, work);
  if (candidates.seen() < 2) return std::nullopt;
  candidates.try_objects_inside();
  candidates.try_directions(options.direction_planes);
  if (candidates.best().effectiveness < options.effectiveness) candidates.try_objects_seen();
  if (!(candidates.best().effectiveness > 0.0) || candidates.best().effectiveness < options.effectiveness) {
    return std::nullopt;
  }
  return candidates.best();
}

std::array<CellWork, 2> divide(const FiveDScene& scene, CellWork& work, const FiveDSplit& split) {
  const std::size_t k = at(split.axis);
  const double plane = scene.space().plane(split.axis, split.step);
  std::array<CellWork, 2> parts;
  Random seeds(work.seed);
  for (CellWork& part : parts) part.cell = work.cell, part.seed = seeds.bits();
  parts[0].cell.high[k] = parts[1].cell.low[k] = plane;
  const double share = (plane - work.cell.low[k]) / (work.cell.high[k] - work.cell.low[k]);
  parts[0].share = work.share * share;
  parts[1].share = work.share - parts[0].share;
  // Cells go where lines of sight are blocked: above the roofs, where all is seen, there is little to gain. One ray
  // each keeps a part without rays from having no share at all.
  std::array<double, 2> blocked{1.0, 1.0};
  for (const KeptRay& ray : work.rays) {
    const std::size_t side = static_cast<double>(ray.at[k]) < plane ? 0 : 1;
    if (!ray.hit) blocked[side] += 1.0;
    parts[side].rays.push_back(ray);
  }
  const double first = std::floor(work.budget * blocked[0] / (blocked[0] + blocked[1]) + 0.5);
  parts[0].budget = static_cast<std::uint32_t>(std::clamp(first, 1.0, work.budget - 1.0));
  parts[1].budget = work.budget - parts[0].budget;
  work.rays = {};
  return parts;
}

}  // namespace gridcull
