// The speed-accuracy frontier, and what is advised by it.
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/service/advice.h"

using namespace gridcull;

namespace {

using Settings = std::vector<SpeedAccuracy>;

std::vector<std::size_t> frontier_of(const Settings& settings) {
  std::vector<std::size_t> places;
  const auto standings = find_frontier(settings);
  for (std::size_t i = 0; i < standings.size(); ++i) {
    CHECK(!(standings[i].on_frontier && standings[i].beaten_by));
    if (standings[i].on_frontier) places.push_back(i);
  }
  return places;
}

using Places = std::vector<std::size_t>;

}  // namespace

TEST_CASE("frontier: none, one, and one that cannot be used") {
  CHECK(frontier_of({}).empty());
  CHECK_FALSE(pick({}).has_value());
  const Settings one{{3.0, 7.0}};
  CHECK(frontier_of(one) == Places{0});
  const auto picks = pick(one);
  REQUIRE(picks);
  CHECK((picks->fastest == 0 && picks->tightest == 0 && picks->standard == 0));
  const Settings missed{{1.0, 1.0, false}, {2.0, 5.0}};
  CHECK(frontier_of(missed) == Places{1});
  CHECK_FALSE(find_frontier(missed)[0].beaten_by.has_value());
  CHECK_FALSE(find_frontier(missed)[1].beaten_by.has_value());
  CHECK_FALSE(pick(Settings{{1.0, 1.0, false}}).has_value());
}

TEST_CASE("frontier: what is slower and looser is beaten, by the tightest on the frontier that beats it") {
  //                      0            1            2           3             4
  const Settings settings{{1.0, 30.0}, {2.0, 20.0}, {4.0, 10.0}, {4.5, 25.0}, {9.0, 10.0}};
  CHECK(frontier_of(settings) == Places{0, 1, 2});
  const auto standings = find_frontier(settings);
  CHECK(standings[3].beaten_by == 2u);
  CHECK(standings[4].beaten_by == 2u);  // as tight, and slower
  const auto picks = pick(settings);
  REQUIRE(picks);
  CHECK(picks->fastest == 0);
  CHECK(picks->tightest == 2);
  CHECK(picks->standard == 2);
}

TEST_CASE("frontier: ties stay, and the first of them is advised") {
  const Settings same{{2.0, 10.0}, {2.0, 10.0}, {1.98, 10.0}};
  CHECK(frontier_of(same) == Places{0, 1, 2});
  const auto picks = pick(same);
  REQUIRE(picks);
  CHECK((picks->fastest == 0 && picks->tightest == 0 && picks->standard == 0));
}

TEST_CASE("frontier: what is a hair faster only is noise") {
  const Settings settings{{1.00, 30.0}, {1.03, 20.0}, {1.2, 19.9}};
  CHECK(frontier_of(settings) == Places{1, 2});
  CHECK(find_frontier(settings)[0].beaten_by == 1u);
  // Each a hair slower than the one before: beaten by a neighbour that is itself beaten.
  const Settings chain{{1.00, 30.0}, {1.04, 20.0}, {1.08, 10.0}};
  CHECK(frontier_of(chain) == Places{2});
  CHECK(find_frontier(chain)[0].beaten_by == 1u);
  CHECK(find_frontier(chain)[1].beaten_by == 2u);
}

TEST_CASE("by default the fastest that is hardly looser than the tightest") {
  const Settings settings{{1.0, 150.0}, {2.0, 110.0}, {3.0, 104.0}, {9.0, 100.0}};
  const auto picks = pick(settings);
  REQUIRE(picks);
  CHECK(picks->fastest == 0);
  CHECK(picks->tightest == 3);
  CHECK(picks->standard == 1);
  const Settings blind{{2.0, 0.0}, {1.0, 0.0}};  // nobody sees anything
  CHECK(pick(blind)->standard == 1);
}
