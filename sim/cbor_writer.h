// Writes CBOR (RFC 8949) item by item, each as short as it can be.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gridcull {

/// Appends to a string that outlives it. An array or map is announced and its items follow.
class CborWriter {
 public:
  explicit CborWriter(std::string& out) : out_(out) {}

  void whole(std::uint64_t value) { head(0, value); }
  /// As a float where that is the same number. Finite.
  void number(double value);
  void text(std::string_view utf8);
  /// Announces a byte string, which the caller appends.
  void bytes(std::size_t size) { head(2, size); }
  void array(std::size_t items) { head(4, items); }
  void map(std::size_t pairs) { head(5, pairs); }

 private:
  void head(unsigned major, std::uint64_t value);
  void big_endian(std::uint64_t value, int bytes);

  std::string& out_;
};

}  // namespace gridcull
