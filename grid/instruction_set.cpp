#include "gridcull/grid/instruction_set.h"

#include <cstdlib>
#include <string>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr InstructionSet widest_first[] = {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::scalar};

}  // namespace

const char* name_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx2: return "avx2";
    case InstructionSet::avx512: return "avx512";
    case InstructionSet::scalar: break;
  }
  return "scalar";
}

bool is_supported(InstructionSet set) {
#if defined(__x86_64__)
  // The compiler's test asks the operating system too, whether it keeps the wide registers.
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") != 0;
  if (set == InstructionSet::avx512) {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  }
#endif
  return set == InstructionSet::scalar;
}

InstructionSet choose_instruction_set() {
  const char* const text = std::getenv("GRIDCULL_ISA");
  const std::string asked = text ? text : "";
  for (const InstructionSet set : widest_first) {
    if (asked.empty() ? is_supported(set) : asked == name_of(set)) {
      if (is_supported(set)) return set;
      throw Error(ErrorCode::usage, "GRIDCULL_ISA: this machine lacks \"" + asked + "\"; expected one it has, or none");
    }
  }
  throw Error(ErrorCode::usage, "GRIDCULL_ISA: unknown set \"" + asked + "\"; expected scalar, avx2 or avx512");
}

}  // namespace gridcull
