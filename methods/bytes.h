// Bytes in and out: little-endian on every machine, and lengths that lie are refused before anything is allocated.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/core/error.h"

namespace gridcull {

class ByteWriter {
 public:
  void u8(std::uint8_t value) { bytes_.push_back(static_cast<std::byte>(value)); }
  void u32(std::uint32_t value) { word(value, 4); }
  void u64(std::uint64_t value) { word(value, 8); }
  void f64(double value) { word(std::bit_cast<std::uint64_t>(value), 8); }
  void bytes(std::span<const std::byte> values) { bytes_.insert(bytes_.end(), values.begin(), values.end()); }
  /// Length, then characters.
  void text(std::string_view value) {
    u32(static_cast<std::uint32_t>(value.size()));
    bytes(std::as_bytes(std::span(value)));
  }
  /// Length, then bytes.
  void block(std::span<const std::byte> values) {
    u64(values.size());
    bytes(values);
  }

  std::span<const std::byte> span() const { return bytes_; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void word(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) u8(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  std::vector<std::byte> bytes_{};
};

/// Reads what ByteWriter wrote. Every function throws Error(bad_scene) when the bytes end before it is done.
class ByteReader {
 public:
  /// `name` stands at the front of refusals; both outlive the reader.
  ByteReader(std::span<const std::byte> bytes, std::string_view name) : left_(bytes), name_(name) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(word(1)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(word(4)); }
  std::uint64_t u64() { return word(8); }
  double f64() { return std::bit_cast<double>(word(8)); }
  std::span<const std::byte> bytes(std::uint64_t count) {
    if (count > left_.size()) refuse("cut short or altered");
    const auto out = left_.first(static_cast<std::size_t>(count));
    left_ = left_.subspan(out.size());
    return out;
  }
  std::string text() {
    const auto values = bytes(u32());
    return {reinterpret_cast<const char*>(values.data()), values.size()};
  }
  std::span<const std::byte> block() { return bytes(u64()); }
  /// A number of items that take at least `least` bytes each: no more than the rest can hold.
  std::size_t count(std::size_t least) {
    const std::uint64_t items = u64();
    if (items > left_.size() / least) refuse("cut short or altered");
    return static_cast<std::size_t>(items);
  }

  std::size_t left() const { return left_.size(); }
  /// Refuses bytes that nobody asked for.
  void finish() const {
    if (!left_.empty()) refuse("altered: " + std::to_string(left_.size()) + " bytes too many");
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorCode::bad_scene, std::string(name_) + ": " + why);
  }

 private:
  std::uint64_t word(std::size_t size) {
    std::uint64_t value = 0;
    const auto from = bytes(size);
    for (std::size_t i = 0; i < size; ++i) value |= std::to_integer<std::uint64_t>(from[i]) << (8 * i);
    return value;
  }
  std::span<const std::byte> left_;
  std::string_view name_;
};

}  // namespace gridcull
