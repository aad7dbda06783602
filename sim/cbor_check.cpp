// Why a check of its own: the JSON library's reader takes a chunked string inside a chunked string inside ... by
// recursion, so that a megabyte of 0x7F would overflow the stack. Chunked strings and tags have no use here and are
// refused.
#include "gridcull/sim/cbor_check.h"

#include <cstdint>
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

class Checker {
 public:
  Checker(std::string_view bytes, std::size_t deepest) : bytes_(bytes), deepest_(deepest) {}

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
      case 2:
      case 3: return string(info, value, major == 3);
      case 4:
      case 5: return container(info, value, major == 5);
      case 6: return "expected no tags";
      case 7: return info <= 19 || info > 27 ? "expected false, true, null or a number" : "";
      default: return info == 31 ? "expected a whole number" : "";
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

  std::string string(int info, std::uint64_t size, bool text) {
    if (info == 31) return "expected a string of known length";
    if (bytes_.size() - at_ < size) {
      return "expected " + std::to_string(size) + " bytes, found " + std::to_string(bytes_.size() - at_);
    }
    if (text && !is_utf8(bytes_.substr(at_, size))) return "expected UTF-8";
    at_ += size;
    return "";
  }

  std::string container(int info, std::uint64_t count, bool is_map) {
    if (open_.size() == deepest_) return "expected at most " + std::to_string(deepest_) + " levels";
    // An item takes a byte at least: more than there are can be refused at once.
    if (info != 31 && count > bytes_.size() - at_) return "expected no more items than there are bytes";
    open_.push_back({info == 31 ? until_break : count * (is_map ? 2 : 1), is_map, true});
    return "";
  }

  std::string end_by_break() {
    if (open_.empty() || open_.back().left != until_break) return "expected an item, found a break";
    if (open_.back().is_map && !open_.back().key_next) return "expected a value, found a break";
    ++at_;
    open_.pop_back();
    return "";
  }

  void count_one() {
    if (open_.empty()) return;
    Open& in = open_.back();
    in.key_next = !in.key_next;
    if (in.left != until_break) --in.left;
  }
  void close_full() {
    while (!open_.empty() && open_.back().left == 0) open_.pop_back();
  }

  std::string_view bytes_;
  std::size_t deepest_;
  std::size_t at_ = 0;
  std::vector<Open> open_{};
};

}  // namespace

std::string fault_of_cbor(std::string_view bytes, std::size_t deepest) { return Checker(bytes, deepest).run(); }

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
