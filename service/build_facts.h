// What this program was built from and with: stands at the head of measured figures.
#pragma once

#include <string>

namespace gridcull {

struct BuildFacts {
  std::string commit;    ///< abbreviated, with "-dirty" where files differ from it; "unknown" outside git
  std::string compiler;  ///< "GNU 12.2.0"
  std::string flags;
};
BuildFacts build_facts();

/// Model name of the first processor; "unknown" where /proc does not say.
std::string processor_name();

/// Today as "2026-11-22", UTC.
std::string date_text();

}  // namespace gridcull
