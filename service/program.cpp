#include "gridcull/service/program.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include <CLI/CLI.hpp>
#include <tbb/global_control.h>

#include "gridcull/core/error.h"
#include "gridcull/grid/instruction_set.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/interrupt.h"

namespace gridcull {
namespace {

constexpr int bad_input = 2;
constexpr std::size_t most_threads = 256;

/// One line, whatever the message holds.
int refuse(std::string message) {
  for (char& c : message) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!message.empty() && message.back() == ' ') message.pop_back();
  std::fprintf(stderr, "gridcull: %s\n", message.c_str());
  return bad_input;
}

int stopped(const Stopped& stop = {}) {
  // Whoever reads our output and has enough (`| head`) knows that it stops.
  if (!broken_pipe()) std::fprintf(stderr, "gridcull: stopped; %s\n", stop.note.c_str());
  return interrupt_status();
}

bool all_written() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

int unwritten() {
  if (broken_pipe()) return interrupt_status();
  return refuse(std::string("standard output: cannot be written: ") + std::strerror(errno));
}

/// What is wrong with a command line, and where to look.
int refuse_usage(const CLI::App& app, const CLI::ParseError& fault) {
  std::string command = "gridcull";
  for (const CLI::App* at = &app; !at->get_subcommands().empty();) {
    at = at->get_subcommands().front();
    command += " " + at->get_name();
  }
  std::string line = fault.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&fault) != nullptr) {
    line.clear();
    for (const std::string& extra : app.remaining(true)) line += (line.empty() ? "" : " ") + extra;
    line += ": not expected";
  }
  return refuse(line + " (see " + command + " --help)");
}

/// Help or the version.
int show(const CLI::App& app, const CLI::ParseError& wish) {
  const int status = app.exit(wish);
  std::cout.flush();
  return all_written() ? status : unwritten();
}

int perform(const Action& action) {
  try {
    catch_interrupts();
    (void)choose_instruction_set();  // a set that this machine lacks is refused whatever the command
    // More threads than cores are allowed; unless told so, TBB writes a warning of its own.
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, most_threads);
    const int status = action();
    return all_written() ? status : unwritten();
  } catch (const Stopped& stop) {
    return stopped(stop);
  } catch (const std::bad_alloc&) {
    return refuse("out of memory");
  } catch (const std::exception& e) {
    // A read that a signal broke off says that it failed; what happened is the signal.
    return interrupted() ? stopped() : refuse(e.what());
  }
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  CLI::App app("Who can see whom, in a world where everything moves.", "gridcull");
  app.set_version_flag("--version", std::string("gridcull ") + GRIDCULL_VERSION);
  app.require_subcommand(0, 1);
  app.footer("gridcull COMMAND --help says more, with an example.");
  Action action;
  add_run_command(app, action);
  add_check_command(app, action);
  add_info_command(app, action);
  add_explain_command(app, action);
  add_make_command(app, action);
  add_import_command(app, action);
  add_methods_command(app, action);
  add_bake_command(app, action);
  add_bench_command(app, action);
#ifdef GRIDCULL_WITH_SERVER
  add_serve_command(app, action);
  add_view_command(app, action);
#endif
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? show(app, e) : refuse_usage(app, e);
  } catch (const std::exception& e) {
    return refuse(e.what());
  }
  if (!action)
    return refuse(
        "a command is missing: run, check, info, explain, make, import, methods, bake, bench, serve or view (see "
        "gridcull --help)");
  return perform(action);
}

}  // namespace gridcull
