// The exact visible set in 2D by an angular sweep, after T. Asano, "An efficient algorithm for finding the
// visibility polygon for a polygonal region with holes", 1985. Changed: walls may cross, so every crossing is a cut
// too, and each interval between cuts is judged afresh along its middle, instead of keeping a sorted tree from one
// to the next: slower by a factor, but no answer rests on the one before.
//
// Along one ray a body is *touched* where its closed shape begins and *entered* where its interior does. A body is
// seen in an interval when it is touched within the range and no other body is entered before. Only the nearest
// entry B matters: its own body is seen; any other body is seen when touched at B or before.
// Cuts: ends of walls, tangents of discs, crossings of walls of different bodies, crossings with the range, the
// field of view. Between two cuts all touches and entries are continuous and none meets another body's, so the
// middle speaks for the whole interval.
#include <algorithm>
#include <array>
#include <limits>

#include "gridcull/core/exact.h"
#include "gridcull/core/exact_2d_crossings.h"
#include "gridcull/core/exact_2d_walls.h"

namespace gridcull {
namespace exact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Radians; what is seen through less is left out.
constexpr double least_width = 1e-9;

/// Where a ray meets a wall, and how wrong that may be.
struct Hit {
  double distance;
  double error;
};

/// Along one ray: where a body begins and where it begins to hide, with errors in favour of being seen.
struct Reach {
  double touch = infinity;
  double entry = infinity;
};

class Sweep {
 public:
  explicit Sweep(const Surroundings& around)
      : around_(around), next_(around.walls.size(), none), head_(around.bodies.size(), none) {
    seen_width_.resize(around.bodies.size(), 0.0);
    seen_along_.resize(around.bodies.size(), Vec2(0.0));
  }

  void run() {
    collect_events();
    double turn = 0.0;
    for (const Event& event : events_) {
      judge_between(turn, event.turn);
      turn = event.turn;
      if (event.wall == none) continue;
      if (event.begins) {
        enter(event.wall);
      } else {
        leave(event.wall);
      }
    }
    judge_between(turn, full_turn);
  }

  bool seen(std::size_t body) const { return seen_width_[body] > 0.0; }
  Vec3 witness(std::size_t body) const { return {seen_along_[body], 0.0}; }

 private:
  static constexpr std::uint32_t none = 0xFFFF'FFFFu;

  struct Event {
    double turn;
    std::uint32_t wall;  ///< none: a cut only
    bool begins;
  };

  void collect_events() {
    std::vector<double> cuts;
    add_crossings(around_, cuts);
    if (!around_.sector.all()) {
      cuts.push_back(around_.sector.from);
      cuts.push_back(end_of(around_.sector));
    }
    events_.reserve(cuts.size() + 2 * around_.walls.size());
    for (const double turn : cuts) events_.push_back({turn, none, false});
    for (std::uint32_t i = 0; i < around_.walls.size(); ++i) {
      const Sector& span = around_.walls[i].span;
      if (end_of(span) < span.from) enter(i);  // spans turn 0
      events_.push_back({span.from, i, true});
      events_.push_back({end_of(span), i, false});
    }
    std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
      return a.turn < b.turn || (a.turn == b.turn && (a.wall < b.wall || (a.wall == b.wall && a.begins < b.begins)));
    });
  }

  static double end_of(const Sector& sector) {
    const double end = sector.from + sector.width;
    return end < full_turn ? end : end - full_turn;
  }

  void enter(std::uint32_t wall) {
    const std::uint32_t body = around_.walls[wall].body;
    if (head_[body] == none) {
      const auto place = std::lower_bound(active_.begin(), active_.end(), body,
                                          [&](std::uint32_t a, std::uint32_t b) { return nearer(a, b); });
      active_.insert(place, body);
    }
    next_[wall] = head_[body];
    head_[body] = wall;
  }

  void leave(std::uint32_t wall) {
    const std::uint32_t body = around_.walls[wall].body;
    std::uint32_t* link = &head_[body];
    while (*link != wall) link = &next_[*link];
    *link = next_[wall];
    if (head_[body] != none) return;
    active_.erase(std::lower_bound(active_.begin(), active_.end(), body,
                                   [&](std::uint32_t a, std::uint32_t b) { return nearer(a, b); }));
  }

  bool nearer(std::uint32_t a, std::uint32_t b) const {
    const double da = around_.bodies[a].nearest, db = around_.bodies[b].nearest;
    return da < db || (da == db && a < b);
  }

  void judge_between(double from, double to) {
    if (!(to - from > 0.5 * least_width) || active_.empty()) return;
    const double middle = 0.5 * (from + to);
    if (!around_.sector.holds(middle)) return;
    const Vec2 diamond = diamond_at(middle);
    const double square = glm::dot(diamond, diamond);
    const double width = (to - from) / square;
    if (width > least_width) judge(diamond / std::sqrt(square), width);
  }

  /// Bodies come by their least distance, so those beyond the nearest entry need no look.
  void judge(const Vec2& ray, double width) {
    double nearest_entry = infinity;
    candidates_.clear();
    for (const std::uint32_t body : active_) {
      const Body& b = around_.bodies[body];
      if (b.nearest > nearest_entry || b.nearest > around_.range) break;
      const Reach reach = reach_along(ray, body);
      if (reach.touch <= around_.range) candidates_.push_back({reach.touch, body});
      if (b.occluder) nearest_entry = std::min(nearest_entry, reach.entry);
    }
    for (const auto& [touch, body] : candidates_) {
      if (touch > nearest_entry || width <= seen_width_[body]) continue;
      seen_width_[body] = width;
      seen_along_[body] = ray;
    }
  }

  double error_at(double distance) const { return tie * (around_.magnitude + distance); }

  Reach reach_along(const Vec2& ray, std::uint32_t body) {
    const Wall& first = around_.walls[head_[body]];
    switch (around_.bodies[body].kind) {
      case BodyKind::disc: return disc_along(ray, first);
      case BodyKind::thin: return thin_along(ray, body);
      case BodyKind::solid: break;
    }
    hits_.clear();
    for (std::uint32_t i = head_[body]; i != none; i = next_[i]) hits_.push_back(hit(ray, around_.walls[i]));
    std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
    // Parity from the far end, so that it does not matter on which side of its own wall the viewer rounds to.
    Reach reach;
    const std::size_t count = hits_.size();
    const Hit eye{0.0, error_at(0.0)};
    reach.touch = count % 2 == 1 ? 0.0 : hits_[0].distance - hits_[0].error;
    for (std::size_t k = 0; k < count; ++k) {
      if ((count - k) % 2 == 0) continue;  // the stretch before hit k is outside
      const Hit& begin = k == 0 ? eye : hits_[k - 1];
      if (hits_[k].distance - begin.distance <= hits_[k].error + begin.error) continue;
      reach.entry = begin.distance + begin.error;
      break;
    }
    return reach;
  }

  Hit hit(const Vec2& ray, const Wall& wall) const {
    const double slope = cross2(ray, wall.along);
    const double distance = std::max(0.0, wall.power / slope);
    return {distance, error_at(distance) + std::fabs(wall.slack / slope)};
  }

  Reach thin_along(const Vec2& ray, std::uint32_t body) const {
    Reach reach;
    for (std::uint32_t i = head_[body]; i != none; i = next_[i]) {
      const Hit h = hit(ray, around_.walls[i]);
      reach.touch = std::min(reach.touch, h.distance - h.error);
      reach.entry = std::min(reach.entry, h.distance + h.error);
    }
    return reach;
  }

  Reach disc_along(const Vec2& ray, const Wall& disc) const {
    const double across = cross2(ray, disc.a), along = glm::dot(ray, disc.a);
    const double half_chord = std::sqrt(std::max(0.0, (disc.radius - across) * (disc.radius + across)));
    const double distance = disc.power > 0.0 ? disc.power / (along + half_chord) : 0.0;
    const double error = error_at(distance) + (half_chord > 0.0 ? disc.slack / half_chord : infinity);
    Reach reach{distance - error, infinity};
    if (along + half_chord - distance > 2.0 * error) reach.entry = distance + error;
    return reach;
  }

  struct Candidate {
    double touch;
    std::uint32_t body;
  };

  const Surroundings& around_;
  std::vector<Event> events_;
  std::vector<std::uint32_t> next_;    ///< next wall of the same body that the ray meets
  std::vector<std::uint32_t> head_;    ///< a body's first such wall
  std::vector<std::uint32_t> active_;  ///< bodies that the ray meets, nearest first
  std::vector<Hit> hits_;
  std::vector<Candidate> candidates_;
  std::vector<double> seen_width_;  ///< radians: the widest interval in which a body was seen
  std::vector<Vec2> seen_along_;
};

}  // namespace
}  // namespace exact

ExactAnswer exact_visible_2d(std::span<const Object> world, const View& view) {
  const exact::Surroundings around = exact::look_around(world, view);
  exact::Sweep sweep(around);
  sweep.run();
  std::vector<std::pair<ObjectId, Vec3>> found;
  for (const ObjectId id : around.containers) found.emplace_back(id, Vec3(0.0));
  for (std::size_t i = 0; i < around.bodies.size(); ++i) {
    if (sweep.seen(i)) found.emplace_back(around.bodies[i].id, sweep.witness(i));
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  ExactAnswer answer;
  for (const auto& [id, along] : found) {
    answer.visible.push_back(id);
    answer.witness.push_back(along);
  }
  return answer;
}

}  // namespace gridcull
