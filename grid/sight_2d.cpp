#include "gridcull/grid/sight_2d.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gridcull {
namespace {

/// Of the distance: see the claim about discs.
constexpr double disc_margin = 1e-10;
/// Of the range: norms of points relative to the viewer are off by less than 4 u.
constexpr double range_margin = 0x1p-50;

/// Straight pieces of the near side with which a disc hides: more than the chord between its tangents matters only to
/// what overlaps the disc, and little from afar. 300 discs that overlap at random: 1.05 times too many with one piece,
/// 1.03 with two, 1.007 with four, 1.000 with eight.
constexpr std::size_t arcs = 4;
constexpr double far_away = 24.0;  // radii

struct Span {
  Bearing from, to;
};

/// Directions `centre` turned by -+ the angle whose cosine and sine are as `along` and `across`.
Span turned_both_ways(const Vec2& centre, double along, double across) {
  const Vec2 ahead = along * centre, left = across * Vec2(-centre.y, centre.x);
  return {bearing_of(ahead - left), bearing_of(ahead + left)};
}

}  // namespace

void Sight2D::begin(const ViewVolume& volume) {
  eye_ = Vec2(volume.apex());
  range_ = volume.range();
  blur_ = tie * std::max(std::fabs(eye_.x), std::fabs(eye_.y));
  least_ = least_width;
  buffer_.reset();
  if (volume.all_round()) return;
  // The sides' normals point inwards, clockwise side first; the rays that bound the field of view:
  const Vec3 &right = volume.begin()[0].normal, &left = volume.begin()[1].normal;
  const Bearing first = bearing_of({right.y, -right.x}), last = bearing_of({-left.y, left.x});
  // Normals of unit length: the sine of the angle between the sides.
  if (volume.convex() && glm::dot(Vec2(left), Vec2(right)) < 0.0 && std::fabs(cross2(left, right)) < tiny) least_ = 0.0;
  const auto close = [&](int q, double from, double to) { buffer_.close(q, from, to); };
  if (volume.convex() && last.quadrant == first.quadrant) {
    // All but a part of one quadrant.
    close(last.quadrant, last.slope, 1.0);
    for (int k = 1; k < 4; ++k) close((last.quadrant + k) & 3, -1.0, 1.0);
    close(first.quadrant, -1.0, first.slope);
  } else {
    for_each_run(last, first, close);
  }
}

Sight2D::Disc Sight2D::look_at_disc(const Vec2& centre, double square, double radius) const {
  const double distance = std::sqrt(square);
  const double outer = radius + disc_margin * distance + 2.0 * blur_;
  const double gap = distance - outer;
  if (distance - radius > range_ * (1.0 + range_margin) + range_margin * distance) return Disc::hidden;
  if (!(gap > 0.0)) return Disc::around;
  const double power = gap * (distance + outer), tangent = std::sqrt(power);
  Span span;
  if (tangent <= range_) {
    span = turned_both_ways(centre, tangent, outer);
  } else {
    // The near side leaves the range before its tangents: directions to where the circles cross.
    const double along = std::min(distance, 0.5 * (range_ * range_ + power) / distance);
    const double rest = (range_ - along) * (range_ + along) + 1e-14 * square;
    span = turned_both_ways(centre, along, std::sqrt(std::max(0.0, rest)));
  }
  const double least = seems_tiny(square, radius) ? 0.0 : least_;
  double width = 0.0;
  for_each_run(span.from, span.to, [&](int q, double from, double to) {
    if (width > least) return;
    width += buffer_.open_width(q, from, to, {turned(q, centre), outer, power}, least - width);
  });
  return width > least ? Disc::open : Disc::hidden;
}

void Sight2D::hide_behind_disc(const Vec2& centre, double radius, std::uint32_t owner) {
  const double distance = glm::length(centre);
  const double inner = std::min(radius, distance) - disc_margin * distance - 2.0 * blur_;
  if (!(inner > 0.0)) return;
  if (distance > far_away * inner) return hide_behind_chord(centre, distance, inner, owner);
  // Spokes from the centre to the tangent points, to the nearest point and halfway between.
  const double power = (distance - inner) * (distance + inner);
  const Vec2 ahead = (-inner * inner / (distance * distance)) * centre;
  const Vec2 left = (inner * std::sqrt(power) / (distance * distance)) * Vec2(-centre.y, centre.x);
  std::array<Vec2, arcs + 1> spokes;
  spokes[0] = ahead - left;
  spokes[arcs] = ahead + left;
  spokes[arcs / 2] = (-inner / distance) * centre;
  for (std::size_t step = arcs / 4; step > 0; step /= 2) {
    for (std::size_t i = step; i < arcs; i += 2 * step) {
      const Vec2 sum = spokes[i - step] + spokes[i + step];
      spokes[i] = (inner / glm::length(sum)) * sum;
    }
  }
  Vec2 p = centre + spokes[0];
  Bearing from = bearing_of(p);
  for (std::size_t i = 1; i <= arcs; ++i) {
    const Vec2 q = centre + spokes[i];
    const Bearing to = bearing_of(q);
    if (cross2(p, q) > 0.0) (void)hide_behind_edge(from, to, line_of_edge(p, q, blur_), owner);
    p = q;
    from = to;
  }
}

void Sight2D::hide_behind_chord(const Vec2& centre, double distance, double radius, std::uint32_t owner) {
  const double power = (distance - radius) * (distance + radius);
  const Span span = turned_both_ways(centre, std::sqrt(power), radius);
  (void)hide_behind_edge(span.from, span.to, {centre / power, tie, 0.0}, owner);
}

bool Sight2D::hides_square(const Vec2& centre, double half) const {
  const double grown = half + disc_margin * (std::fabs(centre.x) + std::fabs(centre.y)) + 2.0 * blur_;
  return hides_grown({centre - Vec2(grown), centre + Vec2(grown)});
}

bool Sight2D::hides_box(const Vec2& low, const Vec2& high) const {
  const Vec2 far = glm::max(glm::abs(low), glm::abs(high));
  const double grown = disc_margin * (far.x + far.y) + 2.0 * blur_;
  return hides_grown({low - Vec2(grown), high + Vec2(grown)});
}

bool Sight2D::hides_grown(const Box2D& box) const {
  const Vec2 centre = box.low + box.high;
  const bool below = centre.y<centre.x, right = centre.y> - centre.x;
  const int home = below ? (right ? 0 : 3) : (right ? 1 : 2);
  const Part part = part_in(home, box);
  if (!part.hidden) return false;
  // It lies ahead of the axis, so it reaches no farther than into the neighbours.
  return (part.to <= 1.0 || part_in((home + 1) & 3, box).hidden) &&
         (part.from >= -1.0 || part_in((home + 3) & 3, box).hidden);
}

Sight2D::Part Sight2D::part_in(int quadrant, const Box2D& box) const {
  const Vec2 a = turned(quadrant, box.low), b = turned(quadrant, box.high);
  const Vec2 least = glm::min(a, b), most = glm::max(a, b);
  if (!(least.x > 0.0)) return {};
  const double near = 1.0 / least.x, far = 1.0 / most.x;
  const double from = least.y * (least.y < 0.0 ? near : far), to = most.y * (most.y < 0.0 ? far : near);
  return {buffer_.nearer(quadrant, std::max(from, -1.0), std::min(to, 1.0), near), from, to};
}

// Without a branch, for all lanes. Most boxes lie within one quadrant: there they have X > 0 and |Y| <= X throughout.
void Sight2D::spans_of(const BoxLanes& world, std::array<BoxSpan, BoxLanes::count>& out) const {
  BoxLanes box;  // relative to the viewer and grown
  for (std::size_t i = 0; i < BoxLanes::count; ++i) {
    const double lx = world.low_x[i] - eye_.x, ly = world.low_y[i] - eye_.y;
    const double hx = world.high_x[i] - eye_.x, hy = world.high_y[i] - eye_.y;
    const double far_x = std::max(std::fabs(lx), std::fabs(hx)), far_y = std::max(std::fabs(ly), std::fabs(hy));
    const double grown = disc_margin * (far_x + far_y) + 2.0 * blur_;
    box.low_x[i] = lx - grown, box.low_y[i] = ly - grown;
    box.high_x[i] = hx + grown, box.high_y[i] = hy + grown;
  }
  BoxLanes::Lanes home, least, most, low, high;  // along the quadrant's axis, and across it
  for (std::size_t i = 0; i < BoxLanes::count; ++i) {
    const double lx = box.low_x[i], ly = box.low_y[i], hx = box.high_x[i], hy = box.high_y[i];
    const bool is_east = (lx > 0.0) & (hy <= lx) & (ly >= -lx), is_north = (ly > 0.0) & (hx <= ly) & (lx >= -ly);
    const bool is_west = (hx < 0.0) & (ly >= hx) & (hy <= -hx), is_south = (hy < 0.0) & (lx >= hy) & (hx <= -hy);
    home[i] = is_east ? 0.0 : is_north ? 1.0 : is_west ? 2.0 : is_south ? 3.0 : -1.0;
    least[i] = is_east ? lx : is_north ? ly : is_west ? -hx : -hy;
    most[i] = is_east ? hx : is_north ? hy : is_west ? -lx : -ly;
    low[i] = is_east ? ly : is_north ? -hx : is_west ? -hy : lx;
    high[i] = is_east ? hy : is_north ? -lx : is_west ? -ly : hx;
  }
  for (std::size_t i = 0; i < BoxLanes::count; ++i) {
    const double near = 1.0 / least[i], far = 1.0 / most[i];
    const double from = low[i] * (low[i] < 0.0 ? near : far), to = high[i] * (high[i] < 0.0 ? far : near);
    out[i] = {std::max(from, -1.0), std::min(to, 1.0), near, static_cast<int>(home[i])};
  }
}

bool Sight2D::shows_box(const Vec2& low, const Vec2& high) const {
  const double dx = std::max({low.x, -high.x, 0.0}), dy = std::max({low.y, -high.y, 0.0});
  if (dx == 0.0 && dy == 0.0) return true;
  if (dx * dx + dy * dy > range_ * range_ * (1.0 + range_margin)) return false;
  const auto shows = [&](const Vec2& a, const Vec2& b) {
    const EdgeTurn turn = turn_of_edge(a, b, blur_);
    if (turn.facing == Facing::touches) return true;
    const bool left = turn.facing == Facing::left;
    return turn.facing != Facing::radial && open_width(a, b, left, turn.line(), least_) > least_;
  };
  const double x = low.x > 0.0 ? low.x : high.x, y = low.y > 0.0 ? low.y : high.y;
  return (dx > 0.0 && shows({x, low.y}, {x, high.y})) || (dy > 0.0 && shows({low.x, y}, {high.x, y}));
}

double Sight2D::open_width(const Bearing& from, const Bearing& to, const EdgeLine& line, double enough) const {
  double width = 0.0;
  for_each_run(from, to, [&](int q, double begin, double end) {
    if (width <= enough) width += buffer_.open_width(q, begin, end, line.high(q), enough - width);
  });
  return width;
}

double Sight2D::open_width(const Vec2& a, const Vec2& b, bool left, const EdgeLine& line, double enough) const {
  return open_width(bearing_of(left ? a : b), bearing_of(left ? b : a), line, enough);
}

double Sight2D::open_width_in_range(const Vec2& a, const Vec2& b, bool left, const EdgeLine& line,
                                    double enough) const {
  const double limit = range_ * range_;
  if (glm::dot(a, a) <= limit && glm::dot(b, b) <= limit) return open_width(a, b, left, line, enough);
  const Vec2 d = b - a;
  const double square = glm::dot(d, d), middle = -glm::dot(a, d) / square;
  const Vec2 foot = a + middle * d;  // the line's nearest point
  const double rest = limit - glm::dot(foot, foot) + 8.0 * range_margin * (limit + glm::dot(a, a));
  if (rest < 0.0) return 0.0;
  const double half = std::sqrt(rest / square);
  // Rounded outwards: the error of t is some ulp of the ends' distances over the edge's length.
  const double blur = 0x1p-48 * (1.0 + std::fabs(middle) + half);
  const double t0 = middle - half - blur, t1 = middle + half + blur;
  if (t0 >= 1.0 || t1 <= 0.0) return 0.0;
  return open_width(t0 > 0.0 ? a + t0 * d : a, t1 < 1.0 ? a + t1 * d : b, left, line, enough);
}

bool Sight2D::hide_behind_wide_edge(const Bearing& from, const Bearing& to, const EdgeLine& line, std::uint32_t owner) {
  bool nearest = false;
  for_each_run(from, to, [&](int q, double begin, double end) {
    nearest = buffer_.insert(q, begin, end, line.low(q), owner) || nearest;
  });
  return nearest;
}

}  // namespace gridcull
