// Ctrl-C and requests to end: the work in hand is finished, then the command stops and cleans up.
#pragma once

#include <string>

namespace gridcull {

/// Thrown by stop_if_interrupted(); unfinished outputs disappear with their writers.
struct Stopped {
  std::string note = "unfinished outputs were not written";  ///< what became of the work
};

/// From now on SIGINT, SIGTERM and SIGHUP (the terminal is gone) set a flag. A second one ends the program at once.
/// A pipe that nobody reads any more (SIGPIPE) sets it too: what is written to it fails.
void catch_interrupts();

bool interrupted();

/// Whether it was a pipe that nobody reads any more.
bool broken_pipe();

/// 128 + the signal, as shells expect.
int interrupt_status();

/// Throws Stopped when the flag is set.
void stop_if_interrupted();

}  // namespace gridcull
