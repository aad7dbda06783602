// Which vector instructions the kernels use. Every set gives the same bits: a choice changes speed alone.
#pragma once

namespace gridcull {

enum class InstructionSet {
  scalar,  ///< plain C++, any machine
  avx2,
  avx512  ///< F, DQ, BW and VL
};

/// "scalar", "avx2" or "avx512".
const char* name_of(InstructionSet set);

/// Whether this build holds kernels for the set and this machine runs them.
bool is_supported(InstructionSet set);

/// What the environment variable GRIDCULL_ISA asks for ("scalar", "avx2", "avx512"); the widest supported set
/// when it is unset or empty. Whoever makes an engine calls it once.
/// Throws Error(usage) for another word and for a set that this machine lacks.
InstructionSet choose_instruction_set();

}  // namespace gridcull
