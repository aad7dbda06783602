#include "fuzz_targets.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

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

void open_and_ask(const WireRequest& request) {
  OpenRequest open = read_open(request, 2);
  open.options.max_memory = 1 << 22;
  Session session(std::move(open), {.objects = 20}, "");
  FrameRequest frame;
  frame.seq = 1;
  const FrameReply& reply = session.apply(frame);
  expect(encoded_frame(reply, Encoding::cbor) == encoded(frame_message(reply), Encoding::cbor),
         "the same bytes of an answer, however they are written");
}

void take(std::string_view bytes, Encoding encoding) {
  refusals_are_fine([&] {
    const WireRequest request(bytes, encoding);
    const std::string& type = request.type();
    if (type == "open") open_and_ask(request);
    if (type == "resume") (void)read_resume(request);
    if (type == "watch") (void)read_watch(request);
    if (type == "explain") (void)read_explain(request);
    if (type != "frame") return;
    (void)seq_of(request);
    FrameRequest frame;
    refusals_are_fine([&] { read_frame_request(request, 2, frame); });
    read_frame_request(request, 3, frame);
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
