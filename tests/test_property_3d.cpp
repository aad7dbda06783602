// Every conservative method against rays in 3D on small random worlds; see property_test.h for the environment
// variables that choose number and seeds.
#include <doctest/doctest.h>

#include "gridcull/core/exact.h"
#include "property_test.h"

TEST_CASE("3D: no conservative method misses anybody in random worlds") {
  const bool reference = gridcull::ExactRays::available();
  if (!reference) MESSAGE("built without Embree: 3D answers are checked against each other only");
  gridcull::test::run_campaign({3, 500, reference ? 64 : 0, 0.05});
}
