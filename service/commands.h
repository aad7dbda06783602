// The commands of the program, one file each.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace gridcull {

/// What the chosen command does once the command line is read; gives the exit status.
using Action = std::function<int()>;

// Each adds its command to `app`; parsing that command sets `action`.
void add_run_command(CLI::App& app, Action& action);
void add_check_command(CLI::App& app, Action& action);
void add_info_command(CLI::App& app, Action& action);
void add_explain_command(CLI::App& app, Action& action);
void add_make_command(CLI::App& app, Action& action);
void add_import_command(CLI::App& app, Action& action);
void add_methods_command(CLI::App& app, Action& action);
void add_bake_command(CLI::App& app, Action& action);
void add_bench_command(CLI::App& app, Action& action);
// In server/, where that is built.
void add_serve_command(CLI::App& app, Action& action);
void add_view_command(CLI::App& app, Action& action);

}  // namespace gridcull
