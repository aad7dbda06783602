// The region: over a piece of the buffer the nearest edge is the line w = a + b s, w = 1 / X (grid/slope_edge.h), and
// the reach is the circle w = sqrt(1 + s^2) / reach. They cross where (a + b s)^2 reach^2 = 1 + s^2, at most twice;
// between those slopes the outline is the edge, straight, or the circle, drawn as chords. Pictures only: nothing
// rests on its roundings.
#include "gridcull/grid/silhouette_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

namespace gridcull {
namespace {

using Key = std::tuple<int, std::int32_t, std::int32_t, std::int32_t>;

/// Of slope between corners of the circle: 2 degrees at most.
constexpr double arc_step = 0.035;

/// The outline as it grows, counter-clockwise. Corners that repeat are left out.
class Outline {
 public:
  Outline(const Vec2& eye, double reach) : eye_(eye), reach_(reach) {}

  void add_piece(int quadrant, double from, double to, const SlopeLine& line) {
    std::array<double, 4> cuts{from, from, from, to};
    crossings(line, cuts[1], cuts[2]);
    for (std::size_t i = 1; i < 3; ++i) cuts[i] = std::clamp(cuts[i], from, to);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i < 3; ++i) {
      if (cuts[i] < cuts[i + 1]) add_run(quadrant, cuts[i], cuts[i + 1], line);
    }
  }
  std::vector<Vec2> take() { return std::move(points_); }

 private:
  /// Leaves the slopes as they are where the line does not meet the circle.
  void crossings(const SlopeLine& line, double& first, double& second) const {
    const double r2 = reach_ * reach_;
    const double p = line.b * line.b * r2 - 1.0, q = line.a * line.b * r2, r = line.a * line.a * r2 - 1.0;
    const double square = q * q - p * r;
    if (!(square > 0.0) || p == 0.0) return;
    first = (-q - std::sqrt(square)) / p;
    second = (-q + std::sqrt(square)) / p;
  }
  double circle(double s) const { return std::sqrt(1.0 + s * s) / reach_; }
  void add_run(int quadrant, double from, double to, const SlopeLine& line) {
    const double middle = 0.5 * (from + to);
    if (line.at(middle) > circle(middle)) {
      add(quadrant, from, line.at(from));
      add(quadrant, to, line.at(to));
      return;
    }
    const int steps = static_cast<int>(std::ceil((to - from) / arc_step));
    for (int i = 0; i <= steps; ++i) {
      const double s = from + (to - from) * i / steps;
      add(quadrant, s, circle(s));
    }
  }
  void add(int quadrant, double s, double w) {
    const Vec2 there = std::isfinite(w) ? Vec2(1.0, s) / w : Vec2(0.0);
    const Vec2 point = eye_ + turned((4 - quadrant) & 3, there);
    if (points_.empty() || point != points_.back()) points_.push_back(point);
  }

  Vec2 eye_;
  double reach_;
  std::vector<Vec2> points_;
};

}  // namespace

void draw_nodes(const LooseIndex& index, const WalkedNodes& nodes, DrawSink& sink) {
  const auto draw = [&](CellLayer layer, const LooseIndex::NodeId& id) {
    const double side = index.side(id.level);
    const bool solid = index.dimension() == 3;
    const Vec3 low = index.corner() + side * Vec3(id.x, id.y, id.z);
    sink.cells(layer, low, low + Vec3(side, side, solid ? side : 0.0));
  };
  std::set<Key> parents;
  for (const auto* list : {&nodes.opened, &nodes.hidden}) {
    for (const LooseIndex::NodeId& id : *list) parents.insert({id.level + 1, id.x >> 1, id.y >> 1, id.z >> 1});
  }
  for (const LooseIndex::NodeId& id : nodes.opened) {
    if (index.node(id).first != none || !parents.contains({id.level, id.x, id.y, id.z})) draw(CellLayer::visited, id);
  }
  for (const LooseIndex::NodeId& id : nodes.hidden) draw(CellLayer::hidden, id);
  for (const Box2D& box : nodes.opened_rows) sink.cells(CellLayer::visited, Vec3(box.low, 0.0), Vec3(box.high, 0.0));
  for (const Box2D& box : nodes.hidden_rows) sink.cells(CellLayer::hidden, Vec3(box.low, 0.0), Vec3(box.high, 0.0));
}

std::vector<Vec2> seen_region(const SlopeBuffer& buffer, const Vec2& eye, double reach) {
  Outline outline(eye, reach);
  for (int quadrant = 0; quadrant < 4; ++quadrant) {
    const auto& pieces = buffer.pieces(quadrant);
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      outline.add_piece(quadrant, pieces[i].from, pieces[i + 1].from, pieces[i].line);
    }
  }
  return outline.take();
}

}  // namespace gridcull
