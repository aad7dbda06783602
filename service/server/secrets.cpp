#include "gridcull/service/server/secrets.h"

#include <cstdint>
#include <random>

namespace gridcull {

std::string new_token() {
  static constexpr char digits[] = "0123456789abcdef";
  std::random_device entropy;  // the system's generator
  std::string token;
  for (int word = 0; word < 4; ++word) {
    std::uint32_t bits = entropy();
    for (int i = 0; i < 8; ++i, bits >>= 4) token += digits[bits & 15];
  }
  return token;
}

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  volatile unsigned char differs = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differs =
        static_cast<unsigned char>(differs | (static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i])));
  }
  return differs == 0;
}

}  // namespace gridcull
