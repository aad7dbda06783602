// The program `gridcull`: reads the command line, runs the command, turns every refusal into one line.
#pragma once

namespace gridcull {

/// Exit status: 0; 1 when a check failed; 2 for bad input or usage, with one line on standard error;
/// 128 + signal when stopped by Ctrl-C or a request to end.
int run_program(int argc, const char* const* argv);

}  // namespace gridcull
