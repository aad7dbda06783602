#include "gridcull/sim/cbor_reader.h"

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace gridcull {
namespace {

constexpr std::uint64_t until_break = ~std::uint64_t{0};

/// An array or map that is not complete yet.
struct Open {
  std::uint64_t left;  ///< items (a map's keys and values) to come, or until_break
  bool is_map;
  bool key_next;  ///< of a map
};

/// Half precision (RFC 8949, appendix D).
double half_value(std::uint64_t bits) {
  const auto exponent = static_cast<int>(bits >> 10 & 31);
  const auto mantissa = static_cast<double>(bits & 1023);
  double value = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(mantissa + 1024.0, exponent - 25);
  if (exponent == 31) {
    value = mantissa == 0.0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  }
  return (bits >> 15 & 1) != 0 ? -value : value;
}

class Reader {
 public:
  Reader(std::string_view bytes, std::size_t deepest, CborSink& sink) : bytes_(bytes), deepest_(deepest), sink_(sink) {}

  std::string run() {
    do {
      if (std::string fault = item(); !fault.empty()) return "at byte " + std::to_string(at_) + ": " + fault;
      close_full();
    } while (!open_.empty());
    return at_ == bytes_.size() ? ""
                                : "expected one item, found " + std::to_string(bytes_.size() - at_) + " bytes more";
  }

 private:
  std::string item() {
    if (at_ == bytes_.size()) return "expected more bytes";
    const auto head = static_cast<std::uint8_t>(bytes_[at_]);
    const int major = head >> 5, info = head & 31;
    if (head == 0xFF) return end_by_break();
    const bool is_key = !open_.empty() && open_.back().is_map && open_.back().key_next;
    if (is_key && major != 3) return "expected a text as key";
    ++at_;
    std::uint64_t value = 0;
    if (!argument(info, value))
      return "expected a length or value, found additional information " + std::to_string(info);
    count_one();
    switch (major) {
      case 0:
      case 1: return whole(major, info, value);
      case 2:
      case 3: return string(info, value, major == 3, is_key);
      case 4:
      case 5: return container(info, value, major == 5);
      case 6: return "expected no tags";
      default: return simple(info, value);
    }
  }

  /// What follows the head's five bits; 31 stands for itself.
  bool argument(int info, std::uint64_t& value) {
    if (info < 24) return value = static_cast<std::uint64_t>(info), true;
    if (info == 31) return true;
    if (info > 27) return false;
    const std::size_t size = std::size_t{1} << (info - 24);
    if (bytes_.size() - at_ < size) return false;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<std::uint8_t>(bytes_[at_ + i]);
    at_ += size;
    return true;
  }

  std::string whole(int major, int info, std::uint64_t value) {
    if (info == 31) return "expected a whole number";
    sink_.integer(major == 0 ? static_cast<double>(value) : -1.0 - static_cast<double>(value));
    return "";
  }

  std::string simple(int info, std::uint64_t value) {
    switch (info) {
      case 20:
      case 21: sink_.boolean(info == 21); return "";
      case 22: sink_.null(); return "";
      case 25: sink_.number(half_value(value)); return "";
      case 26: sink_.number(static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(value)))); return "";
      case 27: sink_.number(std::bit_cast<double>(value)); return "";
      default: return "expected false, true, null or a number";
    }
  }

  std::string string(int info, std::uint64_t size, bool text, bool is_key) {
    if (info == 31) return "expected a string of known length";
    if (bytes_.size() - at_ < size) {
      return "expected " + std::to_string(size) + " bytes, found " + std::to_string(bytes_.size() - at_);
    }
    const std::string_view value = bytes_.substr(at_, size);
    if (text && !is_utf8(value)) return "expected UTF-8";
    at_ += size;
    is_key ? sink_.key(value) : text ? sink_.text(value) : sink_.bytes(value);
    return "";
  }

  std::string container(int info, std::uint64_t count, bool is_map) {
    if (open_.size() == deepest_) return "expected at most " + std::to_string(deepest_) + " levels";
    // An item takes a byte at least: more than there are can be refused at once.
    if (info != 31 && count > bytes_.size() - at_) return "expected no more items than there are bytes";
    open_.push_back({info == 31 ? until_break : count * (is_map ? 2 : 1), is_map, true});
    is_map ? sink_.start_map() : sink_.start_array();
    return "";
  }

  std::string end_by_break() {
    if (open_.empty() || open_.back().left != until_break) return "expected an item, found a break";
    if (open_.back().is_map && !open_.back().key_next) return "expected a value, found a break";
    ++at_;
    close();
    return "";
  }

  void count_one() {
    if (open_.empty()) return;
    Open& in = open_.back();
    in.key_next = !in.key_next;
    if (in.left != until_break) --in.left;
  }
  void close() {
    open_.pop_back();
    sink_.end();
  }
  void close_full() {
    while (!open_.empty() && open_.back().left == 0) close();
  }

  std::string_view bytes_;
  std::size_t deepest_;
  CborSink& sink_;
  std::size_t at_ = 0;
  std::vector<Open> open_{};
};

}  // namespace

std::string read_cbor(std::string_view bytes, std::size_t deepest, CborSink& sink) {
  return Reader(bytes, deepest, sink).run();
}

bool is_utf8(std::string_view text) {
  std::size_t i = 0;
  const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(text[k]); };
  while (i < text.size()) {
    const std::uint8_t lead = byte(i);
    const std::size_t more = lead < 0x80 ? 0 : lead >> 5 == 6 ? 1 : lead >> 4 == 14 ? 2 : lead >> 3 == 30 ? 3 : 4;
    if (more == 4 || text.size() - i <= more) return false;
    std::uint32_t code = more == 0 ? lead : lead & (0x3Fu >> more);
    for (std::size_t k = 1; k <= more; ++k) {
      if (byte(i + k) >> 6 != 2) return false;
      code = code << 6 | (byte(i + k) & 0x3Fu);
    }
    constexpr std::uint32_t least[4] = {0, 0x80, 0x800, 0x10000};
    if (code < least[more] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return false;
    i += more + 1;
  }
  return true;
}

}  // namespace gridcull
