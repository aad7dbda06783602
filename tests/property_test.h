// What the 2D and 3D property tests share.
//
// GRIDCULL_PROPERTY_SCENES multiplies the number of worlds (default 1), GRIDCULL_PROPERTY_SEED is the first seed;
// seeds are consecutive from there. A failure prints its seed and a shrunk script to be kept in kept_misses.cpp;
// GRIDCULL_PROPERTY_SHRINK=0: the seed only.
#pragma once

#include "property_run.h"

namespace gridcull::test {

struct Campaign {
  int dimension = 2;
  std::uint64_t worlds = 1000;
  int rays = 64;              ///< 3D reference: rays along a frustum's height; 0: no reference
  double least_hidden = 0.1;  ///< share of the objects in view that the best method must hide over all worlds
};

/// Runs all worlds against every conservative method of the catalog and reports through doctest.
void run_campaign(const Campaign& campaign);

/// A faulty script made small, and the fault it shows.
std::string shrunk_report(const WorldScript& script, const MethodEntry& method, int rays, const Fault& fault);

}  // namespace gridcull::test
