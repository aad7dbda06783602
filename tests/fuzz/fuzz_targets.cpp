#include "fuzz_targets.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/session.h"
#include "gridcull/service/wire_reply.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/scene.h"

namespace gridcull::fuzz {
namespace {

/// Ends the program: a fuzzer and a test both notice.
void expect(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz target: expected %s\n", what);
  std::abort();
}

template <class Action>
void refusals_are_fine(const Action& action) {
  try {
    action();
  } catch (const Error& fault) {
    const WireError error = wire_error(fault);
    expect(!error.message.empty(), "a refusal to say something");
    (void)encoded(error_message(error, 1), Encoding::json);
  }
}

Session session_of(const WireRequest& request) {
  OpenRequest open = read_open(request, 2);
  open.options.max_memory = 1 << 22;
  return Session(std::move(open), {.objects = 20}, "");
}

/// The answer's bytes.
std::string ask(Session& session, FrameRequest& frame) {
  const FrameReply& reply = session.apply(frame);
  std::string bytes = encoded_frame(reply, Encoding::cbor);
  expect(bytes == encoded(frame_message(reply), Encoding::cbor),
         "the same bytes of an answer, however they are written");
  return bytes;
}

std::string ask_nothing_new(Session& session) {
  FrameRequest frame;
  frame.seq = session.seq() + 1;
  frame.frame.time = session.seq() == 0 ? 0.0 : std::nextafter(*session.world().time(), 1e308);
  return ask(session, frame);
}

/// One of each shape, and both kinds of viewers, under the ids that the corpus speaks of.
constexpr std::array<std::string_view, 2> small_worlds{
    R"({"type": "open", "scene": {"format": "gridcull.scene/1", "dimension": 2,
      "bounds": {"min": [0, 0], "max": [50, 40]}, "grid": {"cell": 2}, "objects": [
        {"id": 1, "shape": {"type": "polyline", "vertices": [[0, 0], [3, 1], [5, -2]]}, "position": [30, 20]},
        {"id": 2, "shape": {"type": "polygon", "vertices": [[0, 0], [9, 0], [4, 3], [0, 8]]}, "position": [10, 14]},
        {"id": 9, "shape": {"type": "box", "size": [5, 1.8]}, "position": [12.5, 7], "max_speed": 60},
        {"id": 12, "shape": {"type": "disc", "radius": 0.25}, "position": [30, 7], "occluder": false}],
      "viewers": [{"id": 1, "follows": 9, "range": 15}, {"id": 2, "position": [20, 30], "fov_degrees": 90}]}})",
    R"({"type": "open", "scene": {"format": "gridcull.scene/1", "dimension": 3,
      "bounds": {"min": [-10, -10, 0], "max": [10, 10, 10]}, "grid": {"cell": 1}, "objects": [
        {"id": 1, "shape": {"type": "sphere", "radius": 1.5}, "position": [0, 0, 5], "max_speed": 3},
        {"id": 2, "shape": {"type": "box", "size": [4, 2, 9]}, "position": [5, 5, 4.5], "heading": 0.7},
        {"id": 9, "shape": {"type": "prism", "vertices": [[0, 0], [4, 0], [0, 3]], "height": 2}, "position": [-5, 2, 0]},
        {"id": 12, "shape": {"type": "faces", "vertices": [[0, 0, 0], [2, 0, 0], [0, 2, 0]], "triangles": [[0, 1, 2]]},
         "position": [8, -3, 1]}],
      "viewers": [{"id": 1, "follows": 9}, {"id": 2, "position": [-9, 0, 2],
                  "frustum": {"fov_y_degrees": 60, "aspect": 1.5, "near": 0.1, "far": 80}}]}})"};

Session small_world(int dimension) {
  return session_of(WireRequest(small_worlds[static_cast<std::size_t>(dimension - 2)], Encoding::json));
}

/// A frame that was applied: a record of it replays to the same answer, and the session goes on.
void check_applied(Session& session, const FrameRequest& frame, const std::string& answer) {
  const int dimension = session.dimension();
  const std::string recorded = frame_text(session.last_frame(), dimension);
  FrameRequest again;
  again.seq = 1;
  again.reply = frame.reply;
  again.bulk = frame.bulk;
  again.frame = parse_frame(recorded, dimension, "record");
  expect(frame_text(again.frame, dimension) == recorded, "a frame to be read as it was recorded");
  Session replayed = small_world(dimension);
  expect(ask(replayed, again) == answer, "a record to have the same answers");
  if (*session.world().time() < 1e300) (void)ask_nothing_new(session);
}

/// Reads the frame and applies it to a small world. A refusal changes nothing.
void apply(const WireRequest& request, int dimension) {
  FrameRequest frame;
  read_frame_request(request, dimension, frame);
  frame.seq = 1;
  Session session = small_world(dimension);
  std::string answer;
  try {
    answer = ask(session, frame);
  } catch (const Error&) {
    expect(session.seq() == 0 && !session.broken(), "a refused frame to leave the session whole");
    Session untouched = small_world(dimension);
    expect(ask_nothing_new(session) == ask_nothing_new(untouched), "a refused frame to change nothing");
    throw;
  }
  try {
    check_applied(session, frame, answer);
  } catch (const Error& fault) {
    expect(false, fault.what());
  }
}

void take(std::string_view bytes, Encoding encoding) {
  refusals_are_fine([&] {
    const WireRequest request(bytes, encoding);
    const std::string& type = request.type();
    if (type == "open") {
      Session session = session_of(request);
      (void)ask_nothing_new(session);
    }
    if (type == "resume") (void)read_resume(request);
    if (type == "watch") (void)read_watch(request);
    if (type == "explain") (void)read_explain(request);
    if (type != "frame") return;
    (void)seq_of(request);
    refusals_are_fine([&] { apply(request, 2); });
    apply(request, 3);
  });
}

}  // namespace

void wire(std::string_view bytes) {
  take(bytes, Encoding::json);
  take(bytes, Encoding::cbor);
}

void scene(std::string_view bytes) {
  refusals_are_fine([&] {
    const std::string once = scene_text(parse_scene(bytes, "fuzz"));
    expect(scene_text(parse_scene(once, "again")) == once, "a scene to be read as it was written");
  });
}

void frame(std::string_view bytes) {
  for (const int dimension : {2, 3}) {
    refusals_are_fine([&] {
      const std::string once = frame_text(parse_frame(bytes, dimension, "fuzz"), dimension);
      expect(frame_text(parse_frame(once, dimension, "again"), dimension) == once,
             "a frame to be read as it was written");
    });
  }
}

}  // namespace gridcull::fuzz
