// The depth buffer over slopes: its claim (slope_buffer.h) against a list of all edges, and the margins of
// slope_edge.h against points computed without rounding.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/grid/slope_buffer.h"
#include "gridcull/sim/random.h"

using namespace gridcull;

namespace {

struct Edge {
  double from, to;
  SlopeLine line;
};

/// The nearest edge at a slope, 0 where there is none.
double nearest(const std::vector<Edge>& edges, double s) {
  double w = 0.0;
  for (const Edge& e : edges) {
    if (e.from <= s && s <= e.to) w = std::max(w, e.line.at(s));
  }
  return w;
}

double value(const SlopeBuffer& buffer, int quadrant, double s) {
  const auto& list = buffer.pieces(quadrant);
  for (std::size_t i = 0; i + 1 < list.size(); ++i) {
    if (list[i].from <= s && s < list[i + 1].from) return list[i].line.at(s);
  }
  return 0.0;
}

Edge random_edge(Random& random) {
  double from = random.uniform(-1, 1), to = random.uniform(-1, 1);
  if (random.below(3) == 0) from = std::round(from * 4) / 4, to = std::round(to * 4) / 4;
  if (from > to) std::swap(from, to);
  const double w0 = random.uniform(0.01, 1), w1 = random.below(3) == 0 ? w0 : random.uniform(0.01, 1);
  const double b = to > from ? (w1 - w0) / (to - from) : 0.0;
  return {from, to, {w0 - b * from, b}};
}

void check_order(const SlopeBuffer& buffer) {
  for (int q = 0; q < 4; ++q) {
    const auto& list = buffer.pieces(q);
    REQUIRE(list.size() >= 2);
    CHECK(list.front().from == -1.0);
    CHECK(list.back().from == 1.0);
    for (std::size_t i = 1; i < list.size(); ++i) REQUIRE(list[i - 1].from < list[i].from);
  }
}

}  // namespace

TEST_CASE("the buffer holds the nearest of all edges, in any order") {
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    std::vector<Edge> edges;
    for (std::uint32_t i = 0, n = 1 + random.below(30); i < n; ++i) edges.push_back(random_edge(random));
    SlopeBuffer buffer;
    buffer.reset();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const bool above = buffer.insert(2, edges[i].from, edges[i].to, edges[i].line, static_cast<std::uint32_t>(i));
      if (i == 0) CHECK(above == (edges[0].from < edges[0].to));
    }
    check_order(buffer);
    // Every piece is a line of its owner, within the owner's slopes.
    const auto& list = buffer.pieces(2);
    for (std::size_t i = 0; i + 1 < list.size(); ++i) {
      if (list[i].owner == SlopeBuffer::nobody) continue;
      const Edge& e = edges[list[i].owner];
      CHECK(list[i].from >= e.from);
      CHECK(list[i + 1].from <= e.to);
      CHECK(list[i].line.a == e.line.a);
      CHECK(list[i].line.b == e.line.b);
    }
    for (int k = 0; k < 200; ++k) {
      const double s = random.uniform(-1, 1), w = nearest(edges, s);
      CHECK(value(buffer, 2, s) == doctest::Approx(w).epsilon(1e-9));
      CHECK(value(buffer, 2, s) <= w * (1 + 1e-12));
    }
    CHECK(buffer.pieces(0).size() == 2);
  }
}

TEST_CASE("what is tested is open exactly where it is not behind the buffer") {
  Random random(12);
  for (int round = 0; round < 300; ++round) {
    std::vector<Edge> edges;
    SlopeBuffer buffer;
    buffer.reset();
    for (std::uint32_t i = 0, n = random.below(12); i < n; ++i) {
      edges.push_back(random_edge(random));
      (void)buffer.insert(1, edges[i].from, edges[i].to, edges[i].line, i);
    }
    const Edge test = random_edge(random);
    double open = 0.0;
    constexpr int steps = 4000;
    for (int k = 0; k < steps; ++k) {
      const double s = test.from + (test.to - test.from) * (k + 0.5) / steps;
      if (test.line.at(s) > nearest(edges, s)) open += (test.to - test.from) / steps;
    }
    CHECK(buffer.open_width(1, test.from, test.to, test.line, 9.0) == doctest::Approx(open).epsilon(0.02));
  }
}

TEST_CASE("closed slopes hide everything, an edge at the same place is open") {
  SlopeBuffer buffer;
  buffer.reset();
  buffer.close(0, -0.5, 0.25);
  CHECK(buffer.open_width(0, -0.5, 0.25, {1e9, 0.0}, 9.0) == 0.0);
  CHECK(buffer.open_width(0, -1.0, 1.0, {1e-9, 0.0}, 9.0) == doctest::Approx(1.25));
  const DiscSight disc{{2.0, 0.0}, 1.0, 3.0};
  CHECK(buffer.open_width(0, -0.5, 0.25, disc, 9.0) == 0.0);
  CHECK(buffer.open_width(0, -0.5, 0.5, disc, 9.0) == 0.25);
  const SlopeLine wall{0.1, 0.02};
  CHECK(buffer.insert(0, 0.25, 1.0, wall, 7));
  CHECK_FALSE(buffer.insert(0, 0.25, 1.0, wall, 8));
  CHECK(buffer.open_width(0, 0.25, 1.0, wall, 9.0) == doctest::Approx(0.75));
}

TEST_CASE("directions: every quadrant, diagonals at its ends") {
  for (int q = 0; q < 4; ++q) {
    for (const double s : {-1.0, -0.75, 0.0, 0.5}) {
      // The direction (1, s) of the quadrant, turned back.
      const Vec2 p = turned((4 - q) & 3, {8.0, 8.0 * s});
      const Bearing d = bearing_of(p);
      CHECK(d.quadrant == q);
      CHECK(d.slope == s);
    }
  }
  int runs = 0;
  double width = 0.0;
  for_each_run(bearing_of({1, -1}), bearing_of({1, 1}), [&](int q, double from, double to) {
    CHECK(q == 0);
    ++runs;
    width += to - from;
  });
  CHECK(runs == 1);
  CHECK(width == 2.0);
}

TEST_CASE("a disc is hidden by a line exactly when no part of it is in front, in random places") {
  Random random(13);
  int hidden = 0, seen = 0;
  for (int round = 0; round < 3000; ++round) {
    const Vec2 centre(random.uniform(2, 10), random.uniform(-8, 8));
    const double distance = glm::length(centre), radius = random.uniform(0.01, 0.95) * distance;
    const DiscSight disc{centre, radius, (distance - radius) * (distance + radius)};
    const Edge e = random_edge(random);
    SlopeBuffer buffer;
    buffer.reset();
    (void)buffer.insert(0, -1.0, 1.0, e.line, 0);
    // Points of the disc in the quadrant, in polar coordinates about its centre.
    bool front = false;
    for (int k = 0; k < 720; ++k) {
      const double angle = 3.14159265358979 * k / 360;
      for (const double part : {1.0, 0.7, 0.3}) {
        const Vec2 p = centre + part * radius * Vec2(std::cos(angle), std::sin(angle));
        if (p.x <= 0.0 || std::fabs(p.y) > p.x) continue;
        front = front || 1.0 / p.x > e.line.at(p.y / p.x) * (1.0 + 1e-9);
      }
    }
    // Slopes between the tangents, as far as they are in the quadrant.
    const double t = std::sqrt(disc.power);
    const Vec2 left(-centre.y, centre.x);
    const Vec2 a = t * centre - radius * left, b = t * centre + radius * left;
    const double from = a.x > 0.0 ? std::max(-1.0, a.y / a.x) : -1.0, to = b.x > 0.0 ? std::min(1.0, b.y / b.x) : 1.0;
    if (!(from < to)) continue;
    const bool hides = buffer.open_width(0, from, to, disc, 0.0) == 0.0;
    if (front) CHECK_FALSE(hides);
    (hides ? hidden : seen) += 1;
  }
  CHECK(hidden > 300);
  CHECK(seen > 300);
}

// Tries to break the margins: the same wall cut at random, seen from random places, in coordinates up to 1e9. Cuts move
// the world's points by roundings only, so the wall must stay open to itself, and what stands a little more than
// a tie before it must not be hidden either.
TEST_CASE("no rounding makes a wall hide its own pieces or what touches it in front") {
  Random random(14);
  for (int round = 0; round < 4000; ++round) {
    const double magnitude = std::pow(10.0, random.uniform(0, 9));
    const Vec2 eye(random.uniform(-1, 1) * magnitude, random.uniform(-1, 1) * magnitude);
    const double size = std::pow(10.0, random.uniform(-1, 3));
    const Vec2 a = eye + size * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    const Vec2 b = eye + size * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    const double blur = tie * std::max(std::fabs(eye.x), std::fabs(eye.y));
    const EdgeTurn whole = turn_of_edge(a - eye, b - eye, blur);
    if (whole.facing > Facing::right) continue;
    SlopeBuffer buffer;
    buffer.reset();
    const bool left = whole.facing == Facing::left;
    for_each_run(bearing_of(left ? a - eye : b - eye), bearing_of(left ? b - eye : a - eye),
                 [&](int q, double from, double to) { (void)buffer.insert(q, from, to, whole.line().low(q), 0); });
    // A piece of the wall, its ends rounded to doubles of the world.
    double t0 = random.uniform(0, 1), t1 = random.uniform(0, 1);
    if (t0 > t1) std::swap(t0, t1);
    const Vec2 p = a + t0 * (b - a) - eye, q = a + t1 * (b - a) - eye;
    const EdgeTurn piece = turn_of_edge(p, q, blur);
    if (piece.facing > Facing::right || piece.facing != whole.facing) continue;
    double open = 0.0, all = 0.0;
    for_each_run(bearing_of(left ? p : q), bearing_of(left ? q : p), [&](int k, double from, double to) {
      open += buffer.open_width(k, from, to, piece.line().high(k), 9.0);
      all += std::max(0.0, to - from);
    });
    CHECK(open >= all * (1 - 1e-9));
  }
}
