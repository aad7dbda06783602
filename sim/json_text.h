// Pieces of JSON text: numbers in the shortest form that reads back with the same bits.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gridcull/core/vec.h"

namespace gridcull {

/// A finite number.
void append_number(std::string& out, double value);
void append_integer(std::string& out, std::uint64_t value);
/// Quoted; bytes that are not UTF-8 become U+FFFD.
void append_string(std::string& out, std::string_view text);
/// `[x, y]` or `[x, y, z]`.
void append_point(std::string& out, const Vec3& point, int dimension);
/// `, "key": ` (without the comma right behind an opening bracket).
void append_key(std::string& out, std::string_view key);
/// `, ` unless right behind an opening bracket.
void append_comma(std::string& out);

}  // namespace gridcull
