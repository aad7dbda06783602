// The service: WebSocket and HTTP on one port, any number of sessions (FORMATS, "Service").
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gridcull/service/server/server_options.h"

namespace gridcull {

class Server {
 public:
  /// Binds and listens. Throws Error(io) where that fails, Error(usage) for an address that is none.
  explicit Server(const ServerOptions& options);
  ~Server();

  std::uint16_t port() const;
  /// "http://127.0.0.1:8080".
  std::string url() const;

  /// Serves in `options.threads` threads until stop() or, if `signals`, SIGINT, SIGTERM or SIGHUP; then frames in hand
  /// are finished and connections closed with a reason.
  void run(bool signals);
  /// From any thread.
  void stop();

 private:
  struct Detail;
  std::unique_ptr<Detail> detail_;
};

}  // namespace gridcull
