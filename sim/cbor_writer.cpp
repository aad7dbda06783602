#include "gridcull/sim/cbor_writer.h"

#include <bit>
#include <cmath>
#include <limits>

namespace gridcull {

void CborWriter::number(double value) {
  const bool narrow = std::fabs(value) <= std::numeric_limits<float>::max();
  if (narrow && static_cast<double>(static_cast<float>(value)) == value) {
    out_ += '\xFA';
    return big_endian(std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4);
  }
  out_ += '\xFB';
  big_endian(std::bit_cast<std::uint64_t>(value), 8);
}

void CborWriter::text(std::string_view utf8) {
  head(3, utf8.size());
  out_ += utf8;
}

/// The major type and its argument, in the fewest bytes that hold it.
void CborWriter::head(unsigned major, std::uint64_t value) {
  const auto lead = [&](unsigned info) { out_ += static_cast<char>(major << 5 | info); };
  if (value < 24) return lead(static_cast<unsigned>(value));
  const unsigned size = value <= 0xFF ? 0 : value <= 0xFFFF ? 1 : value <= 0xFFFF'FFFF ? 2 : 3;  // log2 of its bytes
  lead(24 + size);
  big_endian(value, 1 << size);
}

void CborWriter::big_endian(std::uint64_t value, int bytes) {
  for (int i = bytes; i-- > 0;) out_ += static_cast<char>(value >> 8 * i & 0xFF);
}

}  // namespace gridcull
