// One fuzzer: GRIDCULL_FUZZ names its target.
#include <cstddef>
#include <cstdint>

#include "fuzz_targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gridcull::fuzz::GRIDCULL_FUZZ({reinterpret_cast<const char*>(data), size});
  return 0;
}
