#include "gridcull/service/wire_request.h"

#include <optional>
#include <utility>

#include "gridcull/core/error.h"
#include "gridcull/service/wire_bulk.h"
#include "gridcull/sim/scene_json.h"

namespace gridcull {
namespace {

constexpr const char* source = "message";
constexpr std::size_t longest_name = 200;

std::string text_or(const JsonRef& root, const char* key) {
  const auto json = root.find(key);
  return json ? std::string(json->string()) : std::string{};
}

/// As the command line's options of the same names.
void read_options(const JsonRef& json, int most_threads, WorldOptions& out) {
  json.only_keys({"cell", "tbv", "threads", "resolution", "bounds", "occluders", "view_box"});
  if (const auto cell = json.find("cell")) out.cell = cell->positive();
  if (const auto tbv = json.find("tbv")) out.tbv = tbv->string();
  if (const auto threads = json.find("threads")) {
    const std::string expected = "a whole number 1 .. " + std::to_string(most_threads);
    out.threads = static_cast<int>(threads->count());
    if (out.threads < 1 || out.threads > most_threads) threads->refuse(expected);
  }
  if (const auto resolution = json.find("resolution")) {
    out.resolution = resolution->is_string() ? std::string(resolution->string()) : std::to_string(resolution->count());
  }
  if (const auto bounds = json.find("bounds")) out.bounds = bounds->string();
  if (const auto occluders = json.find("occluders")) {
    out.occluders = static_cast<int>(occluders->within(1, 64, "a whole number 1 .. 64"));
    if (out.occluders != occluders->number()) occluders->refuse("a whole number 1 .. 64");
  }
  if (const auto box = json.find("view_box")) out.view_box = box->not_negative();
}

ReplyKind read_reply(const JsonRef& json) {
  if (json.string() == "full") return ReplyKind::full;
  if (json.string() == "delta") return ReplyKind::delta;
  if (json.string() == "none") return ReplyKind::none;
  json.refuse("\"full\", \"delta\" or \"none\"");
}

}  // namespace

WireRequest::WireRequest(std::string_view bytes, Encoding encoding)
    : tree_(bytes, source, ErrorCode::bad_message, encoding), encoding_(encoding), type_(root().at("type").string()) {}

OpenRequest read_open(const WireRequest& request, int most_threads) {
  const JsonRef root = request.root();
  root.only_keys({"type", "scene", "method", "options", "name", "token"});
  OpenRequest out;
  out.options.scene = source;
  out.name = text_or(root, "name");
  if (out.name.size() > longest_name) {
    root.at("name").refuse("at most " + std::to_string(longest_name) + " bytes");
  }
  out.token = text_or(root, "token");
  if (const auto method = root.find("method")) out.options.method = method->string();
  if (const auto options = root.find("options")) read_options(*options, most_threads, out.options);
  const JsonRef scene = root.at("scene");
  try {
    out.scene = read_scene(scene);
  } catch (const Error& fault) {
    // Whatever is wrong with a scene is a bad scene.
    throw Error(fault.code() == ErrorCode::bad_message ? ErrorCode::bad_scene : fault.code(), fault.what());
  }
  return out;
}

std::optional<std::uint64_t> seq_of(const WireRequest& request) {
  try {
    return request.root().at("seq").count();
  } catch (const Error&) {
    return std::nullopt;
  }
}

void read_frame_request(const WireRequest& request, int dimension, FrameRequest& out) {
  const JsonRef root = request.root();
  root.only_keys({"type", "seq", "time", "set", "add", "remove", "viewers", "drop_viewers", "reply", "bulk", set_ids,
                  set_positions, set_positions64, set_headings, set_headings64, set_orientations, set_orientations64});
  out.seq = root.at("seq").count();
  const auto reply = root.find("reply");
  out.reply = reply ? read_reply(*reply) : ReplyKind::full;
  out.bulk = false;
  if (const auto bulk = root.find("bulk")) {
    out.bulk = bulk->boolean();
    if (out.bulk && request.encoding() == Encoding::json) bulk->refuse("true in CBOR messages only");
  }
  try {
    BulkMoves moves = std::move(out.frame.bulk);  // for its memory
    out.frame = read_frame(root, dimension);
    read_bulk_moves(root, dimension, moves);
    if (!moves.ids.empty() && !out.frame.set.empty()) {
      root.at("set").refuse_with("expected either \"set\" or \"set_ids\", found both");
    }
    out.frame.bulk = std::move(moves);
  } catch (const Error& fault) {
    throw Error(fault.code() == ErrorCode::bad_message ? ErrorCode::bad_frame : fault.code(), fault.what());
  }
  out.frame.where = source;
}

SessionKey read_resume(const WireRequest& request) {
  const JsonRef root = request.root();
  root.only_keys({"type", "session", "token"});
  return {std::string(root.at("session").string()), std::string(root.at("token").string())};
}

WatchRequest read_watch(const WireRequest& request) {
  const JsonRef root = request.root();
  root.only_keys({"type", "session", "token", "viewer"});
  WatchRequest out{{std::string(root.at("session").string()), text_or(root, "token")}};
  if (const auto viewer = root.find("viewer")) out.viewer = viewer->id();
  return out;
}

ExplainRequest read_explain(const WireRequest& request) {
  const JsonRef root = request.root();
  root.only_keys({"type", "viewer", "object"});
  return {root.at("viewer").id(), root.at("object").id()};
}

}  // namespace gridcull
