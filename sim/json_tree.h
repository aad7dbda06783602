// JSON, as text or as CBOR, as a read-only tree with checked access: every refusal names source, pointer, what was
// expected and what stood there.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gridcull/core/error.h"
#include "gridcull/core/vec.h"

namespace gridcull {

class JsonRef;

/// How a value is written: RFC 8259 or RFC 8949.
enum class Encoding : std::uint8_t { json, cbor };

/// A parsed text. Nodes lie in document order in one array (as in simdjson's tape), 32 bytes each.
class JsonTree {
 public:
  enum class Kind : std::uint8_t { null, boolean, integer, number, string, bytes, array, object };
  struct Node {
    Kind kind;
    std::uint32_t end;               ///< index after the node's last descendant
    std::uint32_t key_at, key_size;  ///< in strings; of members only
    union {
      double number;  ///< integer, number, boolean (0 or 1)
      struct {
        std::uint32_t at, size;
      } text;  ///< string: in strings; bytes: in the text itself; array and object: size is the number of children
    };
  };

  /// Throws Error(bad_message) for text that is not JSON (CBOR: bytes that are no item with texts as keys) or nested
  /// deeper than 32, Error(`code`) for a number that no double holds. `source` stands at the front of refusals, `code`
  /// is theirs. Byte strings are not copied: whoever reads them keeps `text` alive.
  JsonTree(std::string_view text, std::string source, ErrorCode code, Encoding encoding = Encoding::json);

  JsonRef root() const;
  const std::string& source() const { return source_; }

 private:
  friend class JsonRef;
  class Builder;
  class FromCbor;
  std::string pointer(std::uint32_t node) const;
  std::string_view key(std::uint32_t node) const;

  std::string source_;
  ErrorCode code_;
  std::string_view text_;
  std::vector<Node> nodes_{};
  std::string strings_{};
};

/// One value of a tree, which it must not outlive.
class JsonRef {
 public:
  JsonRef(const JsonTree& tree, std::uint32_t node) : tree_(&tree), node_(node) {}

  /// Refuses a value that is not an object, has other keys than these, or one key twice.
  void only_keys(std::initializer_list<std::string_view> allowed) const;
  /// A member of an object.
  std::optional<JsonRef> find(std::string_view key) const;
  /// The same, refused when missing.
  JsonRef at(std::string_view key) const;

  /// The items of an array.
  std::vector<JsonRef> items() const;

  bool is_string() const { return node().kind == JsonTree::Kind::string; }
  bool is_number() const { return node().kind == JsonTree::Kind::number || node().kind == JsonTree::Kind::integer; }
  bool is_null() const { return node().kind == JsonTree::Kind::null; }
  /// Where it stands in the tree (RFC 6901).
  std::string pointer() const { return tree_->pointer(node_); }
  double number() const;                                                ///< magnitude at most 1e9
  double positive() const;                                              ///< above 0, at most 1e9
  double not_negative() const;                                          ///< 0 .. 1e9
  double within(double low, double high, const char* expected) const;   ///< low <= value <= high
  std::uint64_t count() const;                                          ///< an integer 0 .. 2^53
  std::uint32_t id() const;                                             ///< an integer 0 .. 2^32 - 2
  std::uint32_t whole(std::uint32_t most, const char* expected) const;  ///< an integer 0 .. most
  bool boolean() const;
  std::string_view string() const;
  /// A byte string, in the text that was parsed; only CBOR has them.
  std::string_view bytes() const;
  /// An array of `dimension` coordinates; z = 0 in 2D.
  Vec3 point(int dimension) const;

  /// The string that names the format; refuses any other.
  void expect_format(std::string_view format) const;

  /// "expected `what`, found ...".
  [[noreturn]] void refuse(const std::string& what) const;
  /// Any line, behind source and pointer.
  [[noreturn]] void refuse_with(const std::string& line) const;
  [[noreturn]] void refuse_with(ErrorCode code, const std::string& line) const;

 private:
  const JsonTree::Node& node() const { return tree_->nodes_[node_]; }
  std::string found() const;

  const JsonTree* tree_;
  std::uint32_t node_;
};

}  // namespace gridcull
