#include "gridcull/service/interrupt.h"

#include <csignal>
#include <ctime>
#include <initializer_list>

namespace gridcull {
namespace {

// A signal handler can reach nothing else: the program's only globals.
volatile std::sig_atomic_t received = 0;
timer_t nudges;

// A signal that comes between a look at the flag and a blocking read would leave the program in that read. So it is
// nudged out of it, again and again, until it has stopped.
extern "C" void remember_signal(int signal) {
  received = signal;
  constexpr itimerspec often{{0, 20'000'000}, {0, 20'000'000}};
  timer_settime(nudges, 0, &often, nullptr);
}

// The write that failed comes back by itself; further ones may come before the program has cleaned up.
extern "C" void remember_pipe(int signal) {
  if (received == 0) received = signal;
}

extern "C" void nudge(int) {}

void prepare_nudges() {
  struct sigaction action {};
  action.sa_handler = nudge;  // no SA_RESTART
  sigemptyset(&action.sa_mask);
  sigaction(SIGALRM, &action, nullptr);
  timer_create(CLOCK_MONOTONIC, nullptr, &nudges);  // sends SIGALRM
}

}  // namespace

void catch_interrupts() {
  prepare_nudges();
  struct sigaction action {};
  action.sa_handler = remember_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // no SA_RESTART: a blocked read comes back
  sigemptyset(&action.sa_mask);
  const auto take = [](int signal, const struct sigaction& by) {
    struct sigaction before {};
    // What was started with the signal ignored (nohup, a background job) goes on ignoring it.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) sigaction(signal, &by, nullptr);
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) take(signal, action);
  action.sa_handler = remember_pipe;
  action.sa_flags = 0;
  take(SIGPIPE, action);
}

bool interrupted() { return received != 0; }

bool broken_pipe() { return received == SIGPIPE; }

int interrupt_status() { return 128 + static_cast<int>(received); }

void stop_if_interrupted() {
  if (interrupted()) throw Stopped{};
}

}  // namespace gridcull
