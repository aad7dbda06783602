#include "gridcull/sim/json_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

#include "gridcull/sim/cbor_reader.h"
#include "gridcull/sim/json_text.h"

namespace gridcull {
namespace {

constexpr std::size_t deepest = 32;
constexpr double greatest = 1e9;

std::string escaped_token(std::string_view token) {
  std::string out = "/";
  for (const char c : token) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += '?';
    else
      out += c;
  }
  return out;
}

}  // namespace

/// Receives nlohmann's parse events; a tree of its own, since the library's keeps only the last of two
/// equal keys and destroys deep nesting by recursion.
class JsonTree::Builder final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Builder(JsonTree& tree) : tree_(tree) {}

  bool null() override { return leaf(Kind::null, 0.0); }
  bool boolean(bool value) override { return leaf(Kind::boolean, value ? 1.0 : 0.0); }
  bool number_integer(number_integer_t value) override {
    // The parser hands "-0" over as the signed integer 0.
    return leaf(Kind::integer, value == 0 ? -0.0 : static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override { return leaf(Kind::integer, static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return leaf(Kind::number, value); }
  bool string(string_t& value) override { return text(Kind::string, value); }
  bool binary(binary_t&) override { return false; }  // JSON has none
  bool start_object(std::size_t) override { return open(Kind::object); }
  bool start_array(std::size_t) override { return open(Kind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    set_key(value);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& fault) override {
    std::string line = fault.what();
    if (line.starts_with('[')) line.erase(0, line.find("] ") + 2);
    // Of a line of a file its number is in `source_`; that of the line within the line would mislead.
    constexpr std::string_view first = "at line 1, column";
    const bool one_line = tree_.text_.find('\n') == std::string_view::npos;
    if (const std::size_t at = line.find(first); one_line && at != std::string::npos) {
      line.replace(at, first.size(), "at column");
    }
    constexpr int overflow = 406;  // "number overflow parsing '1e999'"
    if (fault.id == overflow) {
      const std::string digits = line.substr(std::min(line.find('\''), line.size()));
      throw Error(tree_.code_, tree_.source_ + ": " + place() + ": expected a finite number, found " + digits);
    }
    throw Error(ErrorCode::bad_message, tree_.source_ + ": expected JSON: " + line);
  }

  void set_key(std::string_view value) {
    key_at_ = static_cast<std::uint32_t>(tree_.strings_.size());
    key_size_ = static_cast<std::uint32_t>(value.size());
    tree_.strings_ += value;
  }
  bool text(Kind kind, std::string_view value) {
    const auto at = static_cast<std::uint32_t>(tree_.strings_.size());
    tree_.strings_ += value;
    push(kind).text = {at, static_cast<std::uint32_t>(value.size())};
    return true;
  }
  void bytes(std::string_view value) {
    push(Kind::bytes).text = {static_cast<std::uint32_t>(value.data() - tree_.text_.data()),
                              static_cast<std::uint32_t>(value.size())};
  }
  bool leaf(Kind kind, double value) {
    push(kind).number = value;
    return true;
  }
  bool open(Kind kind) {
    if (open_.size() == deepest) {
      throw Error(ErrorCode::bad_message,
                  tree_.source_ + ": expected JSON nested at most " + std::to_string(deepest) + " deep, found more");
    }
    push(kind).text = {0, 0};
    open_.push_back(static_cast<std::uint32_t>(tree_.nodes_.size() - 1));
    return true;
  }
  bool close() {
    tree_.nodes_[open_.back()].end = static_cast<std::uint32_t>(tree_.nodes_.size());
    open_.pop_back();
    return true;
  }

 private:
  Node& push(Kind kind) {
    if (!open_.empty()) ++tree_.nodes_[open_.back()].text.size;
    Node& node = tree_.nodes_.emplace_back();
    node.kind = kind;
    node.end = static_cast<std::uint32_t>(tree_.nodes_.size());
    node.key_at = key_at_;
    node.key_size = key_size_;
    return node;
  }
  /// Pointer to the value that would come next.
  std::string place() const {
    if (open_.empty()) return "/";
    // The open nodes' ends are not set yet: walk them by hand.
    std::string out;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const Node& parent = tree_.nodes_[open_[i]];
      const bool last = i + 1 == open_.size();
      if (parent.kind == Kind::array) {
        out += "/" + std::to_string(parent.text.size - (last ? 0 : 1));
      } else {
        const std::uint32_t at = last ? key_at_ : tree_.nodes_[open_[i + 1]].key_at;
        const std::uint32_t size = last ? key_size_ : tree_.nodes_[open_[i + 1]].key_size;
        out += escaped_token(std::string_view(tree_.strings_).substr(at, size));
      }
    }
    return out;
  }

  JsonTree& tree_;
  std::vector<std::uint32_t> open_{};
  std::uint32_t key_at_ = 0, key_size_ = 0;
};

/// The same from CBOR.
class JsonTree::FromCbor final : public CborSink {
 public:
  explicit FromCbor(Builder& builder) : builder_(builder) {}

  void null() override { builder_.null(); }
  void boolean(bool value) override { builder_.boolean(value); }
  void integer(double value) override { builder_.leaf(Kind::integer, value); }
  void number(double value) override { builder_.leaf(Kind::number, value); }
  void text(std::string_view value) override { builder_.text(Kind::string, value); }
  void bytes(std::string_view value) override { builder_.bytes(value); }
  void key(std::string_view value) override { builder_.set_key(value); }
  void start_array() override { builder_.open(Kind::array); }
  void start_map() override { builder_.open(Kind::object); }
  void end() override { builder_.close(); }

 private:
  Builder& builder_;
};

JsonTree::JsonTree(std::string_view text, std::string source, ErrorCode code, Encoding encoding)
    : source_(std::move(source)), code_(code), text_(text) {
  if (text.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::limit, source_ + ": expected at most 4 GiB of JSON");
  }
  Builder builder(*this);
  if (encoding == Encoding::json) {
    if (text.starts_with("\x1f\x8b")) {
      throw Error(ErrorCode::bad_message,
                  source_ + ": expected JSON, found gzip data; only files named .gz are unpacked");
    }
    // The reader takes it for the end.
    if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos) {
      throw Error(ErrorCode::bad_message, source_ + ": expected JSON: found a zero byte at " + std::to_string(zero));
    }
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    return;
  }
  FromCbor sink(builder);
  if (const std::string fault = read_cbor(text, deepest, sink); !fault.empty()) {
    throw Error(ErrorCode::bad_message, source_ + ": expected CBOR: " + fault);
  }
}

JsonRef JsonTree::root() const { return {*this, 0}; }

std::string_view JsonTree::key(std::uint32_t node) const {
  return std::string_view(strings_).substr(nodes_[node].key_at, nodes_[node].key_size);
}

std::string JsonTree::pointer(std::uint32_t node) const {
  std::string out;
  std::uint32_t parent = 0;
  while (parent != node) {
    std::uint32_t child = parent + 1;
    std::uint32_t number = 0;
    for (; nodes_[child].end <= node; ++number) child = nodes_[child].end;
    out += nodes_[parent].kind == Kind::array ? "/" + std::to_string(number) : escaped_token(key(child));
    parent = child;
  }
  return out;
}

void JsonRef::only_keys(std::initializer_list<std::string_view> allowed) const {
  if (node().kind != JsonTree::Kind::object) refuse("an object");
  std::vector<std::string_view> seen;
  for (std::uint32_t child = node_ + 1; child < node().end; child = tree_->nodes_[child].end) {
    const std::string_view key = tree_->key(child);
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      std::string list;
      for (const std::string_view name : allowed) list += (list.empty() ? "" : ", ") + std::string(name);
      JsonRef(*tree_, child).refuse_with("unknown key, expected one of: " + list);
    }
    // At most as many as are allowed: a double search is enough.
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) {
      JsonRef(*tree_, child).refuse_with("expected each key once, found \"" + std::string(key) + "\" twice");
    }
    seen.push_back(key);
  }
}

std::optional<JsonRef> JsonRef::find(std::string_view key) const {
  if (node().kind != JsonTree::Kind::object) refuse("an object");
  for (std::uint32_t child = node_ + 1; child < node().end; child = tree_->nodes_[child].end) {
    if (tree_->key(child) == key) return JsonRef(*tree_, child);
  }
  return std::nullopt;
}

JsonRef JsonRef::at(std::string_view key) const {
  if (const auto member = find(key)) return *member;
  refuse_with("missing key \"" + std::string(key) + "\"");
}

std::vector<JsonRef> JsonRef::items() const {
  if (node().kind != JsonTree::Kind::array) refuse("an array");
  std::vector<JsonRef> out;
  out.reserve(node().text.size);
  for (std::uint32_t child = node_ + 1; child < node().end; child = tree_->nodes_[child].end) {
    out.emplace_back(*tree_, child);
  }
  return out;
}

double JsonRef::within(double low, double high, const char* expected) const {
  const auto kind = node().kind;
  if (kind != JsonTree::Kind::integer && kind != JsonTree::Kind::number) refuse(expected);
  if (!(node().number >= low && node().number <= high)) refuse(expected);
  return node().number;
}

double JsonRef::number() const { return within(-greatest, greatest, "a number of magnitude at most 1e9"); }

double JsonRef::positive() const {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  return within(least, greatest, "a number above 0 and at most 1e9");
}

double JsonRef::not_negative() const { return within(0.0, greatest, "a number from 0 to 1e9"); }

std::uint64_t JsonRef::count() const {
  if (node().kind != JsonTree::Kind::integer) refuse("an integer from 0 to 2^53");
  return static_cast<std::uint64_t>(within(0.0, 9007199254740992.0, "an integer from 0 to 2^53"));
}

std::uint32_t JsonRef::whole(std::uint32_t most, const char* expected) const {
  if (node().kind != JsonTree::Kind::integer) refuse(expected);
  return static_cast<std::uint32_t>(within(0.0, most, expected));
}

std::uint32_t JsonRef::id() const { return whole(4294967294u, "an id, an integer from 0 to 4294967294"); }

bool JsonRef::boolean() const {
  if (node().kind != JsonTree::Kind::boolean) refuse("true or false");
  return node().number != 0.0;
}

std::string_view JsonRef::string() const {
  if (node().kind != JsonTree::Kind::string) refuse("a string");
  return std::string_view(tree_->strings_).substr(node().text.at, node().text.size);
}

std::string_view JsonRef::bytes() const {
  if (node().kind != JsonTree::Kind::bytes) refuse("a byte string");
  return tree_->text_.substr(node().text.at, node().text.size);
}

Vec3 JsonRef::point(int dimension) const {
  const bool fits = node().kind == JsonTree::Kind::array && node().text.size == static_cast<std::uint32_t>(dimension);
  if (!fits) refuse(dimension == 2 ? "2 coordinates [x, y]" : "3 coordinates [x, y, z]");
  Vec3 out(0.0);
  std::uint32_t child = node_ + 1;
  for (int axis = 0; axis < dimension; ++axis, child = tree_->nodes_[child].end) {
    out[axis] = JsonRef(*tree_, child).number();
  }
  return out;
}

void JsonRef::expect_format(std::string_view format) const {
  const std::string expected = "\"" + std::string(format) + "\"";
  if (node().kind != JsonTree::Kind::string || string() != format) refuse(expected);
}

std::string JsonRef::found() const {
  switch (node().kind) {
    case JsonTree::Kind::null: return "null";
    case JsonTree::Kind::boolean: return node().number != 0.0 ? "true" : "false";
    case JsonTree::Kind::integer:
    case JsonTree::Kind::number: {
      if (!std::isfinite(node().number)) return node().number != node().number ? "NaN" : "infinity";
      std::string text;
      append_number(text, node().number);
      // 5.0 is no integer: "found 5" where one was expected would be a riddle.
      const bool plain = text.find_first_not_of("-0123456789") == std::string::npos;
      if (plain && node().kind == JsonTree::Kind::number) text += ".0";
      return text;
    }
    case JsonTree::Kind::string: {
      const std::string_view whole = string();
      std::string text;
      append_string(text, whole.substr(0, 40));
      return whole.size() > 40 ? text + "..." : text;
    }
    case JsonTree::Kind::bytes: return "a byte string of " + std::to_string(node().text.size);
    case JsonTree::Kind::array: return "an array of " + std::to_string(node().text.size);
    case JsonTree::Kind::object: return "an object";
  }
  return "nothing";
}

void JsonRef::refuse(const std::string& what) const { refuse_with("expected " + what + ", found " + found()); }

void JsonRef::refuse_with(const std::string& line) const { refuse_with(tree_->code_, line); }

void JsonRef::refuse_with(ErrorCode code, const std::string& line) const {
  const std::string pointer = tree_->pointer(node_);
  throw Error(code, tree_->source_ + ": " + (pointer.empty() ? "" : pointer + ": ") + line);
}

}  // namespace gridcull
