// The sequential probability ratio test of the five-dimensional tree: what its tables say is what the formula says.
#include <cmath>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/core/random.h"
#include "gridcull/methods/sequential_test.h"

namespace gridcull::test {
namespace {

using Verdict = SequentialTest::Verdict;

/// The same ratio without beta functions: the share of [0, s] in the integral of t^h (1-t)^(r-h) is the chance of more
/// than h successes in r + 1 trials.
double ratio_by_sums(double s, unsigned hits, unsigned rays) {
  long double below = 0.0L, term = std::pow(1.0L - s, static_cast<long double>(rays + 1));
  for (unsigned k = 0; k <= rays + 1; ++k) {
    if (k > hits) below += term;
    term *= static_cast<long double>(rays + 1 - k) / (k + 1) * s / (1.0L - s);
  }
  return static_cast<double>((1.0L - below) / below);
}

}  // namespace

TEST_CASE("the likelihood ratio is a ratio of binomial tails") {
  for (const double s : {0.003, 0.01, 0.2}) {
    for (unsigned rays = 0; rays <= 120; rays += 7) {
      for (unsigned hits = 0; hits <= rays && hits < 6; ++hits) {
        CAPTURE(s);
        CAPTURE(rays);
        CAPTURE(hits);
        CHECK(likelihood_ratio(s, hits, rays) == doctest::Approx(ratio_by_sums(s, hits, rays)).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("the tables judge as the ratio does") {
  constexpr double s = 0.02, a = 50.0, b = 0.2;
  const SequentialTest test(s, a, b);
  for (unsigned rays = 0; rays <= 400; ++rays) {
    for (unsigned hits = 0; hits <= rays && hits <= 12; ++hits) {
      CAPTURE(rays);
      CAPTURE(hits);
      const double ratio = likelihood_ratio(s, hits, rays);
      const Verdict verdict = test.judge(hits, rays);
      if (ratio < b) CHECK(verdict == Verdict::invisible);
      if (ratio >= b && (ratio <= a || hits == 0)) CHECK(verdict == Verdict::open);
      if (ratio > a && hits > 0) CHECK(verdict == Verdict::visible);
    }
  }
}

TEST_CASE("what no ray hits takes as many rays as 0.99^(r + 1) < 1/6 asks for") {
  const SequentialTest test(0.01, 50.0, 0.2);
  CHECK(test.rays_without_hit() == 178);
  CHECK(test.judge(0, 177) == Verdict::open);
  CHECK(test.judge(0, 178) == Verdict::invisible);
}

TEST_CASE("what is seen well is found, what is hidden is not, and both end") {
  const SequentialTest test(0.01, 50.0, 0.2);
  Random random(7);
  for (const double share : {0.0, 0.001, 0.1, 0.6}) {
    int visible = 0;
    for (int round = 0; round < 400; ++round) {
      unsigned hits = 0, rays = 0;
      while (test.judge(hits, rays) == Verdict::open) {
        ++rays;
        if (random.unit() < share) ++hits;
        REQUIRE(rays < 20000);
      }
      visible += test.judge(hits, rays) == Verdict::visible ? 1 : 0;
    }
    CAPTURE(share);
    if (share == 0.0) CHECK(visible == 0);
    if (share == 0.001) CHECK(visible < 40);
    if (share >= 0.1) CHECK(visible == 400);
  }
}

TEST_CASE("parameters that make no test are refused") {
  CHECK_THROWS_AS(SequentialTest(0.0, 50.0, 0.2), Error);
  CHECK_THROWS_AS(SequentialTest(1.0, 50.0, 0.2), Error);
  CHECK_THROWS_AS(SequentialTest(0.1, 0.5, 0.2), Error);
  CHECK_THROWS_AS(SequentialTest(0.1, 50.0, 0.0), Error);
}

}  // namespace gridcull::test
