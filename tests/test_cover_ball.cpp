// Balls: the two bodies of the comparison kernel, and balls of many bricks.
#include <limits>

#include "cover_check.h"
#include "gridcull/grid/double_pair.h"

using namespace gridcull;
using cover_check::compare;
using cover_check::Findings;
using cover_check::Random;

namespace {

template <class Pair, int edge, bool strict>
std::uint32_t compared(const std::vector<double>& x, const std::vector<double>& limit) {
  std::vector<Pair> xs, limits;
  for (std::size_t i = 0; i < x.size(); i += 2) xs.push_back(Pair::of(x[i], x[i + 1]));
  for (std::size_t i = 0; i < limit.size(); i += 2) limits.push_back(Pair::of(limit[i], limit[i + 1]));
  return compare_rows<edge, strict>(xs.data(), limits.data());
}

template <int edge>
void check_rows(Random& random) {
  const double infinite = std::numeric_limits<double>::infinity();
  const double values[] = {0.0, -0.0, 1.0, 2.0, infinite, -infinite, 1e-310};
  const auto fill = [&](std::size_t n) {
    std::vector<double> v(n);
    for (double& d : v) d = random.one_in(2) ? values[random.below(7)] : random.in(-1, 3);
    return v;
  };
  const std::vector<double> x = fill(edge), limit = fill(16 / edge);
  std::uint32_t at_most = 0, below = 0;
  for (std::size_t bit = 0; bit < 16; ++bit) {
    at_most |= static_cast<std::uint32_t>(x[bit % edge] <= limit[bit / edge]) << bit;
    below |= static_cast<std::uint32_t>(x[bit % edge] < limit[bit / edge]) << bit;
  }
  CHECK(compared<PortablePair, edge, false>(x, limit) == at_most);
  CHECK(compared<DoublePair, edge, false>(x, limit) == at_most);
  CHECK(compared<PortablePair, edge, true>(x, limit) == below);
  CHECK(compared<DoublePair, edge, true>(x, limit) == below);
}

template <class Pair>
std::vector<double> arithmetic(double a, double b, double c, double d) {
  const Pair p = Pair::of(a, b), q = Pair::of(c, d), one = Pair::both(1.0);
  std::vector<double> out;
  for (const Pair& r : {p + q, p - q, p * q, least(p, q), greatest(p, q), absolute(p), where_less(p, q, one, q)}) {
    out.push_back(r.first());
    out.push_back(r.second());
  }
  return out;
}

}  // namespace

TEST_CASE("the portable and the SSE2 body of the ball kernel give the same bits") {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    Random random(seed);
    INFO("seed ", seed);
    check_rows<4>(random);
    check_rows<8>(random);
    const double a = random.in(-2, 2), b = random.in(-2, 2), c = random.in(-2, 2), d = random.in(-2, 2);
    CHECK(arithmetic<PortablePair>(a, b, c, d) == arithmetic<DoublePair>(a, b, c, d));
  }
}

TEST_CASE("balls of many bricks are covered exactly") {
  CoverScratch scratch;
  Cover cover;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Random random(seed);
    const bool flat = seed % 2 == 1;
    const Lattice lattice(flat ? 2 : 3, {{-3, 2, 1}, flat ? Vec3(250, 180, 1) : Vec3(45, 41, 39)}, 1.0, 1u << 30);
    const Bounds box = lattice.box();
    const double radius = flat ? random.coordinate(60, 200) : random.coordinate(10, 40);
    Pose pose;
    for (int k = 0; k < (flat ? 2 : 3); ++k) pose.position[k] = random.coordinate(box.min[k], box.max[k]);
    const Shape shape = flat ? Shape(Disc{radius}) : Shape(Sphere{radius});
    PreparedShape(shape).cover(lattice, pose, scratch, cover);
    const Findings f = compare(lattice, shape, pose, cover, 1e-9);
    INFO("seed ", seed, ": ", f.text());
    CHECK(f.safe());
    CHECK(f.tight());
    CHECK(f.opaque > 1000);
    Cover plain;
    cover_ball(lattice, pose.position, radius, plain);
    REQUIRE(plain.bricks.size() == cover.bricks.size());
    CHECK(plain.outside == cover.outside);
    bool same = true;
    for (std::size_t i = 0; i < plain.bricks.size(); ++i) {
      same = same && plain.bricks[i].brick == cover.bricks[i].brick && plain.bricks[i].opaque == 0 &&
             plain.bricks[i].touched == cover.bricks[i].touched;
    }
    CHECK(same);
  }
}
