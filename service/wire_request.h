// What clients ask over `gridcull.wire/1` (FORMATS, "Service"), decoded and checked.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gridcull/service/world_options.h"
#include "gridcull/sim/frames.h"
#include "gridcull/sim/json_tree.h"
#include "gridcull/sim/scene.h"

namespace gridcull {

/// A message as it came. Refusals begin with "message: " and, where there is one, a JSON pointer and ": ".
class WireRequest {
 public:
  /// `bytes` outlives it. Throws Error(bad_message).
  WireRequest(std::string_view bytes, Encoding encoding);

  Encoding encoding() const { return encoding_; }
  /// "open", "frame", "close", "resume", "explain", "watch", or what nobody knows.
  const std::string& type() const { return type_; }
  JsonRef root() const { return tree_.root(); }

 private:
  JsonTree tree_;
  Encoding encoding_;
  std::string type_;
};

struct OpenRequest {
  WorldOptions options{};  ///< method, and what `options` says; `scene` is the name for refusals
  Scene scene{};
  std::string name{};
  std::string token{};
};
/// Throws Error(bad_scene) for the scene and Error(bad_message) for the rest. `most_threads`: of a session's engine.
OpenRequest read_open(const WireRequest& request, int most_threads);

enum class ReplyKind : std::uint8_t { full, delta, none };

struct FrameRequest {
  std::uint64_t seq = 0;
  ReplyKind reply = ReplyKind::full;
  bool bulk = false;  ///< ids as byte strings
  Frame frame{};
};
/// The number alone, so that a refusal of the rest can name it; none where there is no whole one.
std::optional<std::uint64_t> seq_of(const WireRequest& request);
/// `out` is reused; after a refusal it holds anything. Throws Error(bad_message) or Error(bad_frame).
void read_frame_request(const WireRequest& request, int dimension, FrameRequest& out);

struct SessionKey {
  std::string session{}, token{};
};
SessionKey read_resume(const WireRequest& request);

struct WatchRequest {
  SessionKey key{};  ///< the token may be left out
  ViewerId viewer = no_id;
};
WatchRequest read_watch(const WireRequest& request);

struct ExplainRequest {
  ViewerId viewer = no_id;
  ObjectId object = no_id;
};
ExplainRequest read_explain(const WireRequest& request);

}  // namespace gridcull
