// Maximal convex parts by cutting. Each wall wants a part that holds all of it: from a thin triangle on the wall's
// inner side (the seed) the outline's box is cut down, always along the line of a wall that still intrudes, the one
// that leaves most, until no wall does. So an L gives its two overlapping rectangles, where a partition (S. Hertel and
// K. Mehlhorn, 1983; J. M. Keil, 1985) would leave a seam that a mask of pixels leaks through. What is still uncovered
// (seen from above) is looked for with a few sample points.
//
// Claim. Nothing is believed of how parts are found: each is pulled in a little (a crossing of two lines has no
// exact coordinates) and then checked exactly by lies_inside(); what fails is pulled in more and at last dropped.
#include "gridcull/grid/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "gridcull/core/bounds.h"
#include "gridcull/grid/convex_cut.h"
#include "gridcull/grid/exact_side.h"
#include "gridcull/grid/outline_hull.h"

namespace gridcull {
namespace {

constexpr std::size_t most_parts = 96, most_corners = 32;
/// Samples along each side of the box for what no wall's part covers.
constexpr int samples = 12;
/// Walls times corners looked at for one outline, a bound of the time (about a second) for outlines of thousands of
/// corners: what is not found by then does not occlude.
constexpr std::uint64_t most_work = 20'000'000;

/// The line from a to b with the seed on its left.
struct Line {
  Vec2 a, b;
};

bool all_left(const ConvexPart& seed, const Line& line) {
  return std::all_of(seed.begin(), seed.end(), [&](const Vec2& p) { return side_of_line(line.a, line.b, p) >= 0; });
}

/// The line through a and b, either way round, if it keeps the seed on its left and the wall on its right.
void offer(const Vec2& a, const Vec2& b, const Wall& wall, const ConvexPart& seed, std::vector<Line>& out) {
  for (const Line& l : {Line{a, b}, Line{b, a}}) {
    if (a != b && side_of_line(l.a, l.b, wall.a) <= 0 && side_of_line(l.a, l.b, wall.b) <= 0 && all_left(seed, l)) {
      out.push_back(l);
    }
  }
}

/// Lines through an end of the wall: along the seed's base, or through a corner of the seed. Where the wall's own line
/// crosses the seed, one of these parts the two.
void add_tangents(const Wall& wall, const ConvexPart& seed, std::vector<Line>& out) {
  for (const Vec2& end : {wall.a, wall.b}) {
    offer(end, end + (seed[1] - seed[0]), wall, seed, out);
    for (const Vec2& p : seed) offer(end, p, wall, seed, out);
  }
}

/// The cut that leaves most, along a wall's own line if there is one such; none: an empty part.
Line best_cut(const std::vector<Wall>& intruders, const ConvexPart& seed, ConvexPart& part) {
  std::vector<Line> lines;
  for (const Wall& wall : intruders) offer(wall.a, wall.b, wall, seed, lines);
  if (lines.empty()) {
    for (const Wall& wall : intruders) add_tangents(wall, seed, lines);
  }
  ConvexPart best;
  Line best_line{};
  for (const Line& line : lines) {
    ConvexPart left = strictly_convex(cut_left(part, line.a, line.b));
    if (best.empty() || area_of(left) > area_of(best)) best = std::move(left), best_line = line;
  }
  part = std::move(best);
  return best_line;
}

/// Cuts the box down to a part that holds the seed and that no wall intrudes into, but for the rounding of its corners:
/// a wall that a cut has on its right is done with, or it would seem to intrude again and again.
ConvexPart grow(const ConvexPart& seed, std::vector<Wall> walls, ConvexPart part, std::uint64_t& work) {
  std::vector<Wall> intruders;
  while (part.size() >= 3 && work < most_work) {
    work += walls.size() * part.size();
    intruders.clear();
    for (const Wall& wall : walls) {
      if (intrudes(wall, part)) intruders.push_back(wall);
    }
    if (intruders.empty()) return part;
    work += intruders.size() * part.size();
    const Line cut = best_cut(intruders, seed, part);
    std::erase_if(walls, [&](const Wall& w) {
      return side_of_line(cut.a, cut.b, w.a) <= 0 && side_of_line(cut.a, cut.b, w.b) <= 0;
    });
  }
  return {};
}

/// A subset of the corners spans a smaller part.
ConvexPart with_few_corners(ConvexPart part) {
  while (part.size() > most_corners) {
    ConvexPart fewer;
    for (std::size_t i = 0; i < part.size(); i += 2) fewer.push_back(part[i]);
    part = std::move(fewer);
  }
  return part;
}

/// Pulled in by as little as the exact check asks for.
std::optional<ConvexPart> checked(const ConvexPart& part, const std::vector<Wall>& walls) {
  if (part.size() < 3) return std::nullopt;
  if (lies_inside(part, walls)) return part;
  Vec2 middle(0.0);
  for (const Vec2& p : part) middle += p;
  middle /= static_cast<double>(part.size());
  for (double pull = 0x1p-50; pull < 0x1p-20; pull *= 16.0) {
    ConvexPart pulled = part;
    for (Vec2& p : pulled) p += pull * (middle - p);
    pulled = strictly_convex(pulled);
    if (lies_inside(pulled, walls)) return pulled;
  }
  return std::nullopt;
}

bool strictly_holds(const ConvexPart& part, const Vec2& p) {
  for (std::size_t i = 0, j = part.size() - 1; i < part.size(); j = i++) {
    if (side_of_line(part[j], part[i], p) <= 0) return false;
  }
  return !part.empty();
}

class Parts {
 public:
  explicit Parts(std::vector<Wall> walls) : walls_(std::move(walls)) {
    Bounds box;
    for (const Wall& w : walls_) box.add({w.a, 0.0}), box.add({w.b, 0.0});
    low_ = Vec2(box.min), size_ = Vec2(box.size());
    box_ = {low_, {low_.x + size_.x, low_.y}, low_ + size_, {low_.x, low_.y + size_.y}};
  }

  std::vector<ConvexPart> find() {
    if (walls_.empty() || !(size_.x > 0.0 && size_.y > 0.0)) return {};
    std::vector<Wall> longest_first = walls_;
    std::stable_sort(longest_first.begin(), longest_first.end(),
                     [](const Wall& v, const Wall& w) { return glm::distance(v.a, v.b) > glm::distance(w.a, w.b); });
    for (const Wall& w : longest_first) {
      if (has_room()) add_for(w);
    }
    for (int i = 0; i < samples * samples && has_room(); ++i) add_at(i % samples, i / samples);
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const ConvexPart& a, const ConvexPart& b) { return area_of(a) > area_of(b); });
    return std::move(parts_);
  }

 private:
  bool has_room() const { return parts_.size() < most_parts && work_ < most_work; }

  /// The part that holds the wall: its seed has the wall as base and a low tip, lower while it is not free.
  void add_for(const Wall& wall) {
    const Vec2 along = wall.b - wall.a, middle = wall.a + 0.5 * along;
    const Vec2 across(-along.y, along.x);
    for (const double side : {1.0, -1.0}) {
      for (double height = 0x1p-7; height > 0x1p-20; height *= 0x1p-4) {
        const Vec2 tip = middle + side * height * across;
        const ConvexPart seed = side > 0.0 ? ConvexPart{wall.a, wall.b, tip} : ConvexPart{wall.b, wall.a, tip};
        if (std::any_of(walls_.begin(), walls_.end(), [&](const Wall& w) { return intrudes(w, seed); })) continue;
        const Vec2 inner = middle + side * 0.5 * height * across;
        if (is_inside(walls_, inner) && !covered(wall, inner)) add(grow(seed, walls_, box_, work_));
        break;
      }
    }
  }

  void add_at(int i, int j) {
    const Vec2 p = low_ + size_ * Vec2((i + 0.487) / samples, (j + 0.513) / samples);
    if (!is_inside(walls_, p)) return;
    for (const ConvexPart& part : parts_) {
      if (strictly_holds(part, p)) return;
    }
    const double tiny = 1e-6 * std::min(size_.x, size_.y);
    add(grow({p, p + Vec2(tiny, 0.0), p + Vec2(0.0, tiny)}, walls_, box_, work_));
  }

  /// Whether a part already holds the place beside the wall and (nearly) all of the wall.
  bool covered(const Wall& wall, const Vec2& inner) const {
    const Vec2 a = inner + 0.999 * (wall.a - inner), b = inner + 0.999 * (wall.b - inner);
    return std::any_of(parts_.begin(), parts_.end(), [&](const ConvexPart& part) {
      return strictly_holds(part, inner) && strictly_holds(part, a) && strictly_holds(part, b);
    });
  }

  void add(const ConvexPart& part) {
    if (auto good = checked(with_few_corners(part), walls_)) parts_.push_back(std::move(*good));
  }

  std::vector<Wall> walls_;
  Vec2 low_{0.0}, size_{0.0};
  ConvexPart box_;
  std::vector<ConvexPart> parts_;
  std::uint64_t work_ = 0;
};

}  // namespace

std::vector<ConvexPart> convex_parts(const std::vector<Vec2>& outline) {
  const std::vector<Wall> walls = walls_of(outline);
  // One part where the outline is convex itself, however many corners it has.
  std::vector<Vec2> ends;
  for (const Wall& w : walls) ends.insert(ends.end(), {w.a, w.b});
  const ConvexPart hull = hull_of_outline(ends);
  if (lies_inside(hull, walls)) return {with_few_corners(hull)};
  return Parts(walls).find();
}

}  // namespace gridcull
