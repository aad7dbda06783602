// A server in threads of its own, on any free port, for as long as this lives: benchmarks and tests talk to it.
#pragma once

#include <cstdint>
#include <thread>

#include "gridcull/service/server/server.h"

namespace gridcull {

class BackgroundServer {
 public:
  explicit BackgroundServer(ServerOptions options = {})
      : server_(on_any_port(options)), thread_([this] { server_.run(false); }) {}
  ~BackgroundServer() { stop(); }
  BackgroundServer(const BackgroundServer&) = delete;
  BackgroundServer& operator=(const BackgroundServer&) = delete;
  /// Gives back when the server has ended.
  void stop() {
    if (!thread_.joinable()) return;
    server_.stop();
    thread_.join();
  }
  std::uint16_t port() const { return server_.port(); }

 private:
  static ServerOptions on_any_port(ServerOptions options) {
    options.port = 0;
    return options;
  }
  Server server_;
  std::thread thread_;
};

}  // namespace gridcull
