// What comes from outside and is wrong, or slow, or too much: each is refused or cut off by its own name, and those who
// are there go on.
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/sim/stats.h"
#include "gridcull/tests/service/server_fixture.h"

using namespace gridcull;
using namespace gridcull::test;

/// The address sanitizer holds the last 256 MB back.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool keeps_what_is_freed = true;
#else
constexpr bool keeps_what_is_freed = false;
#endif

TEST_CASE("nothing that a client sends harms another") {
  ServerOptions options;
  options.max_message = 200'000;
  RunningServer server(options);
  RawSocket good(server.port());
  good.ask(open_message());
  std::uint64_t seq = 0;
  const auto good_lives = [&] { CHECK(good.ask(frame_message(++seq)).at("type") == "pvs"); };
  const auto refused = [&](std::string_view bytes, bool text, const char* code, const char* why) {
    RawSocket bad(server.port());
    bad.send_bytes(bytes, text);
    const Json answer = bad.receive();
    CHECK(answer.at("type") == "error");
    CHECK(answer.at("code") == code);
    CAPTURE(answer.at("message"));
    CHECK(answer.at("message").get<std::string>().find(why) != std::string::npos);
    CHECK(bad.ask(Json{{"type", "none"}}).at("code") == "bad_message");  // and goes on
    good_lives();
  };
  SUBCASE("JSON 10,000 deep, well-formed but for that") {
    const std::string deep = std::string(10'000, '[') + std::string(10'000, ']');
    refused(deep, true, "bad_message", "nested at most 32 deep");
    refused(R"({"type": "open", "scene": )" + deep + "}", true, "bad_message", "nested at most 32 deep");
  }
  SUBCASE("CBOR 100,000 deep, well-formed but for that") {
    refused(std::string(100'000, '\x81') + '\0', false, "bad_message", "at most 32 levels");
  }
  SUBCASE("CBOR of nested chunks") {
    refused(std::string(100'000, '\x7f'), false, "bad_message", "a string of known length");
  }
  SUBCASE("CBOR whose lengths lie") {
    refused("\xa1\x64type\x7b\x7f\xff\xff\xff\xff\xff\xff\xff", false, "bad_message",
            "expected 9223372036854775807 bytes, found 0");
    refused("\xa1\x64type\x9b\x7f\xff\xff\xff\xff\xff\xff\xff", false, "bad_message",
            "no more items than there are bytes");
  }
  SUBCASE("CBOR with text that is not UTF-8") {
    refused("\xa1\x64type\x62\xff\xfe", false, "bad_message", "expected UTF-8");
  }
  SUBCASE("nothing") { refused("", true, "bad_message", "expected JSON"); }
  SUBCASE("a frame without a session") { refused(frame_message(1).dump(), true, "sequence", "\"open\""); }
  SUBCASE("text that is not UTF-8") {
    RawSocket bad(server.port());
    bad.send_bytes("\"\xff\xfe\"");
    CHECK(bad.wait_for_close() == 1007);
    good_lives();
  }
  SUBCASE("every truncation of a valid message of each type") {
    Json open = open_message();
    open["scene"]["objects"].erase(open["scene"]["objects"].begin() + 3, open["scene"]["objects"].end());
    open["scene"]["viewers"] = Json::array();
    Json frame = frame_message(1), bulk = frame;
    frame["set"] = {{{"id", 0}, {"position", {1.5, 2}}}};
    frame["remove"] = {1};
    bulk["set_ids"] = Json::binary({0, 0, 0, 0, 2, 0, 0, 0});
    bulk["set_positions64"] = Json::binary(std::vector<std::uint8_t>(32));
    const Json key = {{"session", "a"}, {"token", "b"}};
    RawSocket bad(server.port());
    const auto cut = [&](std::string_view bytes, bool text) {
      for (std::size_t n = 0; n < bytes.size(); ++n) {
        bad.send_bytes(bytes.substr(0, n), text);
        REQUIRE(bad.receive().at("code") == "bad_message");
      }
    };
    for (Json message : {open, frame, bulk, Json{{"type", "resume"}}, Json{{"type", "watch"}}, Json{{"type", "close"}},
                         Json{{"type", "explain"}, {"viewer", 1}, {"object", 9}}}) {
      if (message.size() == 1 && message["type"] != "close") message.update(key);
      const std::vector<std::uint8_t> cbor = Json::to_cbor(message);
      cut({reinterpret_cast<const char*>(cbor.data()), cbor.size()}, false);
      if (message != bulk) cut(message.dump(), true);
    }
    CHECK(bad.ask(open).at("type") == "opened");
    const std::vector<std::uint8_t> whole = Json::to_cbor(bulk);
    bad.send_bytes({reinterpret_cast<const char*>(whole.data()), whole.size()}, false);
    CHECK(bad.receive().at("type") == "pvs");
    good_lives();
  }
  SUBCASE("a message over the limit") {
    RawSocket bad(server.port());
    bad.send_bytes(std::string(300'000, ' '));
    CHECK(bad.receive().at("code") == "limit");
    CHECK(bad.wait_for_close() == 1009);
    good_lives();
  }
  SUBCASE("a gigabyte announced, of which a little comes") {
    RawSocket bad(server.port());
    const std::string head("\x82\xff\0\0\0\0\x40\0\0\0abcd", 14);  // binary, masked, 2^30 bytes
    boost::asio::write(bad.socket(), boost::asio::buffer(head));
    boost::asio::write(bad.socket(), boost::asio::buffer(std::string(250'000, 'x')));
    CHECK(bad.receive().at("code") == "limit");
    good_lives();
  }
  SUBCASE("gigabytes announced, of which nearly nothing comes") {
    const std::uint64_t before = resident_bytes();
    std::vector<std::unique_ptr<RawSocket>> all;
    for (int i = 0; i < 30; ++i) {
      all.push_back(std::make_unique<RawSocket>(server.port()));
      const std::string head("\x82\xff\0\0\0\1\0\0\0\0abcd some of it", 25);  // 2^32 bytes
      boost::asio::write(all.back()->socket(), boost::asio::buffer(head));
    }
    for (int i = 0; i < 20; ++i) good_lives();
    if (!keeps_what_is_freed) CHECK(resident_bytes() < before + 50'000'000);
  }
  SUBCASE("a client that goes in the middle of a message") {
    for (int i = 0; i < 20; ++i) {
      RawSocket bad(server.port());
      const std::string head("\x81\xfe\x01\0abcd{\"type", 14);
      boost::asio::write(bad.socket(), boost::asio::buffer(head));
      bad.drop();
    }
    good_lives();
    CHECK(becomes(server.port(), "gridcull_connections 1"));  // they are forgotten
  }
  SUBCASE("a client that goes in the middle of a frame: it was not applied, and may be sent again") {
    RawSocket first(server.port());
    const Json opened = first.ask(open_message());
    first.ask(frame_message(1));
    const std::string text = frame_message(2).dump();
    const std::string head{'\x81', static_cast<char>(0x80 | text.size()), 0, 0, 0, 0};  // masked by zeros
    boost::asio::write(first.socket(), boost::asio::buffer(head + text.substr(0, text.size() - 1)));
    first.drop();
    RawSocket second(server.port());
    const Json resumed =
        second.ask({{"type", "resume"}, {"session", opened.at("session")}, {"token", opened.at("token")}});
    CHECK(resumed.at("seq") == 1);
    CHECK(second.ask(frame_message(2)).at("type") == "pvs");
    good_lives();
  }
  SUBCASE("bytes that are no HTTP") {
    boost::asio::io_context context;
    for (int i = 0; i < 20; ++i) {
      Tcp::socket socket = connected(context, server.port());
      boost::asio::write(socket, boost::asio::buffer(std::string("\x16\x03\x01\x02\0 garbage\r\n\r\n", 17)));
    }
    good_lives();
  }
  CHECK(http_get(server.port(), "/healthz").status == 200);
}

TEST_CASE("unfinished messages have room for eight of the greatest, from all together") {
  ServerOptions options;
  options.max_message = 2'000'000;
  RunningServer server(options);
  RawSocket good(server.port());
  good.ask(open_message());
  // A binary message's first part of 1,950,000 bytes, masked, with more to come.
  const std::string part = std::string{'\x02', '\xff', 0, 0, 0, 0, 0, '\x1d', '\xc1', '\x30', 'a', 'b', 'c', 'd'} +
                           std::string(1'950'000, 'x');
  const std::string end{'\x80', '\x80', 'a', 'b', 'c', 'd'}, ping{'\x89', '\x80', 'a', 'b', 'c', 'd'};
  std::vector<std::unique_ptr<RawSocket>> all;
  for (int i = 0; i < 8; ++i) {
    all.push_back(std::make_unique<RawSocket>(server.port()));
    boost::asio::write(all.back()->socket(), boost::asio::buffer(part));
    // Whoever gets its pong has been read up to there.
    boost::asio::write(all.back()->socket(), boost::asio::buffer(ping));
    std::string pong(2, ' ');
    boost::asio::read(all.back()->socket(), boost::asio::buffer(pong));
    REQUIRE(pong == std::string("\x8a\0", 2));
  }
  RawSocket ninth(server.port());
  boost::asio::write(ninth.socket(), boost::asio::buffer(part + end));
  const Json answer = ninth.receive();
  CHECK(answer.at("code") == "limit");
  CHECK(answer.at("message") == "too many large messages at a time");
  CHECK(ninth.wait_for_close() == 1009);
  CHECK(becomes(server.port(), "gridcull_connections 9"));
  CHECK(good.ask(frame_message(1)).at("type") == "pvs");
  // Their room is there again once they are gone.
  all.clear();
  CHECK(becomes(server.port(), "gridcull_connections 1"));
  RawSocket later(server.port());
  later.send_bytes(std::string(2'000'000, 'x'), false);
  CHECK(later.receive().at("code") == "bad_message");
}

TEST_CASE("whose other end answers no ping is let go; who answers may be silent") {
  ServerOptions options;
  options.idle = std::chrono::seconds(3);
  RunningServer server(options);
  RawSocket good(server.port()), gone(server.port());
  good.ask(open_message());
  const Json opened = gone.ask(open_message());
  unsigned code = 0;
  std::thread reader([&] { code = good.wait_for_close(); });  // who reads answers pings
  const std::string one_left = "gridcull_connections 1";
  CHECK((becomes(server.port(), one_left) || becomes(server.port(), one_left)));
  RawSocket again(server.port());
  const Json resumed =
      again.ask({{"type", "resume"}, {"session", opened.at("session")}, {"token", opened.at("token")}});
  CHECK(resumed.at("seq") == 0);
  server.stop();
  reader.join();
  CHECK(code == 1001);  // it was there to the end
}

TEST_CASE("a flood of connections is cut off; those that are there go on") {
  ServerOptions options;
  options.max_connections = 20;
  RunningServer server(options);
  RawSocket good(server.port());
  good.ask(open_message());
  boost::asio::io_context context;
  std::vector<Tcp::socket> flood;
  for (int i = 0; i < 300; ++i) flood.push_back(connected(context, server.port()));
  CHECK(good.ask(frame_message(1)).at("type") == "pvs");
  // All but those that fitted are at their end.
  std::size_t closed = 0;
  for (int round = 0; round < 100 && closed < 300 - options.max_connections; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    std::erase_if(flood, [&](Tcp::socket& socket) {
      char byte = 0;
      boost::system::error_code fault;
      socket.non_blocking(true);
      socket.read_some(boost::asio::buffer(&byte, 1), fault);
      const bool gone = fault && fault != boost::asio::error::would_block;
      closed += gone;
      return gone;
    });
  }
  CHECK(closed >= 300 - options.max_connections);
  CHECK(good.ask(frame_message(2)).at("type") == "pvs");
  flood.clear();
  bool back = false;
  for (int i = 0; i < 50 && !back; ++i) {
    try {
      back = http_get(server.port(), "/healthz").status == 200;
    } catch (const boost::system::system_error&) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
  CHECK(back);
}

TEST_CASE("a client that takes no answers is not read from, and cut off after a while; its session waits") {
  ServerOptions options;
  options.stall = std::chrono::seconds(1);
  RunningServer server(options);
  RawSocket good(server.port()), slow(server.port());
  good.ask(open_message());
  const Json opened = slow.ask(open_message());
  slow.ask(frame_message(1));
  const std::uint64_t before = resident_bytes();
  slow.socket().non_blocking(true);
  // The same frame over and over, which is answered from memory, until nothing more is taken and then all is over.
  const std::string text = frame_message(1).dump();
  const std::string message = std::string{'\x81', static_cast<char>(0x80 | text.size()), 0, 0, 0, 0} + text;
  // The system's own buffers take some megabytes first, which is slow under a sanitizer. (Their size is left alone: a
  // tiny one drops segments with what they acknowledge, and then the client's own way stalls for minutes.)
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  boost::system::error_code fault;
  bool was_full = false;
  for (std::size_t at = 0; !fault && std::chrono::steady_clock::now() < end;) {
    at += slow.socket().write_some(boost::asio::buffer(message.data() + at, message.size() - at), fault);
    at %= message.size();
    if (fault != boost::asio::error::would_block) continue;
    was_full = true;
    fault = {};
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK(was_full);
  CHECK(fault);
  if (!keeps_what_is_freed) CHECK(resident_bytes() < before + 50'000'000);
  CHECK(becomes(server.port(), "gridcull_slow_connections_closed_total 1"));
  CHECK(good.ask(frame_message(1)).at("type") == "pvs");
  RawSocket again(server.port());
  const Json resumed =
      again.ask({{"type", "resume"}, {"session", opened.at("session")}, {"token", opened.at("token")}});
  CHECK(resumed.at("seq") == 1);
  CHECK(again.ask(frame_message(2)).at("type") == "pvs");
}

TEST_CASE("a watcher that does not read is let go; the session does not notice") {
  RunningServer server;
  RawSocket client(server.port());
  const Json opened = client.ask(open_message());
  RawSocket watcher(server.port());
  watcher.ask({{"type", "watch"}, {"session", opened.at("session")}});
  // Frames full of moves, so that the sockets' own buffers fill.
  Json moves = Json::array();
  const Json open = open_message();
  for (const Json& object : open["scene"]["objects"]) {
    moves.push_back({{"id", object["id"]}, {"position", object["position"]}});
  }
  std::uint64_t seq = 0;
  bool closed = false;
  while (!closed && seq < 5000) {
    Json frame = frame_message(++seq);
    frame["set"] = moves;
    REQUIRE(client.ask(frame).at("type") == "pvs");
    if (seq % 100 == 0) {
      closed = http_get(server.port(), "/metrics").body.find("\ngridcull_slow_connections_closed_total 1\n") !=
               std::string::npos;
    }
  }
  CHECK(closed);
  CHECK(watcher.wait_for_close() == 1013);
  CHECK(watcher.close_reason() == "too slow to watch");
}
