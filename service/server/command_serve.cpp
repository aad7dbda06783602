// `gridcull serve`: answers simulators over the network.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/service/commands.h"
#include "gridcull/service/option_values.h"
#include "gridcull/service/server/origins.h"
#include "gridcull/service/server/server.h"
#include "gridcull/service/text.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {
namespace {

struct ServeOptions {
  ServerOptions server{};
  std::uint64_t keep = 60, idle = 300;
  std::string token_file{};
};

/// The first line of the file.
std::string read_token(const std::string& file) {
  TextReader reader(file);
  std::string token;
  if (!reader.line(token) || token.empty()) {
    throw Error(ErrorCode::bad_message, file + ": expected a token in the first line, found nothing");
  }
  return token;
}

/// Refused at once, not with the first session.
void prepare_record(const std::string& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) throw Error(ErrorCode::io, folder + ": the folder cannot be made: " + fault.message());
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::io, folder + ": cannot be written into: " + std::strerror(errno));
  }
}

int serve(ServeOptions options) {
  ServerOptions& server = options.server;
  for (const std::string& origin : server.allowed_origins) {
    if (is_origin(origin)) continue;
    throw option_error("--allow-origin", "an origin as browsers send it, like https://example.org:8443",
                       origin.empty() ? "nothing" : origin);
  }
  server.keep = std::chrono::seconds(options.keep);
  server.idle = std::chrono::seconds(options.idle);
  if (!options.token_file.empty()) server.token = read_token(options.token_file);
  if (!server.record.empty()) prepare_record(server.record);
  Server service(server);
  std::printf("listening on %s\n", service.url().c_str());
  std::fflush(stdout);
  service.run(true);
  return 0;
}

}  // namespace

void add_serve_command(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ServeOptions>();
  ServerOptions& server = options->server;
  CLI::App& command =
      *app.add_subcommand("serve", "Answer simulators over WebSocket, frame by frame (gridcull.wire/1)");
  const std::uint64_t most = std::uint64_t{1} << 32;
  add_text(command, "--address", server.address, "an IP address",
           "where to listen (default 127.0.0.1: this machine only)")
      .type_name("IP");
  add_whole(command, "--port", server.port, {0, 65535, "a port, 0 .. 65535"}, "0 picks a free one (default 8080)");
  add_whole(command, "--threads", server.threads, {1, 256, "1 .. 256"}, "sessions that compute at once (default 2)");
  add_whole(command, "--max-sessions", server.max_sessions, {1, most, "1 or more"}, "default 100");
  add_whole(command, "--max-objects", server.max_objects, {1, most, "1 or more"}, "of a session (default 1,000,000)");
  add_whole(command, "--max-message", server.max_message, memory_bytes(), "default 64 MiB").type_name("BYTES");
  add_whole(command, "--max-memory", server.max_memory, memory_bytes(),
            "of a session's grid, masks and maps (default 1 GiB)")
      .type_name("BYTES");
  add_whole(command, "--max-connections", server.max_connections, {1, most, "1 or more"},
            "further ones are closed at once (default 1024)");
  add_whole(command, "--keep", options->keep, {0, most, "whole seconds, 0 or more"},
            "a session outlives its connection by this (default 60)")
      .type_name("SECONDS");
  add_whole(command, "--idle", options->idle, {1, most, "whole seconds, 1 or more"},
            "close connections whose other end answers no ping (default 300)")
      .type_name("SECONDS");
  add_text(command, "--token-file", options->token_file, "a file name",
           "whose first line is the token that opening and watching need")
      .type_name("FILE");
  command.add_option("--allow-origin", server.allowed_origins, "a browser's origin besides our own; may be repeated")
      ->type_name("ORIGIN")
      ->allow_extra_args(false);
  add_text(command, "--record", server.record, "a folder",
           "keep each session as DIR/SESSION/scene.json and frames.jsonl, which gridcull run replays")
      .type_name("DIR");
  add_positive(command, "--audit", server.audit, {1.0, "a share, 0 .. 1", true},
               "hold this share of the answers against the exact reference; /metrics counts misses (default 0)")
      .type_name("RATE");
  command.footer(
      "GET /metrics (Prometheus), /healthz, /v1/sessions; / is a page to watch sessions.\n"
      "Ctrl-C or SIGTERM: the frames in hand are finished.\n\n"
      "Example: a server on a free port that records\n"
      "  gridcull serve --port 0 --record sessions");
  command.callback([options, &action] { action = [options] { return serve(*options); }; });
}

}  // namespace gridcull
