#include "gridcull/sim/json_text.h"

#include <array>
#include <charconv>
#include <cmath>

#include <nlohmann/json.hpp>

#include "gridcull/core/error.h"

namespace gridcull {

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) throw Error(ErrorCode::internal, "a number to be written is not finite");
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}

void append_integer(std::string& out, std::uint64_t value) {
  std::array<char, 24> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  out.append(digits.data(), end);
}

void append_string(std::string& out, std::string_view text) {
  out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void append_point(std::string& out, const Vec3& point, int dimension) {
  out += '[';
  for (int axis = 0; axis < dimension; ++axis) {
    append_comma(out);
    append_number(out, point[axis]);
  }
  out += ']';
}

void append_key(std::string& out, std::string_view key) {
  append_comma(out);
  out += '"';
  out += key;
  out += "\": ";
}

void append_comma(std::string& out) {
  if (!out.empty() && out.back() != '[' && out.back() != '{') out += ", ";
}

}  // namespace gridcull
