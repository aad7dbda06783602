// One TCP connection as it comes in: answers plain HTTP, and hands it on when it asks for a WebSocket.
#pragma once

#include <functional>
#include <memory>
#include <utility>  // before Asio: Boost 1.74 does not include it in C++20

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>

#include "gridcull/service/server/connection.h"
#include "gridcull/service/server/origins.h"

namespace gridcull {

class HttpFront : public std::enable_shared_from_this<HttpFront> {
 public:
  using Upgraded = std::function<void(const std::shared_ptr<Connection>&)>;

  /// `upgraded` is told of each WebSocket connection before it starts.
  HttpFront(boost::beast::tcp_stream&& stream, ServerParts& parts, const Origins& origins, Upgraded upgraded)
      : stream_(std::move(stream)), parts_(parts), origins_(origins), upgraded_(std::move(upgraded)) {}

  void start();

 private:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;
  using Response = boost::beast::http::response<boost::beast::http::string_body>;

  void read();
  void refuse(boost::beast::error_code fault);
  void answer();
  void send_file(const Request& request, const std::string& file);
  bool upgrade(Request& request);
  void send(Response&& response);
  static Response respond(const Request& request, boost::beast::http::status status, const char* type,
                          std::string body);

  boost::beast::tcp_stream stream_;
  ServerParts& parts_;
  const Origins& origins_;
  Upgraded upgraded_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  std::shared_ptr<Response> response_;  // while it is written
};

}  // namespace gridcull
