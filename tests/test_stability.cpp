// The stability suite: its worlds, and that it notices who misses.
#include <set>

#include <doctest/doctest.h>

#include "gridcull/core/exact.h"
#include "gridcull/core/view_volume.h"
#include "gridcull/service/bench_contender.h"
#include "gridcull/service/stability_report.h"
#include "gridcull/service/stability_run.h"

using namespace gridcull;

namespace {

const Limit& limit_named(const std::string& name) {
  for (const Limit& limit : stability_limits()) {
    if (limit.name == name) return limit;
  }
  FAIL("no limit " << name);
  return stability_limits()[0];
}

StabilityResult run(const char* method, const Limit& limit) {
  const std::vector<StabilityResult> results = run_stability({&find_method(method)}, 2, {1, 16}, [] {}, {&limit, 1});
  REQUIRE(results.size() == 1);
  REQUIRE(results[0].rows.size() == 1);
  REQUIRE(results[0].rows[0].results.size() == limit.values.size());
  return results[0];
}

}  // namespace

TEST_CASE("every limit makes a world that can be played, in 2D and 3D, at every value") {
  std::set<std::string> names;
  for (const Limit& limit : stability_limits()) {
    CAPTURE(limit.name);
    CHECK(names.insert(limit.name).second);
    CHECK(limit.values.size() > 2);
    for (const double value : limit.values) {
      CAPTURE(value);
      for (const int dimension : {2, 3}) {
        const LimitWorld world = limit.make(value, dimension);
        CHECK(world.dimension == dimension);
        CHECK(world.frames.size() > 1);
        CHECK(world.cell > 0.0);
        CHECK_FALSE(world.bounds.empty());
        for (std::size_t i = 0; i < world.objects.size(); ++i) {
          CHECK(world.objects[i].id == i);
          CHECK_NOTHROW(validate(world.objects[i].shape));
        }
        for (std::size_t f = 0; f < world.frames.size(); ++f) {
          if (f > 0) CHECK(world.frames[f].time > world.frames[f - 1].time);
          for (const View& view : world.frames[f].views) CHECK_NOTHROW(ViewVolume(view, dimension));
        }
      }
    }
  }
}

TEST_CASE("who misses is told of, who does not is not") {
  const Limit& gap = limit_named("gap between occluders");
  std::uint64_t misses = 0;
  const StabilityResult rays = run("pairwise-rays", gap), frustum = run("frustum", gap);
  for (const LimitResult& r : rays.rows[0].results) misses += r.misses;
  CHECK(misses > 0);
  for (const LimitResult& r : frustum.rows[0].results) {
    CHECK(r.misses == 0);
    CHECK(r.queries == 12);
    CHECK(r.over_estimation() > 1.0);
  }
  // A closed gap shows less than an open one.
  CHECK(frustum.rows[0].results.back().exact < frustum.rows[0].results.front().exact);
  CHECK(stability_table(frustum).find("| gap between occluders | 2 to 0 metres | none |") != std::string::npos);
  CHECK(stability_table(rays).find(" of ") != std::string::npos);
}

TEST_CASE("flicker: an exact method changes as often as the truth, the view volume alone never does here") {
  Limit flicker = limit_named("flicker");
  flicker.values = {1.0, 0.1};
  const StabilityResult exact = run("silhouette", flicker), frustum = run("frustum", flicker);
  for (const LimitResult& r : exact.rows[0].results) CHECK(r.changes == doctest::Approx(r.exact_changes));
  CHECK(exact.rows[0].results[0].changes > exact.rows[0].results[1].changes);
  for (const LimitResult& r : frustum.rows[0].results) CHECK(r.changes == 0.0);
  const std::string csv = stability_csv(std::vector<StabilityResult>{exact});
  CHECK(csv.find("silhouette,2,flicker,metres a frame,0.1,30,") != std::string::npos);
}

TEST_CASE("two limits at once, in 2D: no conservative method misses anybody, and each world has something to be seen") {
  std::size_t pairs = 0;
  for (const Limit& limit : stability_limits()) {
    if (limit.name.find(" x ") == std::string::npos) continue;
    CAPTURE(limit.name);
    ++pairs;
    for (const MethodEntry& method : method_catalog()) {
      if (!method.info.takes_2d || method.info.guarantee != Guarantee::conservative) continue;
      CAPTURE(method.info.name);
      const StabilityResult result = run(std::string(method.info.name).c_str(), limit);
      for (const LimitResult& r : result.rows[0].results) {
        CAPTURE(r.value);
        CHECK(r.refused.empty());
        CHECK(r.misses == 0);
        CHECK(r.exact > 0);
      }
    }
  }
  CHECK(pairs == 9);
}
