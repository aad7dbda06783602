#include "gridcull/service/interrupt.h"

#include <csignal>
#include <initializer_list>

namespace gridcull {
namespace {

// A signal handler can reach nothing else: the one global of the program.
volatile std::sig_atomic_t received = 0;

extern "C" void remember_signal(int signal) { received = signal; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // no SA_RESTART: a blocked read comes back
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // What was started with the signal ignored (nohup, a background job) goes on ignoring it.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

bool interrupted() { return received != 0; }

int interrupt_status() { return 128 + static_cast<int>(received); }

void stop_if_interrupted() {
  if (interrupted()) throw Stopped{};
}

}  // namespace gridcull
