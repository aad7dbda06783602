// One WebSocket connection: messages in, answers out, one at a time and in order (FORMATS, "Service").
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>  // before Asio: Boost 1.74 does not include it in C++20

#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <nlohmann/json_fwd.hpp>

#include "gridcull/service/server/audit.h"
#include "gridcull/service/server/hub.h"
#include "gridcull/service/server/metrics.h"
#include "gridcull/service/server/server_options.h"
#include "gridcull/service/wire_request.h"

namespace gridcull {

/// What all connections of a server share.
struct ServerParts {
  explicit ServerParts(const ServerOptions& o) : options(o), hub(options, metrics), audit(o.audit, metrics) {}

  ServerOptions options;
  Metrics metrics;
  Hub hub;
  Audit audit;
  /// Bytes of unfinished messages, of all connections.
  std::atomic<std::size_t> incoming = 0;
};

class Connection final : public SessionListener, public std::enable_shared_from_this<Connection> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  Connection(boost::beast::tcp_stream&& stream, ServerParts& parts);
  ~Connection() override;

  /// Accepts the upgrade that `request` asks for and serves.
  void start(Request request);
  /// Something that shall live as long as the connection.
  void carry(std::shared_ptr<void> companion) { companion_ = std::move(companion); }
  /// Ends it with a reason, once what is in hand is done. From any thread.
  void end(const std::string& reason);

  void taken_over() override;
  void watched(std::shared_ptr<const std::string> message) override;
  void watched_ended() override;

 private:
  using Bytes = std::shared_ptr<const std::string>;
  struct Outgoing {
    Bytes bytes;
    bool text;
  };
  /// Answers that wait to be taken before the next message is read.
  static constexpr std::size_t patience = 4;
  /// Bytes that are read at a time, at least.
  static constexpr std::size_t least_read = 1 << 16;
  /// What a watcher may be behind.
  static constexpr std::size_t watch_backlog = 64;
  /// Greatest messages' worth of unfinished ones, of all connections.
  static constexpr std::size_t most_incoming = 8;

  void accept(const Request& request);
  void read();
  void on_read(boost::beast::error_code fault);
  /// The message in `incoming_`; again a little later while the session that it is about is at work.
  void handle_message();
  void finish_message();
  void try_again();
  void count_incoming();
  void dispatch(const WireRequest& request);
  void open(const WireRequest& request);
  void resume(const WireRequest& request);
  void apply_frame(const WireRequest& request);
  void explain_object(const WireRequest& request);
  void watch(const WireRequest& request);
  void stop_watching(HeldSession& session);
  void close_session();
  /// The session with its lock; refuses when there is none or somebody else has it.
  std::unique_lock<std::mutex> use_session() const;
  void note_frame(const Session& session, double seconds);
  void audit(const Session& session);
  void refuse(const std::exception& fault, std::optional<std::uint64_t> seq);

  void say(const nlohmann::ordered_json& message);
  void send(Bytes bytes, bool text);
  void write();
  void on_write(boost::beast::error_code fault);
  void await_write();
  void close(boost::beast::websocket::close_code code, const std::string& reason);
  void finish_close();
  void drop();

  std::shared_ptr<void> companion_;
  ServerParts& parts_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::asio::steady_timer stalled_, again_;
  boost::beast::flat_buffer incoming_;
  std::deque<Outgoing> outgoing_;
  FrameRequest frame_;                  // kept for its memory
  Encoding encoding_ = Encoding::json;  // of the message in hand
  bool writing_ = false, reading_ = false;
  std::optional<boost::beast::websocket::close_reason> closing_;  // when all is written
  bool failed_ = false;                                           // the session broke
  bool ended_ = false;                                            // nothing more is read or written
  std::shared_ptr<HeldSession> held_;                             // the client's session
  std::weak_ptr<HeldSession> watched_;                            // it ends without us
  bool watches_ = false;
  std::size_t counted_ = 0;  // bytes of `incoming_` that ServerParts::incoming knows of
};

}  // namespace gridcull
