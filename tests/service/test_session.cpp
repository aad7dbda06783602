// A session of the service, without sockets: the same answers as a replay, refusals that change nothing, answers again.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "gridcull/service/session.h"
#include "gridcull/service/wire_reply.h"
#include "gridcull/sim/generate.h"
#include "gridcull/sim/scene_json.h"

using namespace gridcull;
using Json = nlohmann::ordered_json;

namespace {

constexpr Session::Limits limits{.objects = 1000};

/// A small town that moves, as messages.
struct Town {
  explicit Town(int frames = 20) {
    GenerateOptions options;
    options.count = 40;
    options.viewers = 5;
    options.range = 60.0;
    options.frames = frames;
    const auto generator = make_generator("town", options);
    scene = generator->scene();
    Frame frame;
    while (generator->next(frame)) lines.push_back(frame_text(frame, 2));
  }
  Json open() const { return {{"type", "open"}, {"scene", Json::parse(scene_text(scene))}}; }
  Json frame(std::size_t i, const char* reply = "full") const {
    Json json = Json::parse(lines[i]);
    json["type"] = "frame";
    json["seq"] = i + 1;
    json["reply"] = reply;
    return json;
  }

  Scene scene;
  std::vector<std::string> lines;
};

Session session_of(const Json& open) {
  return Session(read_open(WireRequest(encoded(open, Encoding::json), Encoding::json), 4), limits, "");
}

/// Numbers beside each other, as bulk moves have them.
template <class Number>
Json bytes(const std::vector<Number>& numbers) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(numbers.data());
  return Json::binary(std::vector<std::uint8_t>(first, first + numbers.size() * sizeof(Number)));
}

FrameReply tell(Session& session, const Json& frame, Encoding encoding = Encoding::json) {
  static FrameRequest request;  // as a connection keeps it: nothing of the frame before may show
  const std::string bytes = encoded(frame, encoding);
  read_frame_request(WireRequest(bytes, encoding), session.dimension(), request);
  const FrameReply& reply = session.apply(request);
  CHECK(encoded_frame(reply, Encoding::cbor) == encoded(frame_message(reply), Encoding::cbor));
  return reply;
}

std::string text_of(const FrameReply& reply) { return encoded(frame_message(reply), Encoding::json); }

/// Code and pointer of the refusal, as a client sees them.
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const std::exception& fault) {
    const WireError error = wire_error(fault);
    CHECK(error.message.find('\n') == std::string::npos);
    CHECK(!error.message.empty());
    return error.code + " " + error.pointer;
  }
  return "none";
}

}  // namespace

TEST_CASE("a session answers as a replay does, in full and in deltas") {
  const Town town;
  Session full = session_of(town.open()), delta = session_of(town.open());
  std::map<ViewerId, std::vector<ObjectId>> seen;
  for (std::size_t i = 0; i < town.lines.size(); ++i) {
    const FrameReply a = tell(full, town.frame(i), i % 2 == 0 ? Encoding::json : Encoding::cbor);
    const FrameReply b = tell(delta, town.frame(i, "delta"));
    REQUIRE(a.answers.size() == 5);
    REQUIRE(b.answers.size() == 5);
    for (std::size_t k = 0; k < a.answers.size(); ++k) {
      const ViewerReply& told = b.answers[k];
      CHECK(told.full == (i == 0));
      std::vector<ObjectId>& ids = seen[told.viewer];
      if (told.full) ids = told.visible;
      std::erase_if(ids, [&](ObjectId id) { return std::binary_search(told.removed.begin(), told.removed.end(), id); });
      ids.insert(ids.end(), told.added.begin(), told.added.end());
      std::sort(ids.begin(), ids.end());
      CHECK(ids == a.answers[k].visible);
    }
  }
  CHECK(full.pvs_hash() == delta.pvs_hash());
  CHECK(full.seq() == town.lines.size());
}

TEST_CASE("a frame is answered again, not applied twice; after a resume in full") {
  const Town town;
  Session session = session_of(town.open());
  tell(session, town.frame(0));
  const FrameReply first = tell(session, town.frame(1, "delta"));
  const std::uint64_t hash = session.pvs_hash();
  const FrameReply again = tell(session, town.frame(1, "delta"));
  CHECK(text_of(again) == text_of(first));
  CHECK(session.pvs_hash() == hash);
  CHECK(session.seq() == 2);
  session.resume();
  const FrameReply resumed = tell(session, town.frame(1, "delta"));
  CHECK(resumed.answers[0].full);
  CHECK_FALSE(tell(session, town.frame(2, "delta")).answers[0].full);
  session.resume();
  CHECK(tell(session, town.frame(3, "delta")).answers[0].full);
  CHECK(text_of(tell(session, town.frame(4, "none"))) == R"({"type":"ok","seq":5})");
  CHECK_FALSE(tell(session, town.frame(5, "delta")).answers[0].full);
}

TEST_CASE("a refused frame changes nothing and does not use up its number") {
  const Town town;
  Session session = session_of(town.open()), untouched = session_of(town.open());
  tell(session, town.frame(0));
  tell(untouched, town.frame(0));
  const auto try_frame = [&](const char* key, const Json& value) {
    Json frame = town.frame(1);
    frame[key] = value;
    return refusal([&] { tell(session, frame); });
  };
  CHECK(try_frame("seq", 3) == "sequence /seq");
  CHECK(try_frame("seq", 0) == "sequence /seq");
  CHECK(try_frame("seq", -1) == "bad_message /seq");
  CHECK(try_frame("time", -5.0) == "bad_frame /time");
  CHECK(try_frame("remove", {777}) == "unknown_object /remove/0");
  CHECK(try_frame("set", {{{"id", 777}}}) == "unknown_object /set/0/id");
  CHECK(try_frame("set", {{{"id", 0}}, {{"id", 0}}}) == "bad_frame /set/1");
  CHECK(try_frame("set", {{{"id", 0}, {"position", {1e10, 0}}}}) == "bad_frame /set/0/position/0");
  CHECK(try_frame("add", {{{"id", 900}}}) == "bad_frame /add/0");
  CHECK(try_frame("reply", "some") == "bad_message /reply");
  CHECK(try_frame("bulk", true) == "bad_message /bulk");
  CHECK(try_frame("speed", 1) == "bad_message /speed");
  Json many = Json::array();
  for (int i = 0; i < 1000; ++i) {
    many.push_back({{"id", 10000 + i}, {"shape", {{"type", "disc"}, {"radius", 1}}}, {"position", {i, 0}}});
  }
  CHECK(try_frame("add", many) == "limit ");
  CHECK(session.seq() == 1);
  for (std::size_t i = 1; i < town.lines.size(); ++i) {
    CHECK(text_of(tell(session, town.frame(i))) == text_of(tell(untouched, town.frame(i))));
  }
  CHECK_FALSE(session.broken());
}

TEST_CASE("scenes and options that cannot be are refused with their place in the scene") {
  const Town town;
  const auto try_open = [&](const Json& change) {
    Json open = town.open();
    open.merge_patch(change);
    return refusal([&] { session_of(open); });
  };
  CHECK(try_open({{"scene", {{"dimension", 4}}}}) == "bad_scene /dimension");
  CHECK(try_open({{"scene", {{"format", "gridcull.scene/9"}}}}) == "bad_scene /format");
  CHECK(try_open({{"scene", nullptr}}).starts_with("bad_message"));
  CHECK(try_open({{"method", "guessing"}}) == "bad_message /method");
  CHECK(try_open({{"options", {{"cell", -1}}}}) == "bad_message /options/cell");
  CHECK(try_open({{"options", {{"colour", 1}}}}) == "bad_message /options/colour");
  CHECK(try_open({{"options", {{"threads", 5}}}}) == "bad_message /options/threads");
  CHECK(try_open({{"options", {{"cell", 1e-3}}}}).starts_with("limit"));
  CHECK(try_open({{"options", {{"cell", 4.0}, {"threads", 2}, {"tbv", "solid"}}}}) == "none");
  Json open = town.open();
  open["scene"]["objects"][3]["shape"] = {{"type", "disc"}, {"radius", -1}};
  CHECK(refusal([&] { session_of(open); }) == "bad_scene /objects/3/shape/radius");
}

TEST_CASE("a frame far larger than its world is not kept once it was refused") {
  const Town town;
  Session session = session_of(town.open());
  FrameRequest request;
  const auto send = [&](const Json& frame) {
    const std::string bytes = encoded(frame, Encoding::cbor);
    read_frame_request(WireRequest(bytes, Encoding::cbor), session.dimension(), request);
    session.apply(request);
  };
  Json huge = town.frame(0);
  huge.erase("set");
  huge["set_ids"] = Json::binary(std::vector<std::uint8_t>(4'000'000, 0x77));
  CHECK(refusal([&] { send(huge); }) != "");
  for (std::size_t i = 0; i < 3; ++i) send(town.frame(i));
  CHECK(request.frame.bulk.poses.capacity() < 10'000);
  CHECK(session.last_frame().bulk.poses.capacity() < 10'000);
}

TEST_CASE("bulk moves in CBOR are the moves, bit for bit; what does not fit is refused") {
  const Town town;
  Session by_set = session_of(town.open()), by_bulk = session_of(town.open());
  const auto in_bulk = [&](const Json& frame) {
    std::vector<std::uint32_t> ids;
    std::vector<double> positions, headings;
    for (const Json& move : frame["set"]) {
      ids.push_back(move["id"]);
      for (const double x : move["position"]) positions.push_back(x);
      headings.push_back(move["heading"]);
    }
    Json bulk = frame;
    bulk.erase("set");
    bulk["set_ids"] = bytes(ids);
    bulk["set_positions64"] = bytes(positions);
    bulk["set_headings64"] = bytes(headings);
    bulk["bulk"] = true;
    return bulk;
  };
  std::size_t moved = 0;
  for (std::size_t i = 0; i < town.lines.size(); ++i) {
    Json frame = town.frame(i);
    const FrameReply a = tell(by_set, frame);
    if (frame.contains("set")) {
      for (Json& move : frame["set"]) {
        if (!move.contains("heading")) move["heading"] = 0.0;
      }
      moved += frame["set"].size();
    }
    const bool whole = frame.contains("set") && town.lines[i].find("heading") != std::string::npos;
    const FrameReply b = whole ? tell(by_bulk, in_bulk(frame), Encoding::cbor) : tell(by_bulk, town.frame(i));
    REQUIRE(a.answers.size() == b.answers.size());
    for (std::size_t k = 0; k < a.answers.size(); ++k) CHECK(a.answers[k].visible == b.answers[k].visible);
  }
  CHECK(moved > 0);
  const auto try_bulk = [&](const Json& change) {
    Json frame{{"type", "frame"}, {"seq", town.lines.size() + 1}, {"time", 1e6}};
    frame["set_ids"] = bytes(std::vector<std::uint32_t>{0, 1});
    frame.update(change);
    return refusal([&] { tell(by_bulk, frame, Encoding::cbor); });
  };
  CHECK(try_bulk({{"set_ids", Json::binary({1, 2, 3})}}) == "bad_frame /set_ids");
  CHECK(try_bulk({{"set_ids", bytes(std::vector<std::uint32_t>{4, 4})}}) == "bad_frame /set_ids");
  CHECK(try_bulk({{"set_ids", bytes(std::vector<std::uint32_t>{0xFFFFFFFFu, 4})}}) == "bad_frame /set_ids");
  CHECK(try_bulk({{"set_ids", "text"}}) == "bad_frame /set_ids");
  CHECK(try_bulk({{"set_positions", bytes(std::vector<float>{1, 2, 3})}}) == "bad_frame /set_positions");
  CHECK(try_bulk({{"set_positions", bytes(std::vector<float>{1, 2, 3, NAN})}}) == "bad_frame /set_positions");
  CHECK(try_bulk({{"set_orientations", bytes(std::vector<float>(8, 0.5F))}}) == "bad_frame /set_orientations");
  CHECK(try_bulk({{"set", {{{"id", 0}}}}}) == "bad_frame /set");
  CHECK(try_bulk({{"set_positions", bytes(std::vector<float>{1, 2, 3, 4})}}) == "none");
}

TEST_CASE("moves in bulk are the same moves in a list, whatever else the frame does") {
  const auto disc = [](int id, double x) {
    return Json{{"id", id}, {"shape", {{"type", "box"}, {"size", {4, 2}}}}, {"position", {x, 10}}, {"heading", 0.5}};
  };
  Json scene = {{"format", "gridcull.scene/1"},
                {"dimension", 2},
                {"bounds", {{"min", {0, 0}}, {"max", {100, 20}}}},
                {"grid", {{"cell", 1}}},
                {"objects", Json::array()},
                {"viewers", {{{"id", 1}, {"follows", 4}}, {{"id", 2}, {"position", {50, 1}}}}}};
  for (int id = 0; id < 10; ++id) scene["objects"].push_back(disc(id, 8.0 * id));
  Session by_set = session_of({{"type", "open"}, {"scene", scene}}),
          by_bulk = session_of({{"type", "open"}, {"scene", scene}});
  const Json none = Json::object();
  int seq = 0;
  const auto both = [&](const std::vector<std::uint32_t>& ids, bool places, bool turns, const Json& more) {
    ++seq;
    Json list = Json::array();
    std::vector<double> positions, headings;
    for (const std::uint32_t id : ids) {
      Json move{{"id", id}};
      positions.insert(positions.end(), {8.0 * id + 0.37 * seq, 10 - 0.21 * seq});
      headings.push_back(0.1 * seq * id - 3.0);
      if (places) move["position"] = {positions[positions.size() - 2], positions.back()};
      if (turns) move["heading"] = headings.back();
      list.push_back(move);
    }
    Json frame{{"type", "frame"}, {"seq", seq}, {"time", seq}};
    frame.update(more);
    Json set = frame, bulk = frame;
    set["set"] = list;
    bulk["set_ids"] = bytes(ids);
    if (places) bulk["set_positions64"] = bytes(positions);
    if (turns) bulk["set_headings64"] = bytes(headings);
    CHECK(text_of(tell(by_set, set)) == text_of(tell(by_bulk, bulk, Encoding::cbor)));
    CHECK(frame_text(by_set.last_frame(), 2) == frame_text(by_bulk.last_frame(), 2));
    REQUIRE(by_set.objects() == by_bulk.objects());
    for (const Object& object : by_set.world().objects()) {
      const Pose &a = object.pose, &b = by_bulk.world().object(object.id).pose;
      CHECK(a.position == b.position);
      CHECK(a.orientation.w == b.orientation.w);
      CHECK(a.orientation.z == b.orientation.z);
    }
  };
  both({0, 1, 2, 3}, true, true, none);
  both({0, 1, 2, 3}, true, true, none);       // as before
  both({0, 1, 2}, true, false, none);         // fewer, and what is not told stays
  both({3, 1, 0, 9, 4}, false, true, none);   // in no order
  both({3, 1, 0, 9, 4}, false, false, none);  // nothing told
  both({3, 1, 4}, true, true, {{"remove", {0}}});
  both({3, 1, 0}, true, true, {{"add", {disc(0, 3)}}});  // what is new moves at once
  both({9, 3, 1}, true, true, {{"remove", {0, 2}}, {"add", {disc(0, 5), disc(20, 30)}}});
  both({20, 0}, true, true, {{"viewers", {{{"id", 1}, {"follows", 20}}}}});

  const auto refused = [&](const std::vector<std::uint32_t>& ids, const Json& more) {
    Json frame{{"type", "frame"}, {"seq", seq + 1}, {"time", seq + 1}};
    frame.update(more);
    frame["set_ids"] = bytes(ids);
    frame["set_positions64"] = bytes(std::vector<double>(2 * ids.size(), 15.0));
    return refusal([&] { tell(by_bulk, frame, Encoding::cbor); });
  };
  CHECK(refused({20, 0, 77}, none) == "unknown_object /set_ids");
  CHECK(refused({20, 0, 2}, none) == "unknown_object /set_ids");  // gone
  CHECK(refused({20, 0, 20}, none) == "bad_frame /set_ids");
  CHECK(refused({20, 0}, {{"remove", {0}}}) == "unknown_object /set_ids");
  CHECK(refused({20, 0}, {{"time", 0}}) == "bad_frame /time");
  CHECK_FALSE(by_bulk.broken());
  both({20, 0}, true, true, none);  // they changed nothing
}

// Whoever turns a list into bulk moves must not have to learn other faults.
TEST_CASE("a frame with two faults is refused for the same one, in a list or in bulk") {
  const Town town;
  Session session = session_of(town.open());
  tell(session, town.frame(0));
  const Json shape{{"type", "disc"}, {"radius", 1}};
  struct Moves {
    std::vector<std::uint32_t> ids;
    std::vector<double> places;
  };
  const Moves fine{{0, 1}, {1, 2, 3, 4}}, twice{{0, 1, 0}, {1, 2, 3, 4, 5, 6}}, unknown{{0, 777}, {1, 2, 3, 4}},
      wild{{0, 1}, {1, 2, 1e10, 4}}, twice_and_unknown{{777, 0, 777}, {1, 2, 3, 4, 5, 6}};
  const std::vector<Json> others{Json::object(),
                                 {{"seq", 7}},
                                 {{"time", -5.0}},
                                 {{"remove", {777}}},
                                 {{"add", {{{"id", 0}, {"shape", shape}, {"position", {0, 0}}}}}},
                                 {{"drop_viewers", {777}}},
                                 {{"viewers", {{{"id", 1}, {"follows", 777}}}}},
                                 {{"seq", 7}, {"time", -5.0}}};
  const auto code_of = [](const std::string& refusal) { return refusal.substr(0, refusal.find(' ')); };
  for (const Moves& moves : {fine, twice, unknown, wild, twice_and_unknown}) {
    for (const Json& other : others) {
      if (moves.ids == fine.ids && moves.places == fine.places && other.empty()) continue;  // nothing is wrong
      Json list = town.frame(1), bulk = list;
      bulk.erase("set");
      list["set"] = Json::array();
      for (std::size_t i = 0; i < moves.ids.size(); ++i) {
        list["set"].push_back({{"id", moves.ids[i]}, {"position", {moves.places[2 * i], moves.places[2 * i + 1]}}});
      }
      bulk["set_ids"] = bytes(moves.ids);
      bulk["set_positions64"] = bytes(moves.places);
      list.update(other), bulk.update(other);
      CAPTURE(list.dump());
      const std::string in_list = refusal([&] { tell(session, list, Encoding::cbor); });
      CHECK(code_of(refusal([&] { tell(session, bulk, Encoding::cbor); })) == code_of(in_list));
      // Whatever is not about the moves is named alike.
      if (in_list.find("/set") == std::string::npos) {
        CHECK(refusal([&] { tell(session, bulk, Encoding::cbor); }) == in_list);
      }
    }
  }
  CHECK(session.seq() == 1);
}

TEST_CASE("explain speaks of the last frame") {
  const Town town;
  Session session = session_of(town.open());
  CHECK(refusal([&] { session.explain({40, 0}); }) == "sequence ");
  tell(session, town.frame(0));
  const ViewerId viewer = session.views()[0].viewer;
  CHECK(refusal([&] { session.explain({viewer, 7777}); }) == "unknown_object /object");
  CHECK(refusal([&] { session.explain({7777, 0}); }) == "unknown_object /viewer");
  int visible = 0;
  for (const ObjectId id : session.answers().views[0].visible) {
    visible += session.explain({viewer, id}).verdict == Explanation::Verdict::visible;
  }
  CHECK(visible > 0);
}

TEST_CASE("a viewer that comes back is answered in full, whatever its client still remembers") {
  const auto frame = [](int seq, Json parts) {
    parts.update({{"type", "frame"}, {"seq", seq}, {"time", seq}, {"reply", "delta"}});
    return parts;
  };
  const Json box = {{"id", 0}, {"shape", {{"type", "disc"}, {"radius", 1}}}, {"position", {5, 5}}};
  const Json scene = {
      {"format", "gridcull.scene/1"},
      {"dimension", 2},
      {"bounds", {{"min", {0, 0}}, {"max", {20, 20}}}},
      {"objects", {box, {{"id", 1}, {"shape", {{"type", "disc"}, {"radius", 1}}}, {"position", {9, 5}}}}},
      {"viewers", {{{"id", 7}, {"follows", 0}}}}};
  Session session = session_of({{"type", "open"}, {"scene", scene}});
  CHECK(tell(session, frame(1, {})).answers.at(0).full);
  CHECK_FALSE(tell(session, frame(2, {})).answers.at(0).full);

  // Its object goes while an answer is lost, and comes back two frames later.
  session.resume();
  CHECK(tell(session, frame(3, {{"remove", {0}}})).answers.empty());
  const ViewerReply back = tell(session, frame(4, {{"add", {box}}})).answers.at(0);
  CHECK(back.full);
  CHECK(back.visible == std::vector<ObjectId>{1});
  CHECK_FALSE(tell(session, frame(5, {})).answers.at(0).full);

  // It is dropped and made again; a new one has nothing to differ from.
  tell(session, frame(6, {{"drop_viewers", {7}}}));
  const FrameReply again =
      tell(session, frame(7, {{"viewers", {{{"id", 7}, {"follows", 0}}, {{"id", 8}, {"follows", 1}}}}}));
  CHECK(again.answers.at(0).full);
  CHECK_FALSE(again.answers.at(1).full);
  CHECK(again.answers.at(1).added == std::vector<ObjectId>{0});
}

TEST_CASE("a viewpoint out of the world is refused with the frame or scene that leads there") {
  const Json far = {{"id", 0}, {"shape", {{"type", "disc"}, {"radius", 1}}}, {"position", {9e8, 0}}};
  Json scene = {{"format", "gridcull.scene/1"},
                {"dimension", 2},
                {"bounds", {{"min", {0, 0}}, {"max", {20, 20}}}},
                {"objects", {far}},
                {"viewers", {{{"id", 7}, {"follows", 0}, {"offset", {5e7, 0}}}}}};
  const auto frame = [](int seq, Json parts) {
    parts.update({{"type", "frame"}, {"seq", seq}, {"time", seq}});
    return parts;
  };
  Session session = session_of({{"type", "open"}, {"scene", scene}});
  tell(session, frame(1, {}));
  const auto refused = [&](Json parts) { return refusal([&] { tell(session, frame(2, parts)); }); };
  CHECK(refused({{"set", {{{"id", 0}, {"position", {9.9e8, 0}}}}}}) == "bad_frame ");
  CHECK(refused({{"viewers", {{{"id", 7}, {"offset", {2e8, 0}}}}}}) == "bad_frame /viewers/0");
  CHECK(refused({{"viewers", {{{"id", 8}, {"follows", 0}, {"offset", {2e8, 0}}}}}}) == "bad_frame /viewers/0");
  CHECK_FALSE(session.broken());
  CHECK(tell(session, frame(2, {{"set", {{{"id", 0}, {"position", {9.4e8, 0}}}}}})).answers.size() == 1);
  scene["viewers"][0]["offset"] = {2e8, 0};
  CHECK(refusal([&] { session_of({{"type", "open"}, {"scene", scene}}); }) == "bad_scene ");
}

TEST_CASE("numbers that are none, and zero bytes, are refused by their place") {
  const Town town;
  Session session = session_of(town.open());
  Json frame = town.frame(0);
  frame["time"] = std::nan("");
  CHECK(refusal([&] { tell(session, frame, Encoding::cbor); }) == "bad_frame /time");
  frame["time"] = std::numeric_limits<double>::infinity();
  CHECK(refusal([&] { tell(session, frame, Encoding::cbor); }) == "bad_frame /time");
  const std::string text = encoded(town.frame(0), Encoding::json) + std::string("\0{}", 3);
  CHECK(refusal([&] { WireRequest(text, Encoding::json); }) == "bad_message ");
  CHECK(session.seq() == 0);
}

TEST_CASE("explain names some cells of something huge, and is quick among many occluders") {
  Json scene = {
      {"format", "gridcull.scene/1"},
      {"dimension", 2},
      {"bounds", {{"min", {0, 0}}, {"max", {3000, 3000}}}},
      {"grid", {{"cell", 1}}},
      {"objects", {{{"id", 0}, {"shape", {{"type", "box"}, {"size", {3000, 3000}}}}, {"position", {1500, 1500}}}}},
      {"viewers", {{{"id", 1}, {"position", {1, 1}}}}}};
  Session session = session_of({{"type", "open"}, {"scene", scene}});
  tell(session, {{"type", "frame"}, {"seq", 1}, {"time", 0}});
  const Explanation why = session.explain({1, 0});
  CHECK(why.verdict == Explanation::Verdict::contains_viewer);
  CHECK(why.cells.size() == Explanation::most_cells);
}
