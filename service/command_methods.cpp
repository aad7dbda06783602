// `gridcull methods`: what there is to choose from.
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>

#include "gridcull/methods/catalog.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/run_report.h"

namespace gridcull {
namespace {

std::string entry_text(const MethodEntry& entry) {
  const MethodInfo& info = entry.info;
  std::string text(info.name);
  if (info.name == default_method()) text += " (default)";
  text += ": " + std::string(info.summary) + "\n  ";
  text += info.takes_2d && info.takes_3d ? "2D and 3D" : info.takes_2d ? "2D" : "3D";
  text += ", " + guarantee_text(info.guarantee) +
          (info.guarantee == Guarantee::conservative ? " (never misses)" : " (may miss)");
  text += info.moving_occluders ? ", movers occlude" : ", only static objects occlude";
  text += "\n  options: " + (entry.options.empty() ? std::string("none") : std::string(entry.options)) + "\n";
  return text;
}

int list_methods() {
  for (const MethodEntry& entry : method_catalog()) std::fputs(entry_text(entry).c_str(), stdout);
  return 0;
}

}  // namespace

void add_methods_command(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("methods", "List the methods that run and check know");
  command.footer("Example:\n  gridcull methods");
  command.callback([&action] { action = list_methods; });
}

}  // namespace gridcull
