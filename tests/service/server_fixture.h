// A real server in threads of its own, on a free port, and plain ways to talk to it.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>  // before Asio: Boost 1.74 does not include it in C++20

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <nlohmann/json.hpp>

#include "gridcull/service/server/background_server.h"
#include "gridcull/sim/generate.h"

namespace gridcull::test {

namespace beast = boost::beast;
using Json = nlohmann::json;
using Tcp = boost::asio::ip::tcp;

using RunningServer = BackgroundServer;

inline Tcp::socket connected(boost::asio::io_context& context, std::uint16_t port) {
  Tcp::socket socket(context);
  socket.connect({boost::asio::ip::make_address("127.0.0.1"), port});
  return socket;
}

struct Page {
  unsigned status = 0;
  std::string body{};
  std::string allow{}, upgrade{};  ///< the headers of these names
};

inline Page http_ask(beast::http::verb method, std::uint16_t port, const std::string& path,
                     const std::string& origin = "", const std::string& host = "") {
  boost::asio::io_context context;
  Tcp::socket socket = connected(context, port);
  beast::http::request<beast::http::string_body> request(method, path, 11);
  request.set(beast::http::field::host, host.empty() ? "127.0.0.1:" + std::to_string(port) : host);
  if (!origin.empty()) request.set(beast::http::field::origin, origin);
  beast::http::write(socket, request);
  beast::flat_buffer buffer;
  beast::http::response<beast::http::string_body> response;
  beast::http::read(socket, buffer, response);
  return {response.result_int(), response.body(), response[beast::http::field::allow].to_string(),
          response[beast::http::field::upgrade].to_string()};
}

inline Page http_get(std::uint16_t port, const std::string& path, const std::string& origin = "",
                     const std::string& host = "") {
  return http_ask(beast::http::verb::get, port, path, origin, host);
}

/// A WebSocket that says what it is told, right or wrong.
class RawSocket {
 public:
  explicit RawSocket(std::uint16_t port, const std::string& origin = "") : stream_(connected(context_, port)) {
    if (!origin.empty()) {
      stream_.set_option(beast::websocket::stream_base::decorator(
          [origin](beast::websocket::request_type& request) { request.set(beast::http::field::origin, origin); }));
    }
    stream_.read_message_max(0);
    stream_.handshake("127.0.0.1:" + std::to_string(port), "/v1/stream");
  }

  void send_bytes(std::string_view bytes, bool text = true) {
    stream_.text(text);
    stream_.write(boost::asio::buffer(bytes));
  }
  void send(const Json& message) { send_bytes(message.dump()); }
  /// The next message. Throws when the connection is closed.
  Json receive() {
    beast::flat_buffer buffer;
    stream_.read(buffer);
    const std::string text = beast::buffers_to_string(buffer.data());
    return stream_.got_text() ? Json::parse(text) : Json::from_cbor(text);
  }
  Json ask(const Json& message) {
    send(message);
    return receive();
  }
  /// Reads until the other end closes, and gives the code it gave; 0 where it gave none.
  unsigned wait_for_close() {
    beast::error_code fault;
    beast::flat_buffer buffer;
    while (!fault) {
      buffer.clear();
      stream_.read(buffer, fault);
    }
    return fault == beast::websocket::error::closed ? stream_.reason().code : 0;
  }
  std::string close_reason() const { return std::string(stream_.reason().reason.c_str()); }
  /// Goes without a word.
  void drop() { stream_.next_layer().close(); }
  Tcp::socket& socket() { return stream_.next_layer(); }

 private:
  boost::asio::io_context context_;
  beast::websocket::stream<Tcp::socket> stream_;
};

inline std::unique_ptr<Generator> world_of(const std::string& kind, int frames) {
  GenerateOptions options;
  options.count = 40;
  options.viewers = 4;
  options.blocks = 3;
  options.range = 60.0;
  options.frames = frames;
  return make_generator(kind, options);
}

inline Json open_message(int frames = 1) {
  return {{"type", "open"}, {"scene", Json::parse(scene_text(world_of("town", frames)->scene()))}};
}

inline Json frame_message(std::uint64_t seq) {
  return {{"type", "frame"}, {"seq", seq}, {"time", static_cast<double>(seq)}};
}

/// Whether the metrics say so within some seconds.
inline bool becomes(std::uint16_t port, const std::string& line) {
  for (int i = 0; i < 100; ++i) {
    if (http_get(port, "/metrics").body.find("\n" + line + "\n") != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

}  // namespace gridcull::test
