// The viewer page, as it is sent: one HTML text with all its scripts.
#pragma once

#include <string>

namespace gridcull {

std::string page_text();

}  // namespace gridcull
