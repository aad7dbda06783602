#include "gridcull/service/server/http_front.h"

#include <chrono>
#include <string>
#include <utility>

#include <boost/asio/dispatch.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/server/page.h"
#include "gridcull/sim/text_file.h"

namespace gridcull {

namespace beast = boost::beast;
namespace http = beast::http;

namespace {

constexpr std::size_t largest_body = 64 << 10;
constexpr std::chrono::seconds slowest{30};
constexpr const char *plain = "text/plain; charset=utf-8", *json = "application/json";

/// The path without its query.
std::string_view path_of(beast::string_view target) {
  const std::string_view all(target.data(), target.size());
  return all.substr(0, all.find('?'));
}

std::string_view text_of(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

void HttpFront::start() {
  boost::asio::dispatch(stream_.get_executor(), [self = shared_from_this()] { self->read(); });
}

void HttpFront::read() {
  parser_.emplace();
  parser_->body_limit(largest_body);
  stream_.expires_after(slowest);
  http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code fault, std::size_t) {
    fault ? self->refuse(fault) : self->answer();
  });
}

/// Tells what came that is no HTTP; whoever merely went away or fell silent hears nothing.
void HttpFront::refuse(beast::error_code fault) {
  const beast::error_code some = http::error::bad_method;
  if (fault.category() != some.category() || fault == http::error::end_of_stream ||
      fault == http::error::partial_message) {
    return;
  }
  const http::status status = fault == http::error::header_limit ? http::status::request_header_fields_too_large
                              : fault == http::error::body_limit ? http::status::payload_too_large
                                                                 : http::status::bad_request;
  Request unread;
  unread.version(11);
  unread.keep_alive(false);
  send(respond(unread, status, plain, "expected an HTTP request, found: " + fault.message() + "\n"));
}

HttpFront::Response HttpFront::respond(const Request& request, http::status status, const char* type,
                                       std::string body) {
  Response response(status, request.version());
  response.set(http::field::content_type, type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  // The page holds all that it needs and asks nobody else.
  response.set("Content-Security-Policy",
               "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; "
               "connect-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'self'");
  response.keep_alive(request.keep_alive());
  response.content_length(body.size());
  if (request.method() != http::verb::head) response.body() = std::move(body);
  return response;
}

void HttpFront::answer() {
  Request request = parser_->release();
  if (upgrade(request)) return;
  const std::string_view path = path_of(request.target());
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    Response response = respond(request, http::status::method_not_allowed, plain, "expected GET\n");
    response.set(http::field::allow, "GET, HEAD");
    return send(std::move(response));
  }
  if (!origins_.may_use(text_of(request[http::field::origin]), text_of(request[http::field::host]))) {
    return send(respond(request, http::status::forbidden, plain, "another origin\n"));
  }
  if (path == "/healthz") return send(respond(request, http::status::ok, plain, "ok"));
  if (path == "/metrics") {
    return send(respond(request, http::status::ok, "text/plain; version=0.0.4", parts_.metrics.text()));
  }
  if (path == "/v1/sessions") {
    return send(respond(request, http::status::ok, json, parts_.hub.list().dump() + "\n"));
  }
  if (path == "/v1/stream") {
    Response response =
        respond(request, http::status::upgrade_required, plain, "expected a WebSocket (gridcull.wire/1)\n");
    response.set(http::field::upgrade, "websocket");
    return send(std::move(response));
  }
  if (path == "/v1/trace/scene.json") return send_file(request, parts_.options.trace_scene);
  if (path == "/v1/trace/frames.jsonl") return send_file(request, parts_.options.trace_frames);
  if (path == "/") return send(respond(request, http::status::ok, "text/html; charset=utf-8", page_text()));
  send(respond(request, http::status::not_found, plain,
               "not here: expected /, /healthz, /metrics or /v1/sessions, or a WebSocket at /v1/stream\n"));
}

void HttpFront::send_file(const Request& request, const std::string& file) {
  if (file.empty()) return send(respond(request, http::status::no_content, plain, ""));  // see gridcull view
  try {
    send(respond(request, http::status::ok, json, read_text(file)));
  } catch (const Error& fault) {
    send(respond(request, http::status::internal_server_error, plain, std::string(fault.what()) + "\n"));
  }
}

bool HttpFront::upgrade(Request& request) {
  if (!beast::websocket::is_upgrade(request)) return false;
  if (path_of(request.target()) != "/v1/stream") {
    send(respond(request, http::status::not_found, plain, "expected a WebSocket at /v1/stream\n"));
  } else if (!origins_.may_use(text_of(request[http::field::origin]), text_of(request[http::field::host]))) {
    parts_.metrics.count_rejected("forbidden");
    send(respond(request, http::status::forbidden, plain, "another origin (see --allow-origin)\n"));
  } else {
    const auto connection = std::make_shared<Connection>(std::move(stream_), parts_);
    upgraded_(connection);
    connection->start(std::move(request));
  }
  return true;
}

void HttpFront::send(Response&& response) {
  response_ = std::make_shared<Response>(std::move(response));
  http::async_write(stream_, *response_, [self = shared_from_this()](beast::error_code fault, std::size_t) {
    if (fault) return;
    if (self->response_->keep_alive()) return self->read();
    beast::error_code ignored;
    self->stream_.socket().shutdown(boost::asio::ip::tcp::socket::shutdown_send, ignored);
  });
}

}  // namespace gridcull
