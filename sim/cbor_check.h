// Whether bytes are one well-formed CBOR item (RFC 8949, appendix C) that is safe to hand to a recursive reader.
#pragma once

#include <string>
#include <string_view>

namespace gridcull {

/// "" when `bytes` are exactly one item, nested at most `deepest` deep, of definite-length strings without tags, all
/// texts UTF-8; else what is wrong with them. Work and memory are bounded by the bytes that are there, whatever lengths
/// they announce.
std::string fault_of_cbor(std::string_view bytes, std::size_t deepest);

/// Whether text is well-formed UTF-8 (RFC 3629: no surrogates, nothing overlong).
bool is_utf8(std::string_view text);

}  // namespace gridcull
