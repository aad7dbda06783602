// Worlds that once showed a fault, shrunk, kept as tests.
#pragma once

#include <string>
#include <vector>

#include "random_world.h"

namespace gridcull::test {

struct KeptMiss {
  std::string story;  ///< what was wrong
  WorldScript script;
};

std::vector<KeptMiss> kept_misses();

}  // namespace gridcull::test
