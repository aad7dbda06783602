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
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
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

  /// Tells a frame; empty with Reply::none.
  Answers frame(const Frame& frame, Reply reply = Reply::delta) {
    nlohmann::json message = frame.rest;
    message["type"] = "frame";
    message["seq"] = seq_ + 1;
    message["time"] = frame.time;
    message["bulk"] = true;
    message["reply"] = reply == Reply::full ? "full" : reply == Reply::delta ? "delta" : "none";
    if (!frame.ids.empty()) {
      const bool flat = frame.turns.size() == frame.ids.size();
      message["set_ids"] = bytes_of(std::span(frame.ids));
      message["set_positions64"] = bytes_of(std::span(frame.positions));
      message[flat ? "set_headings64" : "set_orientations64"] = bytes_of(std::span(frame.turns));
    }
    last_ = std::move(message);
    return take_answers(ask(last_));
  }

  /// After reconnect(): sends the last frame again, since nobody knows whether it or its answer was lost, and gives its
  /// answers. The server applies a frame once.
  Answers repeat() { return take_answers(ask(last_)); }

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
    outgoing_.clear();
    nlohmann::json::to_cbor(message, nlohmann::detail::output_adapter<std::uint8_t>(outgoing_));
    stream_->binary(true);
    stream_->write(boost::asio::buffer(outgoing_));
    boost::beast::flat_buffer buffer;
    stream_->read(buffer);
    const std::string text = boost::beast::buffers_to_string(buffer.data());
    nlohmann::json answer = stream_->got_text() ? nlohmann::json::parse(text) : nlohmann::json::from_cbor(text);
    if (answer.at("type") == "error") throw Refusal(answer);
    return answer;
  }

 private:
  Answers take_answers(const nlohmann::json& answer) {
    const auto seq = answer.at("seq").get<std::uint64_t>(), asked = last_.at("seq").get<std::uint64_t>();
    if (seq != asked) throw std::runtime_error("gridcull: frame " + std::to_string(asked) + " got another's answer");
    seq_ = seq;
    Answers out;
    if (answer.at("type") != "pvs") return out;
    for (const nlohmann::json& one : answer.at("answers")) {
      const auto viewer = one.at("viewer").get<std::uint32_t>();
      out[viewer] = seen_[viewer] = take(one, seen_[viewer]);
    }
    return out;
  }

  using Stream = boost::beast::websocket::stream<boost::asio::ip::tcp::socket>;

  void connect() {
    stream_ = std::make_unique<Stream>(context_);
    boost::asio::ip::tcp::resolver resolver(context_);
    boost::asio::connect(stream_->next_layer(), resolver.resolve(address_, std::to_string(port_)));
    stream_->next_layer().set_option(boost::asio::ip::tcp::no_delay(true));
    stream_->read_message_max(0);
    stream_->handshake(address_ + ":" + std::to_string(port_), "/v1/stream");
  }

  template <class Number>
  static nlohmann::json bytes_of(std::span<const Number> numbers) {
    static_assert(std::endian::native == std::endian::little, "numbers travel as little-endian");
    const auto* first = reinterpret_cast<const std::uint8_t*>(numbers.data());
    return nlohmann::json::binary(std::vector<std::uint8_t>(first, first + numbers.size_bytes()));
  }

  static Ids ids_of(const nlohmann::json& json) {
    if (!json.is_binary()) return json.get<Ids>();
    const std::vector<std::uint8_t>& bytes = json.get_binary();
    Ids ids(bytes.size() / 4);
    for (std::size_t i = 0; i < bytes.size(); ++i) ids[i / 4] |= std::uint32_t{bytes[i]} << (8 * (i % 4));
    return ids;
  }

  static Ids take(const nlohmann::json& answer, const Ids& before) {
    if (answer.contains("visible")) return ids_of(answer.at("visible"));
    const Ids added = ids_of(answer.at("added")), removed = ids_of(answer.at("removed"));
    Ids kept, all;
    std::set_difference(before.begin(), before.end(), removed.begin(), removed.end(), std::back_inserter(kept));
    std::set_union(kept.begin(), kept.end(), added.begin(), added.end(), std::back_inserter(all));
    return all;
  }

  std::string address_;
  std::uint16_t port_;
  boost::asio::io_context context_;
  std::unique_ptr<Stream> stream_;
  std::string session_, token_;
  std::uint64_t seq_ = 0;
  std::vector<std::uint8_t> outgoing_;  // kept for its memory
  nlohmann::json last_;                 // the last frame's message
  std::map<std::uint32_t, Ids> seen_;
};

}  // namespace gridcull
