// Every conservative method against the exact 2D reference on small random worlds; see property_test.h for the
// environment variables that choose number and seeds.
#include <doctest/doctest.h>

#include "property_test.h"

TEST_CASE("2D: no conservative method misses anybody in random worlds") {
  gridcull::test::run_campaign({2, 2000, 1, 0.12});
}
