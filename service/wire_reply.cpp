#include "gridcull/service/wire_reply.h"

#include <algorithm>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "gridcull/service/wire_bulk.h"
#include "gridcull/sim/cbor_writer.h"

namespace gridcull {
namespace {

using Json = nlohmann::ordered_json;

Json ids_json(const std::vector<ObjectId>& ids, bool bulk) {
  if (!bulk) return ids;
  std::string bytes;
  append_bulk_ids(ids, bytes);
  return Json::binary(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
}

void append_ids(CborWriter& cbor, std::string_view key, const std::vector<ObjectId>& ids, bool bulk, std::string& out) {
  cbor.text(key);
  if (bulk) {
    cbor.bytes(4 * ids.size());
    return append_bulk_ids(ids, out);
  }
  cbor.array(ids.size());
  for (const ObjectId id : ids) cbor.whole(id);
}

std::string cbor_of(const FrameReply& reply) {
  std::string out;
  CborWriter cbor(out);
  cbor.map(reply.wanted ? 4 : 2);
  cbor.text("type");
  cbor.text(reply.wanted ? "pvs" : "ok");
  cbor.text("seq");
  cbor.whole(reply.seq);
  if (!reply.wanted) return out;
  cbor.text("time");
  cbor.number(reply.time);
  cbor.text("answers");
  cbor.array(reply.answers.size());
  for (const ViewerReply& viewer : reply.answers) {
    cbor.map(viewer.full ? 2 : 3);
    cbor.text("viewer");
    cbor.whole(viewer.viewer);
    if (viewer.full) {
      append_ids(cbor, "visible", viewer.visible, reply.bulk, out);
    } else {
      append_ids(cbor, "added", viewer.added, reply.bulk, out);
      append_ids(cbor, "removed", viewer.removed, reply.bulk, out);
    }
  }
  return out;
}

std::string code_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_scene: return "bad_scene";
    case ErrorCode::bad_frame: return "bad_frame";
    case ErrorCode::unknown_object: return "unknown_object";
    case ErrorCode::sequence: return "sequence";
    case ErrorCode::limit: return "limit";
    case ErrorCode::forbidden: return "forbidden";
    case ErrorCode::bad_message:
    case ErrorCode::usage: return "bad_message";  // a method or option that nobody knows
    case ErrorCode::io:
    case ErrorCode::internal: break;
  }
  return "internal";
}

/// An option of `open` is named as on the command line: "--view-box: line" is about /options/view_box.
std::string pointer_of(std::string_view option) {
  if (option == "--method") return "/method";
  for (const char* name : {"cell", "tbv", "threads", "resolution", "bounds", "occluders", "view_box"}) {
    std::string typed = std::string("--") + name;
    std::replace(typed.begin(), typed.end(), '_', '-');
    if (option == typed) return std::string("/options/") + name;
  }
  return {};
}

/// "message: /pointer: line" as its parts; any of the first two may be missing.
void split(std::string_view text, WireError& out) {
  constexpr std::string_view source = "message: ";
  if (text.starts_with(source)) text.remove_prefix(source.size());
  const std::size_t end = text.find(": ");
  if (text.starts_with('/') && end != std::string_view::npos) {
    out.pointer = text.substr(0, end);
    text.remove_prefix(end + 2);
  } else if (text.starts_with("--") && end != std::string_view::npos) {
    out.pointer = pointer_of(text.substr(0, end));
    if (!out.pointer.empty()) text.remove_prefix(end + 2);
  }
  // Pointers into a scene are the scene's own.
  constexpr std::string_view scene = "/scene";
  if (out.pointer.starts_with(scene) && (out.pointer.size() == scene.size() || out.pointer[scene.size()] == '/')) {
    out.pointer.erase(0, scene.size());
  }
  out.message = text;
}

/// A refusal may quote what was sent, but not all of it. Cut between characters.
void shorten(std::string& text, std::size_t most) {
  if (text.size() <= most) return;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0u) == 0x80u) --most;
  text.resize(most);
  text += "...";
}

}  // namespace

std::string encoded(const Json& message, Encoding encoding) {
  if (encoding == Encoding::json) return message.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string bytes;
  Json::to_cbor(message, bytes);
  return bytes;
}

Json opened_message(const Session& session, const SessionKey& key) {
  return {{"type", "opened"},
          {"session", key.session},
          {"token", key.token},
          {"cell", session.cell()},
          {"objects", session.objects()}};
}

Json frame_message(const FrameReply& reply) {
  if (!reply.wanted) return {{"type", "ok"}, {"seq", reply.seq}};
  Json answers = Json::array();
  for (const ViewerReply& viewer : reply.answers) {
    Json answer{{"viewer", viewer.viewer}};
    if (viewer.full) {
      answer["visible"] = ids_json(viewer.visible, reply.bulk);
    } else {
      answer["added"] = ids_json(viewer.added, reply.bulk);
      answer["removed"] = ids_json(viewer.removed, reply.bulk);
    }
    answers.push_back(std::move(answer));
  }
  return {{"type", "pvs"}, {"seq", reply.seq}, {"time", reply.time}, {"answers", std::move(answers)}};
}

std::string encoded_frame(const FrameReply& reply, Encoding encoding) {
  return encoding == Encoding::cbor ? cbor_of(reply) : encoded(frame_message(reply), encoding);
}

WireError wire_error(const std::exception& fault) {
  WireError out{"internal", "the server failed", ""};
  if (dynamic_cast<const std::bad_alloc*>(&fault) != nullptr) {
    return {"limit", "out of memory", ""};
  }
  const auto* error = dynamic_cast<const Error*>(&fault);
  if (error == nullptr) return out;
  out.code = code_name(error->code());
  // What went wrong with the server's own files is not the client's to know.
  if (error->code() == ErrorCode::io) return {"internal", "the server could not write its record", ""};
  split(fault.what(), out);
  shorten(out.message, 500);
  shorten(out.pointer, 200);
  return out;
}

Json error_message(const WireError& error, std::optional<std::uint64_t> seq) {
  Json json{{"type", "error"}, {"code", error.code}, {"message", error.message}};
  if (!error.pointer.empty()) json["pointer"] = error.pointer;
  if (seq) json["seq"] = *seq;
  return json;
}

}  // namespace gridcull
