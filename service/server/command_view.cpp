// `gridcull view`: a world's files on the viewer page.
#include <cstdio>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/server/server.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull {
namespace {

/// Files that cannot be shown are refused here, not on the page.
void check_files(const ServerOptions& options) {
  for (const std::string& file : {options.trace_scene, options.trace_frames}) {
    if (file == "-") throw Error(ErrorCode::usage, "view: expected files, found standard input");
  }
  const Scene scene = read_scene(options.trace_scene);
  if (options.trace_frames.empty()) return;
  FrameReader frames(options.trace_frames, scene.dimension);
  Frame first;
  (void)frames.next(first);
}

int view(const ServerOptions& options) {
  check_files(options);
  Server server(options);
  std::printf("listening on %s\n", server.url().c_str());
  std::fflush(stdout);
  server.run(true);
  return 0;
}

}  // namespace

void add_view_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ServerOptions>();
  options->port = 0;
  CLI::App& command = *app.add_subcommand("view", "Look at a world's files in a browser");
  add_text(command, "SCENE", options->trace_scene, "a file name", "scene file (.json, .json.gz)").required();
  add_text(command, "--frames", options->trace_frames, "a file name", "frames file (.jsonl, .jsonl.gz)");
  add_text(command, "--address", options->address, "an IP address", "where to listen (default 127.0.0.1)")
      .type_name("IP");
  add_whole(command, "--port", options->port, {0, 65535, "a port, 0 .. 65535"}, "default 0: any that is free");
  command.footer(
      "Open the address that it prints. Ctrl-C ends it.\n\n"
      "Example: a town and who sees whom in it\n"
      "  gridcull make town --out town --viewers 10 --range 100\n"
      "  gridcull view town/scene.json --frames town/frames.jsonl");
  command.callback([options, &action] { action = [options] { return view(*options); }; });
}

}  // namespace gridcull
