// Tokens: made so that nobody guesses them, compared so that nobody learns from the time that it takes.
#pragma once

#include <string>
#include <string_view>

namespace gridcull {

/// 128 random bits as 32 hexadecimal digits.
std::string new_token();

/// Takes the same time for all texts of a length.
bool same_secret(std::string_view a, std::string_view b);

}  // namespace gridcull
