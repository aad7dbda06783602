// Ctrl-C and requests to end: the work in hand is finished, then the command stops and cleans up.
#pragma once

#include <string>

namespace gridcull {

/// Thrown by stop_if_interrupted(); unfinished outputs disappear with their writers.
struct Stopped {
  std::string note = "unfinished outputs were not written";  ///< what became of the work
};

/// From now on SIGINT and SIGTERM set a flag. A second one ends the program at once.
void catch_interrupts();

bool interrupted();

/// 128 + the signal, as shells expect.
int interrupt_status();

/// Throws Stopped when the flag is set.
void stop_if_interrupted();

}  // namespace gridcull
