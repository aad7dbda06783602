// The server over real connections: what clients are told, and that nothing that one of them does harms another.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <sys/resource.h>

#include "gridcull/core/error.h"
#include "gridcull/core/hash.h"
#include "gridcull/methods/catalog.h"
#include "gridcull/service/client/gridcull_client.h"
#include "gridcull/service/wire_reply.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/replay.h"
#include "gridcull/sim/stats.h"
#include "gridcull/tests/service/server_fixture.h"
#include "gridcull/tests/sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// What the client says about a generated world, against a replay in this process.
void check_client(const std::string& kind, Client::Reply reply) {
  CAPTURE(kind);
  RunningServer server;
  const auto generator = world_of(kind, 12), told = world_of(kind, 12);
  const Scene& scene = generator->scene();
  MethodOptions options;
  options.dimension = scene.dimension;
  options.bounds = *scene.bounds;
  options.cell = *scene.cell;
  const auto culler = make_method("silhouette", options);
  Replay replay(*culler, scene, generator.get());
  Client client("127.0.0.1", server.port());
  client.open(Json::parse(scene_text(scene)));
  Frame frame;
  while (replay.step()) {
    REQUIRE(told->next(frame));
    Client::Frame out{.time = frame.time};
    for (const ObjectMove& move : frame.set) {
      const Pose& pose = replay.world().object(move.id).pose;
      const Quat& q = pose.orientation;
      if (scene.dimension == 2) {
        out.move(move.id, {pose.position.x, pose.position.y}, move.heading.value_or(heading_of(q)));
      } else {
        out.move(move.id, {pose.position.x, pose.position.y, pose.position.z}, {q.w, q.x, q.y, q.z});
      }
    }
    const Client::Answers answers = client.frame(out, reply);
    for (const Answer& answer : replay.answers().views) {
      REQUIRE(answers.contains(answer.viewer));
      CHECK(answers.at(answer.viewer) == answer.visible);
    }
  }
  client.close();
}

}  // namespace

TEST_CASE("the client is told what a replay says, in 2D and 3D, in full and in deltas") {
  check_client("town", Client::Reply::delta);
  check_client("town", Client::Reply::full);
  check_client("city", Client::Reply::delta);
}

TEST_CASE("docs/service.md names every code that a client may be told") {
  std::ifstream file(GRIDCULL_SOURCE_DIR "/docs/service.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (int code = 0; code <= static_cast<int>(ErrorCode::internal); ++code) {
    const std::string name = wire_error(Error(static_cast<ErrorCode>(code), "no matter")).code;
    CAPTURE(name);
    const std::string row = "\n| `" + name + "`", second = ", `" + name + "` |";
    CHECK((text.find(row) != std::string::npos || text.find(second) != std::string::npos));
  }
}

TEST_CASE("plain HTTP: health, metrics, sessions, the page, and nothing else") {
  RunningServer server;
  RawSocket client(server.port());
  client.ask(open_message());
  client.ask(frame_message(1));
  CHECK(http_get(server.port(), "/healthz").body == "ok");
  const std::string metrics = http_get(server.port(), "/metrics").body;
  CHECK(metrics.find("\ngridcull_frames_total 1\n") != std::string::npos);
  CHECK(metrics.find("\ngridcull_queries_total 4\n") != std::string::npos);
  CHECK(metrics.find("\ngridcull_sessions 1\n") != std::string::npos);
  const Json sessions = Json::parse(http_get(server.port(), "/v1/sessions").body).at("sessions");
  REQUIRE(sessions.size() == 1);
  CHECK(sessions[0].at("seq") == 1);
  CHECK_FALSE(sessions[0].contains("token"));
  CHECK(http_get(server.port(), "/").body.find("<html") != std::string::npos);
  CHECK(http_get(server.port(), "/etc/passwd").status == 404);
  CHECK(http_get(server.port(), "/", "http://elsewhere.example").status == 403);
}

TEST_CASE("plain HTTP says what it takes instead") {
  RunningServer server;
  for (const auto method : {beast::http::verb::post, beast::http::verb::delete_, beast::http::verb::options}) {
    const Page refused = http_ask(method, server.port(), "/healthz");
    CHECK(refused.status == 405);
    CHECK(refused.allow == "GET, HEAD");
  }
  const Page stream = http_get(server.port(), "/v1/stream");
  CHECK(stream.status == 426);
  CHECK(stream.upgrade == "websocket");
  CHECK(stream.body == "expected a WebSocket (gridcull.wire/1)\n");
}

TEST_CASE("what is no HTTP, or too much of it, is told so") {
  RunningServer server;
  const std::string host = "Host: 127.0.0.1\r\n";
  const std::vector<std::pair<std::string, unsigned>> sent{
      {"\x16\x03\x01 garbage\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\nno colon here\r\n\r\n", 400},
      {"GET / HTTP/9.9\r\n" + host + "\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "Content-Length: many\r\n\r\n", 400},
      {"GET / HTTP/1.1\r\n" + host + "X: " + std::string(20'000, 'x'), 431},
      {"POST / HTTP/1.1\r\n" + host + "Content-Length: 1000000\r\n\r\n", 413}};
  for (const auto& [text, status] : sent) {
    INFO(text.substr(0, 60));
    boost::asio::io_context context;
    Tcp::socket socket = connected(context, server.port());
    boost::asio::write(socket, boost::asio::buffer(text));
    beast::flat_buffer buffer;
    beast::http::response<beast::http::string_body> told;
    beast::error_code fault;
    beast::http::read(socket, buffer, told, fault);
    CHECK_FALSE(fault);
    CHECK(told.result_int() == status);
    CHECK_FALSE(told.keep_alive());
    CHECK(told.body().find("expected an HTTP request") == 0);
  }
  CHECK(http_get(server.port(), "/healthz").status == 200);
}

TEST_CASE("a method or option that cannot be is refused by its place in the message") {
  RunningServer server;
  RawSocket client(server.port());
  const auto refused = [&](const Json& change) {
    Json message = open_message();
    message.update(change);
    const Json answer = client.ask(message);
    CAPTURE(answer.dump());
    CHECK(answer.at("type") == "error");
    CHECK(answer.at("message").get<std::string>().find("--") == std::string::npos);
    return answer.value("code", "") + " " + answer.value("pointer", "");
  };
  CHECK(refused({{"method", "magic"}}) == "bad_message /method");
  CHECK(refused({{"options", {{"tbv", "square"}}}}) == "bad_message /options/tbv");
  CHECK(refused({{"options", {{"resolution", 7}}}}) == "bad_message /options/resolution");
  CHECK(refused({{"options", {{"bounds", "ball"}}}}) == "bad_message /options/bounds");
  CHECK(refused({{"options", {{"cell", 1e-6}}}}) == "limit /options/cell");
}

TEST_CASE("a lost connection loses nothing: resume, and answers again") {
  RunningServer server;
  RawSocket first(server.port());
  const Json opened = first.ask(open_message());
  Json moved = frame_message(1);
  moved["reply"] = "delta";
  const Json answer = first.ask(moved);
  CHECK(answer.at("answers")[0].contains("visible"));
  first.drop();
  RawSocket second(server.port());
  const Json resumed =
      second.ask({{"type", "resume"}, {"session", opened.at("session")}, {"token", opened.at("token")}});
  CHECK(resumed == Json{{"type", "resumed"}, {"seq", 1}});
  CHECK(second.ask(moved).at("answers") == answer.at("answers"));  // not applied twice: its time does not go back
  Json next = frame_message(2);
  next["reply"] = "delta";
  CHECK(second.ask(next).at("answers")[0].contains("added"));
  // Somebody else with the token takes it over; the one before is told so.
  RawSocket third(server.port());
  third.ask({{"type", "resume"}, {"session", opened.at("session")}, {"token", opened.at("token")}});
  CHECK(second.wait_for_close() == 1008);
  CHECK(third.ask(frame_message(3)).at("type") == "pvs");
  RawSocket thief(server.port());
  CHECK(thief.ask({{"type", "resume"}, {"session", opened.at("session")}, {"token", "guess"}}).at("code") ==
        "forbidden");
  CHECK(thief.ask({{"type", "resume"}, {"session", "none"}, {"token", "guess"}}).at("code") == "forbidden");
  CHECK(third.ask({{"type", "close"}}).at("type") == "closed");
  CHECK(thief.ask({{"type", "resume"}, {"session", opened.at("session")}, {"token", opened.at("token")}}).at("code") ==
        "forbidden");
}

TEST_CASE("a session waits for its client as long as it is told to, not longer") {
  ServerOptions options;
  options.keep = std::chrono::seconds(0);
  RunningServer server(options);
  RawSocket first(server.port());
  const Json opened = first.ask(open_message());
  first.drop();
  std::string code;
  for (int i = 0; i < 40 && code != "forbidden"; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (Json::parse(http_get(server.port(), "/v1/sessions").body).at("sessions").empty()) code = "forbidden";
  }
  CHECK(code == "forbidden");
}

TEST_CASE("limits and tokens: each refusal has its code, and the connection lives on") {
  ServerOptions options;
  options.max_sessions = 1;
  options.max_objects = 50;
  options.token = "sesame";
  options.max_memory = 1 << 20;
  RunningServer server(options);
  RawSocket client(server.port());
  CHECK(client.ask(open_message()).at("code") == "forbidden");
  CHECK(client.ask(open_message()).at("pointer") == "/token");
  Json open = open_message();
  open["token"] = "sesame";
  Json many = open;
  for (int i = 0; i < 60; ++i) {
    many["scene"]["objects"].push_back(
        {{"id", 9000 + i}, {"shape", {{"type", "disc"}, {"radius", 1}}}, {"position", {1, 1}}});
  }
  CHECK(client.ask(many).at("code") == "limit");
  Json fine = open;
  fine["options"]["cell"] = 0.01;
  CHECK(client.ask(fine).at("code") == "limit");
  const Json opened = client.ask(open);
  CHECK(opened.at("type") == "opened");
  CHECK(client.ask(open).at("code") == "sequence");
  RawSocket other(server.port());
  CHECK(other.ask(open).at("code") == "limit");
  CHECK(other.ask(frame_message(1)).at("code") == "sequence");
  CHECK(other.ask({{"type", "watch"}, {"session", opened.at("session")}}).at("code") == "forbidden");
  CHECK(other.ask({{"type", "watch"}, {"session", opened.at("session")}, {"token", "sesame"}}).at("type") ==
        "watching");
  CHECK(other.ask({{"type", "sing"}}).at("code") == "bad_message");
  client.ask(frame_message(1));
  CHECK(other.receive().at("type") == "step");
  CHECK(client.ask({{"type", "close"}}).at("type") == "closed");
  CHECK(other.receive().at("type") == "ended");
  CHECK(other.ask({{"type", "explain"}, {"viewer", 1}, {"object", 0}}).at("code") == "sequence");
  Json named = open;
  named["name"] = std::string(201, 'x');
  CHECK(other.ask(named).at("pointer") == "/name");
  CHECK(other.ask(open).at("type") == "opened");
}

TEST_CASE("a page from elsewhere whose name points here learns nothing, by whatever request") {
  RunningServer server;
  const auto status = [&](const std::string& host) { return http_get(server.port(), "/v1/sessions", "", host).status; };
  const std::string at = ":" + std::to_string(server.port());
  CHECK(status("localhost" + at) == 200);
  CHECK(status("127.0.0.1" + at) == 200);
  CHECK(status("elsewhere.example" + at) == 403);
  CHECK(status("elsewhere.example") == 403);
  CHECK(status("localhost") == 200);
}

TEST_CASE("pages from elsewhere may not connect, unless they are named") {
  ServerOptions options;
  options.allowed_origins = {"https://map.example"};
  RunningServer server(options);
  CHECK_THROWS(RawSocket(server.port(), "https://elsewhere.example"));
  CHECK_THROWS(RawSocket(server.port(), "http://elsewhere.example:" + std::to_string(server.port())));
  CHECK_NOTHROW(RawSocket(server.port(), "https://map.example"));
  CHECK_NOTHROW(RawSocket(server.port(), "http://localhost:" + std::to_string(server.port())));
}

TEST_CASE("many sessions at once answer as one alone does") {
  ServerOptions options;
  options.threads = 4;
  RunningServer server(options);
  std::atomic<int> wrong = 0, answered = 0;
  const auto one = [&] {
    RawSocket client(server.port());
    client.ask(open_message());
    Json first;
    for (std::uint64_t seq = 1; seq <= 30; ++seq) {
      const Json answers = client.ask(frame_message(seq)).at("answers");
      if (seq == 1) first = answers;
      wrong += answers != first;  // nothing moves
      ++answered;
    }
  };
  std::vector<std::thread> clients;
  for (int i = 0; i < 8; ++i) clients.emplace_back(one);
  for (std::thread& client : clients) client.join();
  CHECK(answered == 240);
  CHECK(wrong == 0);
}

TEST_CASE("a watcher sees the world, each frame, what a viewer's walk met, and why") {
  RunningServer server;
  RawSocket client(server.port());
  const Json opened = client.ask(open_message());
  client.ask(frame_message(1));
  RawSocket watcher(server.port());
  const Json watch{{"type", "watch"}, {"session", opened.at("session")}};
  const Json world = watcher.ask(watch);
  CHECK(world.at("seq") == 1);
  CHECK(watcher.receive().at("seq") == 1);  // what there is to see already
  CHECK(world.at("scene").at("objects").size() == open_message()["scene"]["objects"].size());
  const Json answer = client.ask(frame_message(2));
  Json step = watcher.receive();
  CHECK(step.at("seq") == 2);
  CHECK(step.at("answers") == answer.at("answers"));
  CHECK(step.at("views").size() == answer.at("answers").size());
  CHECK_FALSE(step.contains("drawn"));
  Json choose = watch;
  choose["viewer"] = answer.at("answers")[0].at("viewer");
  CHECK(watcher.ask(choose).at("type") == "watching");
  CHECK(watcher.receive().at("seq") == 2);
  client.ask(frame_message(3));
  step = watcher.receive();
  CHECK(step.at("drawn").at("viewer") == choose["viewer"]);
  CHECK(step.at("drawn").at("cells").contains("visited"));
  CHECK(step.at("drawn").at("region").size() > 10);
  const Json seen = answer.at("answers")[0].at("visible")[0];
  const Json why = watcher.ask({{"type", "explain"}, {"viewer", choose["viewer"]}, {"object", seen}});
  CHECK(why.at("verdict") == "visible");
  CHECK(watcher.ask(frame_message(4)).at("code") == "sequence");  // watching is all it may do
  CHECK(client.ask(frame_message(4)).at("type") == "pvs");
}

TEST_CASE("a server that stops says so, after the answer in hand") {
  RunningServer server;
  RawSocket client(server.port()), idle(server.port());
  client.ask(open_message());
  client.send(frame_message(1));
  CHECK(client.receive().at("type") == "pvs");
  std::thread stopper([&] { server.stop(); });
  CHECK(client.wait_for_close() == 1001);
  CHECK(idle.wait_for_close() == 1001);
  stopper.join();
}

TEST_CASE("a session whose record cannot be written is not opened, and leaves nothing") {
  const TemporaryFolder folder;
  ServerOptions options;
  options.record = folder.file("records");
  RunningServer server(options);
  RawSocket client(server.port());
  // No file may grow beyond its first bytes.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const rlimit full{100, before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &full) == 0);
  const Json refused = client.ask(open_message());
  REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  CHECK(refused.at("code") == "internal");
  CHECK(std::filesystem::is_empty(options.record));
  CHECK(client.ask(open_message()).at("type") == "opened");
}

TEST_CASE("a record is the session: it replays to the same answers") {
  const TemporaryFolder folder;
  ServerOptions options;
  options.record = folder.file("records");
  RunningServer server(options);
  RawSocket client(server.port());
  const Json opened = client.ask(open_message());
  for (std::uint64_t seq = 1; seq <= 5; ++seq) client.ask(frame_message(seq));
  const std::string session = options.record + "/" + opened.at("session").get<std::string>();
  const Scene scene = read_scene(session + "/scene.json");
  FrameReader frames(session + "/frames.jsonl", 2);
  MethodOptions method;
  method.bounds = *scene.bounds;
  method.cell = *scene.cell;
  const auto culler = make_method("silhouette", method);
  Replay replay(*culler, scene, &frames);
  StableHash hash;
  int steps = 0;
  for (; replay.step(); ++steps) {
    for (const Answer& answer : replay.answers().views) hash.add(answer);
  }
  CHECK(steps == 5);
  const Json listed = Json::parse(http_get(server.port(), "/v1/sessions").body).at("sessions")[0];
  CHECK(listed.at("pvs_hash") == hash_text(hash.value()));
}

TEST_CASE("who has an answer finds its frame counted, in the list of sessions and in the metrics") {
  ServerOptions options;
  options.threads = 2;
  RunningServer server(options);
  RawSocket client(server.port());
  client.ask(open_message());
  for (std::uint64_t seq = 1; seq <= 300; ++seq) {
    client.ask(frame_message(seq));
    const Json listed = Json::parse(http_get(server.port(), "/v1/sessions").body).at("sessions")[0];
    REQUIRE(listed.at("seq") == seq);
    const std::string counted = "\ngridcull_frames_total " + std::to_string(seq) + "\n";
    REQUIRE(http_get(server.port(), "/metrics").body.find(counted) != std::string::npos);
  }
}

TEST_CASE("an audit judges answers in the background and finds nothing amiss") {
  ServerOptions options;
  options.audit = 1.0;
  RunningServer server(options);
  RawSocket client(server.port());
  client.ask(open_message());
  Json answer;
  for (std::uint64_t seq = 1; seq <= 5; ++seq) answer = client.ask(frame_message(seq)).at("answers")[0];
  const Json viewer = answer.at("viewer");
  const std::size_t seen = answer.at("visible").size();  // a town in 2D: what is reported is what is seen
  bool judged = false;
  for (int i = 0; i < 100 && !judged; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    judged =
        http_get(server.port(), "/metrics").body.find("\ngridcull_audited_answers_total 20\n") != std::string::npos;
  }
  CHECK(judged);
  // Who watches is told the size of the exact set.
  RawSocket watcher(server.port());
  const Json sessions = Json::parse(http_get(server.port(), "/v1/sessions").body).at("sessions");
  watcher.ask({{"type", "watch"}, {"session", sessions[0].at("session")}, {"viewer", viewer}});
  watcher.receive();
  client.ask(frame_message(6));
  CHECK(watcher.receive().at("exact") == seen);
  CHECK(http_get(server.port(), "/metrics").body.find("\ngridcull_audit_missed_objects_total 0\n") !=
        std::string::npos);
}
