// What the service says over `gridcull.wire/1`: messages, and how they are written.
#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "gridcull/core/error.h"
#include "gridcull/service/session.h"
#include "gridcull/sim/json_tree.h"

namespace gridcull {

/// The bytes of a message.
std::string encoded(const nlohmann::ordered_json& message, Encoding encoding);

nlohmann::ordered_json opened_message(const Session& session, const SessionKey& key);
/// "pvs", or "ok" for an answer that nobody wants.
nlohmann::ordered_json frame_message(const FrameReply& reply);
/// Its bytes. In CBOR they are written straight away, the same as encoded() would give.
std::string encoded_frame(const FrameReply& reply, Encoding encoding);

/// An error as clients see it.
struct WireError {
  std::string code;     ///< one of FORMATS' codes
  std::string message;  ///< one line
  std::string pointer;  ///< into the message, of scenes into the scene; "" where the whole is meant
};
/// Whatever is not an Error is "internal", without its text.
WireError wire_error(const std::exception& fault);
nlohmann::ordered_json error_message(const WireError& error, std::optional<std::uint64_t> seq);

}  // namespace gridcull
