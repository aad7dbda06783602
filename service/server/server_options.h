// What `gridcull serve` is told.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace gridcull {

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;                            ///< 0: any that is free
  int threads = 2;                                      ///< 1 .. 256: that many sessions compute at once
  std::uint64_t max_sessions = 100;                     ///< those that wait for their client included
  std::uint64_t max_objects = 1'000'000;                ///< of a session
  std::uint64_t max_message = std::uint64_t{64} << 20;  ///< bytes
  std::uint64_t max_memory = std::uint64_t{1} << 30;    ///< bytes, of a session's grid
  std::uint64_t max_connections = 1024;
  std::chrono::seconds keep{60};   ///< a session outlives its connection by this
  std::chrono::seconds idle{300};  ///< a connection whose other end is silent, pings included, is closed
  std::chrono::seconds stall{20};  ///< a connection that takes nothing for so long is closed
  std::string token{};             ///< needed to open and watch; "": not
  std::vector<std::string> allowed_origins{};
  std::string record{};                       ///< folder for the sessions' records; "": none
  std::string trace_scene{}, trace_frames{};  ///< files that the page shows by itself; "": none
  double audit = 0.0;                         ///< share of the answers that is held against the reference, 0 .. 1
};

}  // namespace gridcull
