// A client of `gridcull serve` (gridcull.wire/1) in one header: Boost.Beast and nlohmann-json, nothing of gridcull.
//
//   gridcull::Client client("127.0.0.1", 8080);
//   client.open(scene);                                   // gridcull.scene/1 as JSON
//   gridcull::Client::Frame frame{.time = 0.1};
//   frame.move(9, {13.0, 7.0}, 1.57);
//   for (const auto& [viewer, visible] : client.frame(frame)) ...
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <nlohmann/json.hpp>

namespace gridcull {

/// An answer of type "error".
class Refusal : public std::runtime_error {
 public:
  explicit Refusal(const nlohmann::json& answer)
      : std::runtime_error(answer.at("message").get<std::string>()),
        code(answer.at("code").get<std::string>()),
        pointer(answer.value("pointer", "")) {}

  const std::string code;     ///< as in the protocol: "bad_frame", "sequence", ...
  const std::string pointer;  ///< JSON pointer to what was refused, or ""
};

/// One session over one connection. Calls wait for their answer. Throws Refusal, which changes nothing, and
/// boost::system::system_error when the connection is lost: then reconnect() and resume.
class Client {
 public:
  using Ids = std::vector<std::uint32_t>;
  /// By viewer: ids of the objects that it may see, ascending.
  using Answers = std::map<std::uint32_t, Ids>;
  enum class Reply { full, delta, none };

  /// A frame as it is told: moves in bulk, everything else as in gridcull.frames/1.
  struct Frame {
    double time = 0.0;
    nlohmann::json rest = nlohmann::json::object();  ///< "add", "remove", "viewers", "drop_viewers"

    /// 2D: position and heading (radians).
    void move(std::uint32_t id, const std::array<double, 2>& position, double heading) {
      ids.push_back(id);
      positions.insert(positions.end(), position.begin(), position.end());
      turns.push_back(heading);
    }
    /// 3D: position and unit quaternion (w, x, y, z).
    void move(std::uint32_t id, const std::array<double, 3>& position, const std::array<double, 4>& orientation) {
      ids.push_back(id);
      positions.insert(positions.end(), position.begin(), position.end());
      turns.insert(turns.end(), orientation.begin(), orientation.end());
    }

    std::vector<std::uint32_t> ids{};
    std::vector<double> positions{}, turns{};
  };

  Client(const std::string& address, std::uint16_t port) : address_(address), port_(port) { connect(); }

  /// Opens a session. `more`: "options", "name", "token".
  nlohmann::json open(const nlohmann::json& scene, const std::string& method = "silhouette",
                      const nlohmann::json& more = nlohmann::json::object()) {
    nlohmann::json message{{"type", "open"}, {"scene", scene}, {"method", method}};
    message.update(more);
    nlohmann::json answer = ask(message);
    session_ = answer.at("session").get<std::string>();
    token_ = answer.at("token").get<std::string>();
    seq_ = 0;
    seen_.clear();
    return answer;
  }

  /// Tells a frame; empty with Reply::none. The answers are there until the next call.
  const Answers& frame(const Frame& frame, Reply reply = Reply::delta) {
    last_.clear();
    last_seq_ = seq_ + 1;
    const bool moves = !frame.ids.empty();
    const char* replies[] = {"full", "delta", "none"};
    nlohmann::json rest = frame.rest;
    for (const char* own : {"type", "seq", "time", "bulk", "reply"}) rest.erase(own);
    put_head(5, 5 + rest.size() + (moves ? 3 : 0));
    for (const auto& [key, value] : rest.items()) put(key, value);
    put("type", "frame");
    put("seq", last_seq_);
    put("time", frame.time);
    put("bulk", true);
    put("reply", replies[static_cast<int>(reply)]);
    if (moves) {
      const bool flat = frame.turns.size() == frame.ids.size();
      put_bytes("set_ids", std::span(frame.ids));
      put_bytes("set_positions64", std::span(frame.positions));
      put_bytes(flat ? "set_headings64" : "set_orientations64", std::span(frame.turns));
    }
    return exchange_frame();
  }

  /// After reconnect(): sends the last frame again, since nobody knows whether it or its answer was lost, and gives its
  /// answers. The server applies a frame once.
  const Answers& repeat() { return exchange_frame(); }

  /// Why the viewer sees the object in the last frame, or does not.
  nlohmann::json explain(std::uint32_t viewer, std::uint32_t object) {
    return ask({{"type", "explain"}, {"viewer", viewer}, {"object", object}});
  }

  /// A new connection to the same session. Gives the number of the last frame that it applied.
  std::uint64_t reconnect() {
    connect();
    seq_ = ask({{"type", "resume"}, {"session", session_}, {"token", token_}}).at("seq").get<std::uint64_t>();
    return seq_;
  }

  /// Ends the session.
  void close() { ask({{"type", "close"}}); }

  const std::string& session() const { return session_; }
  std::uint64_t seq() const { return seq_; }

  /// Sends any message and gives its answer.
  nlohmann::json ask(const nlohmann::json& message) {
    std::vector<std::uint8_t> bytes;
    nlohmann::json::to_cbor(message, nlohmann::detail::output_adapter<std::uint8_t>(bytes));
    exchange(bytes);
    return parsed();
  }

 private:
  /// Sends a message and waits for its answer, which is in incoming_ then.
  void exchange(std::span<const std::uint8_t> bytes) {
    stream_->binary(true);
    stream_->write(boost::asio::buffer(bytes.data(), bytes.size()));
    incoming_.clear();
    do {
      stream_->read_some(incoming_, std::size_t{1} << 16);
    } while (!stream_->is_message_done());
  }

  std::span<const std::uint8_t> received() const {
    return {static_cast<const std::uint8_t*>(incoming_.cdata().data()), incoming_.size()};
  }

  nlohmann::json parsed() const {
    const auto bytes = received();
    nlohmann::json answer = stream_->got_text() ? nlohmann::json::parse(bytes.begin(), bytes.end())
                                                : nlohmann::json::from_cbor(bytes.begin(), bytes.end());
    if (answer.at("type") == "error") throw Refusal(answer);
    return answer;
  }

  const Answers& exchange_frame() {
    exchange(last_);
    std::uint64_t seq = 0;
    if (stream_->got_text() || !Unpacker(received()).answers(seq, told_)) {
      // An error, "ok", or an answer written in another way.
      const nlohmann::json answer = parsed();
      seq = answer.at("seq").get<std::uint64_t>();
      told_.clear();
      if (answer.at("type") == "pvs") {
        for (const nlohmann::json& one : answer.at("answers")) told_.push_back(told_of(one));
      }
    }
    if (seq != last_seq_) {
      throw std::runtime_error("gridcull: frame " + std::to_string(last_seq_) + " got another's answer");
    }
    seq_ = seq;
    auto at = answers_.begin();  // mostly the same viewers as before
    for (const Told& told : told_) {
      Ids& seen = seen_[told.viewer];
      seen = told.full ? told.visible : changed(seen, told);
      while (at != answers_.end() && at->first < told.viewer) at = answers_.erase(at);
      if (at == answers_.end() || at->first != told.viewer) at = answers_.emplace_hint(at, told.viewer, Ids{});
      at->second = seen;
      ++at;
    }
    answers_.erase(at, answers_.end());
    return answers_;
  }

  /// What a viewer is told: all that it sees, or what that is more and less than before.
  struct Told {
    std::uint32_t viewer = 0;
    bool full = false;
    Ids visible{}, added{}, removed{};
  };

  static Told told_of(const nlohmann::json& json) {
    Told told{.viewer = json.at("viewer").get<std::uint32_t>(), .full = json.contains("visible")};
    if (told.full) {
      told.visible = ids_of(json.at("visible"));
    } else {
      told.added = ids_of(json.at("added"));
      told.removed = ids_of(json.at("removed"));
    }
    return told;
  }

  static Ids changed(const Ids& before, const Told& told) {
    Ids kept, all;
    std::set_difference(before.begin(), before.end(), told.removed.begin(), told.removed.end(),
                        std::back_inserter(kept));
    std::set_union(kept.begin(), kept.end(), told.added.begin(), told.added.end(), std::back_inserter(all));
    return all;
  }

  /// Reads a frame's answer as the server writes it, without a tree of all its values: items of known length, ids in
  /// byte strings. Whatever it does not know is left to such a tree.
  class Unpacker {
   public:
    explicit Unpacker(std::span<const std::uint8_t> bytes) : left_(bytes) {}

    /// False for anything else than such a "pvs"; `out` is reused.
    bool answers(std::uint64_t& seq, std::vector<Told>& out) {
      std::uint64_t count = 0;
      if (!expect(5, 4) || !text("type") || !text("pvs") || !text("seq") || !head(0, seq)) return false;
      if (!text("time") || !skip_float() || !text("answers") || !head(4, count)) return false;
      if (count > left_.size()) return false;
      out.resize(count);
      for (Told& told : out) {
        if (!answer(told)) return false;
      }
      return left_.empty();
    }

   private:
    bool answer(Told& told) {
      std::uint64_t pairs = 0, viewer = 0;
      if (!head(5, pairs) || !text("viewer") || !head(0, viewer) || viewer > 0xFFFF'FFFF) return false;
      told.viewer = static_cast<std::uint32_t>(viewer);
      told.full = pairs == 2;
      if (told.full) return text("visible") && ids(told.visible);
      return pairs == 3 && text("added") && ids(told.added) && text("removed") && ids(told.removed);
    }

    bool ids(Ids& out) {
      std::uint64_t size = 0;
      if (!head(2, size) || size > left_.size() || size % 4 != 0) return false;
      out.resize(size / 4);
      if (size > 0) std::memcpy(out.data(), left_.data(), size);
      left_ = left_.subspan(size);
      return true;
    }

    bool text(std::string_view expected) {
      if (!expect(3, expected.size()) || left_.size() < expected.size()) return false;
      const bool same = std::memcmp(left_.data(), expected.data(), expected.size()) == 0;
      left_ = left_.subspan(expected.size());
      return same;
    }

    bool expect(unsigned major, std::uint64_t value) {
      std::uint64_t found = 0;
      return head(major, found) && found == value;
    }

    bool head(unsigned major, std::uint64_t& value) {
      if (left_.empty() || left_[0] >> 5 != major) return false;
      const unsigned info = left_[0] & 31u;
      const std::size_t size = info < 24 ? 0 : std::size_t{1} << (info - 24);
      if (info > 27 || left_.size() <= size) return false;
      value = info < 24 ? info : 0;
      for (std::size_t i = 0; i < size; ++i) value = value << 8 | left_[1 + i];
      left_ = left_.subspan(1 + size);
      return true;
    }

    bool skip_float() {
      const std::size_t size = left_.empty() ? 0 : left_[0] == 0xFA ? 5 : left_[0] == 0xFB ? 9 : 0;
      if (size == 0 || left_.size() < size) return false;
      left_ = left_.subspan(size);
      return true;
    }

    std::span<const std::uint8_t> left_;
  };

  using Stream = boost::beast::websocket::stream<boost::asio::ip::tcp::socket>;

  void connect() {
    stream_ = std::make_unique<Stream>(context_);
    boost::asio::ip::tcp::resolver resolver(context_);
    boost::asio::connect(stream_->next_layer(), resolver.resolve(address_, std::to_string(port_)));
    stream_->next_layer().set_option(boost::asio::ip::tcp::no_delay(true));
    stream_->read_message_max(0);
    stream_->auto_fragment(false);
    stream_->write_buffer_bytes(std::size_t{1} << 16);  // masked and sent at a time
    stream_->handshake(address_ + ":" + std::to_string(port_), "/v1/stream");
  }

  /// The head of a CBOR item: its major type, and its value or size.
  void put_head(unsigned major, std::uint64_t value) {
    const auto lead = static_cast<std::uint8_t>(major << 5);
    if (value < 24) return last_.push_back(static_cast<std::uint8_t>(lead | value));
    last_.push_back(lead | 27u);
    for (int shift = 56; shift >= 0; shift -= 8) last_.push_back(static_cast<std::uint8_t>(value >> shift));
  }
  void put_key(std::string_view key) {
    put_head(3, key.size());
    last_.insert(last_.end(), key.begin(), key.end());
  }
  /// A member of the frame's message.
  void put(std::string_view key, const nlohmann::json& value) {
    put_key(key);
    nlohmann::json::to_cbor(value, nlohmann::detail::output_adapter<std::uint8_t>(last_));
  }
  template <class Number>
  void put_bytes(std::string_view key, std::span<const Number> numbers) {
    static_assert(std::endian::native == std::endian::little, "numbers travel as little-endian");
    put_key(key);
    put_head(2, numbers.size_bytes());
    const auto* first = reinterpret_cast<const std::uint8_t*>(numbers.data());
    last_.insert(last_.end(), first, first + numbers.size_bytes());
  }

  static Ids ids_of(const nlohmann::json& json) {
    if (!json.is_binary()) return json.get<Ids>();
    const std::vector<std::uint8_t>& bytes = json.get_binary();
    Ids ids(bytes.size() / 4);
    for (std::size_t i = 0; i < bytes.size(); ++i) ids[i / 4] |= std::uint32_t{bytes[i]} << (8 * (i % 4));
    return ids;
  }

  std::string address_;
  std::uint16_t port_;
  boost::asio::io_context context_;
  std::unique_ptr<Stream> stream_;
  std::string session_, token_;
  std::uint64_t seq_ = 0;
  std::vector<std::uint8_t> last_;  // the last frame's message
  std::uint64_t last_seq_ = 0;
  boost::beast::flat_buffer incoming_;
  std::vector<Told> told_;  // the last answer, kept for its memory
  std::map<std::uint32_t, Ids> seen_;
  Answers answers_;
};

}  // namespace gridcull
