// Reads one CBOR item (RFC 8949) from bytes that nobody vouches for: no recursion, and no more memory than the bytes
// themselves account for, whatever lengths they announce.
//
// Why not the JSON library's reader: it takes a chunked string inside a chunked string inside ... by recursion, so that
// a megabyte of 0x7F would overflow the stack, and byte strings byte by byte, which a frame's bulk moves would feel.
// Chunked strings and tags have no use here and are refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gridcull {

/// Receives an item as it is read. Keys come before their values.
class CborSink {
 public:
  virtual ~CborSink() = default;
  virtual void null() = 0;
  virtual void boolean(bool value) = 0;
  virtual void integer(double value) = 0;  ///< rounded where no double has it
  virtual void number(double value) = 0;
  virtual void text(std::string_view value) = 0;
  virtual void bytes(std::string_view value) = 0;
  virtual void key(std::string_view value) = 0;
  virtual void start_array() = 0;
  virtual void start_map() = 0;
  virtual void end() = 0;  ///< of the innermost array or map
};

/// Reads bytes that are exactly one item, nested at most `deepest` deep, all its texts UTF-8, keys texts. Gives "", or
/// what is wrong and where; the sink may have received a part then.
std::string read_cbor(std::string_view bytes, std::size_t deepest, CborSink& sink);

/// Whether text is well-formed UTF-8 (RFC 3629: no surrogates, nothing overlong).
bool is_utf8(std::string_view text);

}  // namespace gridcull
