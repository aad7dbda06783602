// All handlers run in the stream's strand; a session's engine works inside them, so that a client's messages are
// answered in their order. Reading waits while answers wait: a client that does not read is not read from.
#include "gridcull/service/server/connection.h"

#include <algorithm>
#include <chrono>
#include <exception>

#include <boost/asio/dispatch.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/server/secrets.h"
#include "gridcull/service/watch_message.h"
#include "gridcull/service/wire_reply.h"

namespace gridcull {

namespace beast = boost::beast;
namespace asio = boost::asio;
namespace websocket = beast::websocket;

Connection::Connection(beast::tcp_stream&& stream, ServerParts& parts)
    : parts_(parts), stream_(std::move(stream)), stalled_(stream_.get_executor()), again_(stream_.get_executor()) {
  parts_.metrics.connections.Increment();
}

Connection::~Connection() {
  parts_.metrics.connections.Decrement();
  parts_.incoming -= counted_;
  if (held_) parts_.hub.leave(held_, this);
}

void Connection::start(Request request) {
  asio::dispatch(stream_.get_executor(),
                 [self = shared_from_this(), request = std::move(request)] { self->accept(request); });
}

void Connection::accept(const Request& request) {
  beast::get_lowest_layer(stream_).expires_never();
  websocket::stream_base::timeout limits{};
  limits.handshake_timeout = std::chrono::seconds(30);
  limits.idle_timeout = parts_.options.idle;
  limits.keep_alive_pings = true;
  stream_.set_option(limits);
  // Messages are limited here, so that the refusal can say so.
  stream_.read_message_max(0);
  // One answer, one frame, one call of the system.
  stream_.auto_fragment(false);
  stream_.async_accept(request, [self = shared_from_this()](beast::error_code fault) {
    if (!fault) self->read();
  });
}

void Connection::read() {
  if (reading_ || ended_ || closing_ || outgoing_.size() >= patience) return;
  reading_ = true;
  // As much as there is room for from the messages before; memory grows with what is there, not with what is announced.
  const std::size_t most = std::max(least_read, incoming_.capacity() - incoming_.size());
  stream_.async_read_some(incoming_, most, [self = shared_from_this()](beast::error_code fault, std::size_t) {
    self->reading_ = false;
    self->on_read(fault);
  });
}

void Connection::on_read(beast::error_code fault) {
  if (fault) return drop();
  if (closing_ || ended_) return;
  count_incoming();
  const bool too_big = incoming_.size() > parts_.options.max_message;
  // A share of the rest is left for those who are heard.
  if (too_big || (counted_ > (1u << 20) && parts_.incoming > most_incoming * parts_.options.max_message)) {
    const std::string most = std::to_string(parts_.options.max_message);
    refuse(Error(ErrorCode::limit, too_big ? "message: expected at most " + most + " bytes"
                                           : "message: too many large messages at a time"),
           std::nullopt);
    return close(websocket::close_code::too_big, "the message is too big");
  }
  if (stream_.is_message_done()) {
    encoding_ = stream_.got_text() ? Encoding::json : Encoding::cbor;
    return handle_message();
  }
  read();
}

void Connection::count_incoming() {
  parts_.incoming += incoming_.size() - counted_;
  counted_ = incoming_.size();
}

void Connection::handle_message() {
  const auto data = incoming_.cdata();
  std::optional<std::uint64_t> seq;
  try {
    if (held_) held_->lock_if_idle();  // before a long message is read once more in vain
    const WireRequest request({static_cast<const char*>(data.data()), data.size()}, encoding_);
    if (request.type() == "frame") seq = seq_of(request);
    dispatch(request);
  } catch (const SessionBusy&) {
    return try_again();
  } catch (const std::exception& fault) {
    refuse(fault, seq);
    if (failed_) close(websocket::close_code::internal_error, "the session failed");
  }
  finish_message();
}

void Connection::finish_message() {
  incoming_.consume(incoming_.size());
  count_incoming();
  // What a huge message took is given back.
  if (incoming_.capacity() > (1u << 20)) {
    incoming_ = {};
    frame_ = {};
  }
  read();
}

void Connection::try_again() {
  again_.expires_after(std::chrono::milliseconds(2));
  again_.async_wait([self = shared_from_this()](beast::error_code fault) {
    if (!fault && !self->closing_ && !self->ended_) self->handle_message();
  });
}

void Connection::dispatch(const WireRequest& request) {
  const std::string& type = request.type();
  if (type == "frame") return apply_frame(request);
  if (type == "open") return open(request);
  if (type == "resume") return resume(request);
  if (type == "explain") return explain_object(request);
  if (type == "watch") return watch(request);
  if (type == "close") {
    request.root().only_keys({"type"});
    return close_session();
  }
  request.root().at("type").refuse("\"open\", \"frame\", \"close\", \"resume\", \"explain\" or \"watch\"");
}

void Connection::open(const WireRequest& request) {
  if (held_) throw Error(ErrorCode::sequence, "message: expected \"close\" before another \"open\"");
  OpenRequest open = read_open(request, parts_.options.threads);
  if (!parts_.options.token.empty() && !same_secret(parts_.options.token, open.token)) {
    throw Error(ErrorCode::forbidden, "message: /token: expected the server's token");
  }
  held_ = parts_.hub.open(std::move(open), shared_from_this());
  const std::lock_guard lock(held_->mutex);
  say(opened_message(held_->session, held_->key));
}

void Connection::resume(const WireRequest& request) {
  if (held_) throw Error(ErrorCode::sequence, "message: expected \"close\" before \"resume\"");
  held_ = parts_.hub.resume(read_resume(request), shared_from_this());
  say({{"type", "resumed"}, {"seq", held_->summary().seq}});
}

std::unique_lock<std::mutex> Connection::use_session() const {
  if (!held_) throw Error(ErrorCode::sequence, "message: expected \"open\" or \"resume\" first");
  std::unique_lock lock = held_->lock_if_idle();
  if (held_->ended) throw Error(ErrorCode::sequence, "message: the session has ended");
  if (held_->client.lock().get() != this) {
    throw Error(ErrorCode::forbidden, "message: another connection has resumed the session");
  }
  return lock;
}

void Connection::apply_frame(const WireRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  const std::unique_lock lock = use_session();
  Session& session = held_->session;
  read_frame_request(request, session.dimension(), frame_);
  const bool is_new = frame_.seq != session.seq();
  Bytes bytes;
  try {
    bytes = std::make_shared<const std::string>(encoded_frame(session.apply(frame_), encoding_));
  } catch (...) {
    // The refusal goes out first.
    failed_ = session.broken();
    if (failed_) parts_.hub.close(held_);
    throw;
  }
  // Counted before it is answered: who has the answer finds the frame in every list.
  if (is_new) {
    held_->summarise(true);
    note_frame(session, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  send(std::move(bytes), encoding_ == Encoding::json);
  if (!is_new) return;
  audit(session);
  if (held_->watchers.empty()) return session.draw(no_id);
  nlohmann::ordered_json step = watch_step(session, session.last_frame());
  if (const auto exact = held_->exact(session.drawing())) step["exact"] = *exact;
  const auto message = std::make_shared<const std::string>(step.dump());
  std::erase_if(held_->watchers, [&](const auto& watcher) {
    const std::shared_ptr<SessionListener> there = watcher.lock();
    if (there) there->watched(message);
    return !there;
  });
}

void Connection::note_frame(const Session& session, double seconds) {
  Metrics& metrics = parts_.metrics;
  const Answers& answers = session.answers();
  metrics.frames.Increment();
  metrics.queries.Increment(static_cast<double>(answers.views.size()));
  metrics.positions_read.Increment(static_cast<double>(answers.stats.positions_read));
  metrics.tbv_revealed.Increment(static_cast<double>(answers.stats.tbv_revealed));
  metrics.frame_seconds.Observe(seconds);
  for (const Answer& answer : answers.views) metrics.pvs_objects.Observe(static_cast<double>(answer.visible.size()));
}

void Connection::audit(const Session& session) {
  const auto told = [weak = std::weak_ptr(held_)](ViewerId viewer, std::size_t exact) {
    if (const std::shared_ptr<HeldSession> held = weak.lock()) held->note_exact(viewer, exact);
  };
  parts_.audit.offer(session.world().objects(), session.dimension(), session.views(), session.answers(),
                     session.guarantee(), told);
}

void Connection::explain_object(const WireRequest& request) {
  // Those who watch may ask too.
  const std::shared_ptr<HeldSession> seen = held_ || !watches_ ? nullptr : watched_.lock();
  if (!seen && !held_ && watches_) throw Error(ErrorCode::sequence, "message: the session has ended");
  const std::unique_lock lock = seen ? seen->lock_if_idle() : use_session();
  const Session& session = (seen ? seen : held_)->session;
  say(explained_json(session.explain(read_explain(request)), session.dimension()));
}

void Connection::watch(const WireRequest& request) {
  const auto [key, viewer] = read_watch(request);
  if (!parts_.options.token.empty() && !same_secret(parts_.options.token, key.token)) {
    throw Error(ErrorCode::forbidden, "message: /token: expected the server's token");
  }
  const std::shared_ptr<HeldSession> found = parts_.hub.find(key.session), before = watched_.lock();
  const bool again = found == before;
  if (before && !again) stop_watching(*before);
  const std::unique_lock lock = found->lock_if_idle();
  if (found->ended) throw Error(ErrorCode::forbidden, "message: expected a session that is there and its token");
  watched_ = found;
  watches_ = true;
  Session& session = found->session;
  // One drawing a session: the last who chose a viewer.
  if (viewer != no_id) session.draw(viewer);
  say(watch_start(session, key.session));
  if (!again) found->watchers.push_back(weak_from_this());
  // The world above holds what the last frame did: its time, views and answers are what is missing.
  if (session.seq() > 0) say(watch_step(session, Frame{.time = session.world().time().value_or(0.0)}));
}

void Connection::stop_watching(HeldSession& session) {
  const std::unique_lock lock = session.lock_if_idle();
  std::erase_if(session.watchers, [this](const auto& watcher) { return watcher.lock().get() == this; });
  if (session.watchers.empty()) session.session.draw(no_id);
  watched_.reset();
  watches_ = false;
}

void Connection::close_session() {
  {
    const std::unique_lock lock = use_session();
    parts_.hub.close(held_);
  }
  held_.reset();
  say({{"type", "closed"}});
}

void Connection::refuse(const std::exception& fault, std::optional<std::uint64_t> seq) {
  const WireError error = wire_error(fault);
  parts_.metrics.count_rejected(error.code);
  say(error_message(error, seq));
}

void Connection::taken_over() {
  asio::post(stream_.get_executor(), [self = shared_from_this()] {
    self->held_.reset();
    self->close(websocket::close_code::policy_error, "another connection has resumed the session");
  });
}

void Connection::watched(std::shared_ptr<const std::string> message) {
  asio::post(stream_.get_executor(), [self = shared_from_this(), message = std::move(message)] {
    if (self->outgoing_.size() < watch_backlog) return self->send(message, true);
    self->parts_.metrics.slow_closed.Increment();
    self->watched_.reset();
    self->watches_ = false;
    // What is being written has to stay.
    self->outgoing_.resize(1);
    self->close(websocket::close_code::try_again_later, "too slow to watch");
  });
}

void Connection::watched_ended() {
  asio::post(stream_.get_executor(), [self = shared_from_this()] {
    self->watched_.reset();
    static const auto message = std::make_shared<const std::string>(R"({"type":"ended"})");
    self->send(message, true);
  });
}

void Connection::end(const std::string& reason) {
  asio::post(stream_.get_executor(),
             [self = shared_from_this(), reason] { self->close(websocket::close_code::going_away, reason); });
}

void Connection::say(const nlohmann::ordered_json& message) {
  send(std::make_shared<const std::string>(encoded(message, encoding_)), encoding_ == Encoding::json);
}

void Connection::send(Bytes bytes, bool text) {
  if (closing_ || ended_) return;
  outgoing_.push_back({std::move(bytes), text});
  write();
}

void Connection::write() {
  if (writing_ || ended_) return;
  if (outgoing_.empty()) {
    if (closing_) finish_close();
    return;
  }
  writing_ = true;
  await_write();
  stream_.text(outgoing_.front().text);
  stream_.async_write(asio::buffer(*outgoing_.front().bytes),
                      [self = shared_from_this()](beast::error_code fault, std::size_t) { self->on_write(fault); });
}

/// Whoever takes nothing is cut off.
void Connection::await_write() {
  stalled_.expires_after(parts_.options.stall);
  stalled_.async_wait([self = shared_from_this()](beast::error_code fault) {
    if (fault || !self->writing_) return;
    self->parts_.metrics.slow_closed.Increment();
    self->drop();
  });
}

void Connection::on_write(beast::error_code fault) {
  writing_ = false;
  stalled_.cancel();
  if (fault) return drop();
  outgoing_.pop_front();
  write();
  read();
}

void Connection::close(websocket::close_code code, const std::string& reason) {
  if (closing_ || ended_) return;
  closing_.emplace(code, reason);
  write();
}

void Connection::finish_close() {
  ended_ = true;
  writing_ = true;
  await_write();
  stream_.async_close(*closing_, [self = shared_from_this()](beast::error_code) {
    self->writing_ = false;
    self->stalled_.cancel();
  });
}

void Connection::drop() {
  ended_ = true;
  beast::get_lowest_layer(stream_).cancel();
  beast::error_code ignored;
  beast::get_lowest_layer(stream_).socket().close(ignored);
}

}  // namespace gridcull
