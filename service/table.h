// Two-column tables on standard output.
#pragma once

#include <string>

namespace gridcull {

/// "name            value\n", values aligned at column 16.
inline std::string row(const std::string& name, const std::string& value) {
  constexpr std::size_t column = 16;
  return name + std::string(name.size() < column ? column - name.size() : 1, ' ') + value + "\n";
}

}  // namespace gridcull
