// The speed-accuracy frontier, and what is advised by it.
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/service/advice.h"
#include "gridcull/service/advice_run.h"

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

namespace {

BenchRow row_of(const std::string& setting, double microseconds, std::vector<double> reported) {
  BenchRow row;
  row.contender.setting_name = "resolution";
  row.contender.setting = setting;
  row.frames = reported.size();
  row.reported = std::move(reported);
  row.hash = 1;
  row.total.add(0, 1e6);  // everything is built
  row.total.add(1, microseconds);
  return row;
}

}  // namespace

TEST_CASE("rows are compared by the frames that they ran, and who misses or did not run is not") {
  std::vector<BenchRow> rows{row_of("64", 10.0, {5.0, 5.0, 90.0}), row_of("128", 30.0, {4.0, 6.0}),
                             row_of("256", 20.0, {1.0, 1.0, 1.0}), row_of("512", 5.0, {})};
  rows[1].hash = 2;
  rows[2].hash = 3;
  rows[2].verdict.misses = 1;
  rows[3].refused = "too large";
  const auto settings = compare_rows(rows);
  REQUIRE(settings.size() == 4);
  CHECK(settings[0].time == 10.0);
  CHECK(settings[0].reported == 1.0);
  CHECK(settings[1].reported == 1.0);
  CHECK(settings[2].reported == 0.03);
  CHECK(settings[0].usable);
  CHECK(settings[1].usable);
  CHECK_FALSE(settings[2].usable);
  CHECK_FALSE(settings[3].usable);
}

TEST_CASE("where nobody sees anything all are as tight") {
  std::vector<BenchRow> rows{row_of("64", 10.0, {0.0, 0.0}), row_of("128", 30.0, {0.0}), row_of("256", 9.0, {1.0})};
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].hash = i;
  const auto settings = compare_rows(rows);
  CHECK(settings[0].reported == settings[1].reported);
  CHECK(settings[2].reported > settings[0].reported);
}

TEST_CASE("one setting under two names stands once") {
  std::vector<BenchRow> rows{row_of("auto", 12.0, {5.0}), row_of("128", 10.0, {5.0}), row_of("256", 14.0, {5.0})};
  rows[2].held_bytes = 100;  // the same answers out of a larger mask
  CHECK(twin_of(rows, 1) == 0u);
  CHECK_FALSE(twin_of(rows, 0).has_value());
  CHECK_FALSE(twin_of(rows, 2).has_value());
  const auto settings = compare_rows(rows);
  CHECK(settings[0].time == 10.0);
  CHECK(settings[0].usable);
  CHECK_FALSE(settings[1].usable);
  CHECK(find_frontier(settings)[2].beaten_by == 0u);
}

TEST_CASE("cells about the derived one, and the one in use") {
  CHECK(cells_about(2.0, 2.0) == std::vector<double>{8.0, 4.0, 2.0, 1.4, 1.0});
  CHECK(cells_about(0.3, 2.5) == std::vector<double>{2.5, 1.2, 0.6, 0.3, 0.21, 0.15});  // as they are typed
  CHECK(cells_about(1.0, 1.0 / 3.0)[5] == 1.0 / 3.0);
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
