// What is well-formed CBOR and what is not, and that whatever passes can be read.
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "gridcull/core/random.h"
#include "gridcull/sim/cbor_reader.h"
#include "gridcull/sim/json_tree.h"

using namespace gridcull;

namespace {

std::string cbor_of(const char* json) {
  std::string bytes;
  nlohmann::json::to_cbor(nlohmann::json::parse(json), bytes);
  return bytes;
}

struct Nothing final : CborSink {
  void null() override {}
  void boolean(bool) override {}
  void integer(double) override {}
  void number(double) override {}
  void text(std::string_view) override {}
  void bytes(std::string_view) override {}
  void key(std::string_view) override {}
  void start_array() override {}
  void start_map() override {}
  void end() override {}
};

std::string fault_of(const std::string& bytes) {
  Nothing sink;
  return read_cbor(bytes, 32, sink);
}

}  // namespace

TEST_CASE("whole CBOR items are well-formed, cut ones and longer ones are not") {
  for (const char* json : {"0", "-1", "[]", "{}", "[1, 2.5, \"x\", true, null]", "{\"a\": {\"b\": [[], {}]}}",
                           "{\"big\": 123456789012, \"text\": \"gr\\u00fc\\u00df dich \\ud83d\\ude00\"}"}) {
    CAPTURE(json);
    const std::string bytes = cbor_of(json);
    CHECK(fault_of(bytes) == "");
    for (std::size_t n = 0; n < bytes.size(); ++n) {
      CAPTURE(n);
      CHECK(fault_of(bytes.substr(0, n)) != "");
    }
    CHECK(fault_of(bytes + '\0') != "");
  }
}

TEST_CASE("CBOR that lies or has no use here is refused, however long it claims to be") {
  using namespace std::string_literals;
  CHECK(fault_of("\x9b\xff\xff\xff\xff\xff\xff\xff\xff"s) != "");  // 2^64 - 1 items
  CHECK(fault_of("\x5a\x40\0\0\0abc"s) != "");                     // a gigabyte of bytes
  CHECK(fault_of("\xbb\x40\0\0\0\0\0\0\0"s) != "");                // 2^62 pairs
  CHECK(fault_of(std::string(1 << 20, '\x7f')) != "");             // strings in strings in strings ...
  CHECK(fault_of(std::string(1 << 20, '\x81')) != "");             // arrays in arrays
  CHECK(fault_of(std::string(1 << 20, '\xc1')) != "");             // tags
  CHECK(fault_of("\xa1\x01\x02"s) != "");                          // a key that is no text
  CHECK(fault_of("\x61\xff"s) != "");                              // a text that is not UTF-8
  CHECK(fault_of("\xff"s) != "");
  CHECK(fault_of("\xbf\x61x\xff"s) != "");  // a break where a value should be
  CHECK(fault_of("\x9f\x01\x02\xff"s) == "");
  CHECK(fault_of("\xbf\x61x\x01\xff"s) == "");
  std::string deep(32, '\x81');
  CHECK(fault_of(deep + '\0') == "");
  CHECK(fault_of('\x81' + deep + '\0') != "");
}

TEST_CASE("a value in CBOR is the value in JSON") {
  const char* json =
      R"({"id": 7, "big": 4294967295, "minus": -12, "x": 0.1, "half": 1.5, "yes": true, "list": [1, [2]]})";
  const std::string bytes = cbor_of(json);
  const JsonTree a(json, "a", ErrorCode::bad_message), b(bytes, "b", ErrorCode::bad_message, Encoding::cbor);
  for (const JsonTree* tree : {&a, &b}) {
    const JsonRef root = tree->root();
    CHECK(root.at("id").id() == 7);
    CHECK(root.at("big").count() == 4294967295u);
    CHECK(root.at("minus").number() == -12);
    CHECK(root.at("x").number() == 0.1);
    CHECK(root.at("half").number() == 1.5);
    CHECK(root.at("yes").boolean());
    CHECK(root.at("list").items()[1].items()[0].number() == 2);
  }
  using namespace std::string_literals;
  const auto number = [](const std::string& cbor) {
    return JsonTree(cbor, "n", ErrorCode::bad_message, Encoding::cbor).root().number();
  };
  CHECK(number("\xf9\x3e\x00"s) == 1.5);
  CHECK(number("\xf9\x00\x01"s) == 0x1p-24);
  CHECK(number("\xf9\xc4\x00"s) == -4.0);
  CHECK(number("\xfa\x3f\xc0\x00\x00"s) == 1.5);
  CHECK(number("\x38\x63"s) == -100);
  CHECK_THROWS_AS(number("\xf9\x7c\x00"s), Error);  // infinity
  CHECK_THROWS_AS(number("\xf9\x7e\x00"s), Error);  // not a number
}

TEST_CASE("UTF-8: nothing overlong, no surrogates, nothing beyond U+10FFFF") {
  for (const char* good :
       {"", "a", "\xc2\x80", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    CHECK(is_utf8(good));
  }
  for (const char* bad : {"\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80",
                          "\xc2", "\xe1\x80", "\xf8\x88\x80\x80\x80", "\xff", "a\xc3"}) {
    CHECK_FALSE(is_utf8(bad));
  }
}

TEST_CASE("whatever passes the check is read or refused in words, never worse") {
  Random random(7);
  const std::string seed =
      cbor_of(R"({"type": "frame", "seq": 3, "time": 0.5, "set": [{"id": 1, "position": [1, 2]}]})");
  int read = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string bytes = seed;
    const int changes = 1 + static_cast<int>(random.below(3));
    for (int i = 0; i < changes; ++i) bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
    try {
      const JsonTree tree(bytes, "message", ErrorCode::bad_message, Encoding::cbor);
      ++read;
      CHECK(fault_of(bytes) == "");
    } catch (const Error& fault) {
      CHECK(std::string(fault.what()).starts_with("message: "));
    }
  }
  CHECK(read > 1000);
}
