#include "gridcull/service/build_facts.h"

#include <chrono>
#include <ctime>
#include <fstream>

#include <gridcull_build_facts.h>  // made in every build

namespace gridcull {

BuildFacts build_facts() { return {GRIDCULL_COMMIT, GRIDCULL_COMPILER, GRIDCULL_FLAGS}; }

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string date_text() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &parts);
  return text;
}

}  // namespace gridcull
