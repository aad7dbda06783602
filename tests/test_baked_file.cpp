// Baked files: what goes in comes out, and nothing else is believed.
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "gridcull/core/error.h"
#include "gridcull/methods/baking.h"
#include "gridcull/methods/bytes.h"
#include "sim_helpers.h"

namespace gridcull::test {
namespace {

const BakedHead head{"some-method", 3, 0x0123'4567'89AB'CDEFull};

std::vector<std::byte> some_payload() {
  std::vector<std::byte> payload;
  for (int i = 0; i < 41; ++i) payload.push_back(static_cast<std::byte>(7 * i));
  return payload;
}

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void put(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// The line with which a file is refused; "" when it is not.
std::string refusal(const std::string& path, const BakedHead& expected = head) {
  try {
    (void)read_baked(path, expected);
  } catch (const Error& e) {
    CHECK((e.code() == ErrorCode::bad_scene || e.code() == ErrorCode::io));
    const std::string line = e.what();
    CHECK(line.starts_with(path + ": "));
    CHECK(line.find('\n') == std::string::npos);
    return line.substr(path.size() + 2);
  }
  return {};
}

bool says(const std::string& line, const char* words) { return line.find(words) != std::string::npos; }

Object building(ObjectId id, double x) {
  return {.id = id, .shape = Cuboid{{2, 3, 4}}, .pose = {{x, 0, 0}}, .is_static = true};
}

}  // namespace

TEST_CASE("a payload comes back, and replaces what stood there") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.baked");
  put(path, "something else");
  write_baked(path, head, some_payload());
  CHECK(read_baked(path, head) == some_payload());
  write_baked(path, head, {});
  CHECK(read_baked(path, head).empty());
  const BakedHead found = read_baked_head(path);
  CHECK(found.method == head.method);
  CHECK(found.version == head.version);
  CHECK(found.world == head.world);
  CHECK(folder.entries() == 1);
}

TEST_CASE("a file of another method, version or world is refused with the reason") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.baked");
  write_baked(path, head, some_payload());
  CHECK(says(refusal(path, {"other-method", 3, head.world}), "baked for the method some-method"));
  CHECK(says(refusal(path, {"some-method", 2, head.world}), "version 3 of what some-method bakes"));
  CHECK(says(refusal(path, {"some-method", 4, head.world}), "version 3 of what some-method bakes"));
  CHECK(says(refusal(path, {"some-method", 3, head.world + 1}), "another world"));
}

TEST_CASE("every truncation and every altered byte is found") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.baked");
  write_baked(path, head, some_payload());
  const std::string whole = contents(path);
  REQUIRE(whole.size() == 8 + 4 + 4 + head.method.size() + 4 + 8 + 8 + some_payload().size() + 4);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CAPTURE(length);
    put(path, whole.substr(0, length));
    CHECK_FALSE(refusal(path).empty());
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      CAPTURE(at);
      CAPTURE(flip);
      std::string altered = whole;
      altered[at] = static_cast<char>(altered[at] ^ flip);
      put(path, altered);
      CHECK_FALSE(refusal(path).empty());
    }
  }
  put(path, whole + "x");
  CHECK(says(refusal(path), "too many"));
  put(path, whole.substr(0, whole.size() - 1));
  CHECK(says(refusal(path), "cut short"));
  std::string altered = whole;
  altered[whole.size() - 10] ^= 1;
  put(path, altered);
  CHECK(says(refusal(path), "checksum"));
  put(path, whole);
  CHECK(refusal(path).empty());
}

TEST_CASE("a container from the future and other files are named as such") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.baked");
  write_baked(path, head, some_payload());
  std::string future = contents(path);
  future[8] = 9;
  put(path, future);
  CHECK(says(refusal(path), "version 9 of baked files"));
  put(path, "{\"format\": \"gridcull.scene/1\"}");
  CHECK(says(refusal(path), "no baked file"));
  put(path, "");
  CHECK(says(refusal(path), "no baked file"));
  CHECK(says(refusal(folder.file("missing")), "cannot be opened"));
  CHECK(says(refusal(folder.file("")), "folder"));
  CHECK_THROWS_AS(write_baked(folder.file("nowhere/a.baked"), head, {}), Error);
  CHECK_THROWS_AS(write_baked(folder.file(""), head, {}), Error);
}

TEST_CASE("bytes: what is written is read, and lengths that lie are refused before memory is asked for") {
  ByteWriter out;
  out.u8(200);
  out.u32(0xDEAD'BEEFu);
  out.u64(0x0123'4567'89AB'CDEFull);
  out.f64(-0.1);
  out.text("grid");
  out.block(some_payload());
  CHECK(std::to_integer<int>(out.span()[1]) == 0xEF);  // little-endian
  ByteReader in(out.span(), "test");
  CHECK(in.u8() == 200);
  CHECK(in.u32() == 0xDEAD'BEEFu);
  CHECK(in.u64() == 0x0123'4567'89AB'CDEFull);
  CHECK(in.f64() == -0.1);
  CHECK(in.text() == "grid");
  const auto block = in.block();
  CHECK(std::vector(block.begin(), block.end()) == some_payload());
  in.finish();
  CHECK_THROWS_AS(in.u8(), Error);
  for (const std::uint64_t lie :
       {std::uint64_t{1}, std::uint64_t{1} << 40, std::numeric_limits<std::uint64_t>::max()}) {
    ByteWriter lying;
    lying.u64(lie);
    CHECK_THROWS_AS(ByteReader(lying.span(), "test").block(), Error);
    CHECK_THROWS_AS(ByteReader(lying.span(), "test").count(8), Error);
  }
  CHECK_THROWS_AS(ByteReader(out.span(), "test").finish(), Error);
}

TEST_CASE("the static world's hash: order and movers do not count, everything else does") {
  Object mover = building(9, 1);
  mover.is_static = false;
  const std::vector<Object> world{building(1, 0), building(2, 10)};
  const std::uint64_t hash = static_world_hash(world);
  CHECK(static_world_hash(std::vector{world[1], mover, world[0]}) == hash);
  const auto changed = [&](auto&& change) {
    std::vector<Object> other = world;
    change(other[1]);
    return static_world_hash(other) != hash;
  };
  CHECK(changed([](Object& o) { o.id = 3; }));
  CHECK(changed([](Object& o) { o.pose.position.z = 1e-9; }));
  CHECK(changed([](Object& o) { o.pose.orientation = turn_about_z(0.1); }));
  CHECK(changed([](Object& o) { o.occluder = false; }));
  CHECK(changed([](Object& o) { o.is_static = false; }));
  CHECK(changed([](Object& o) { o.shape = Cuboid{{2, 3, 5}}; }));
  CHECK(changed([](Object& o) { o.shape = Sphere{1}; }));
  CHECK_FALSE(changed([](Object& o) { o.max_speed = 3.0; }));
  CHECK_FALSE(changed([](Object& o) { o.pose.position.y = -0.0; }));
  CHECK(static_world_hash({}) != static_world_hash(std::vector{world[0]}));
}

TEST_CASE("settings of a bake have a standard value and a range") {
  const BakeSetting setting{"share", "", 0.5, 0.0, 1.0};
  const BakeSetting whole{"count", "", 5, 1, 10, true};
  CHECK(bake_setting({}, setting) == 0.5);
  CHECK(bake_setting({{"share", 1.0}}, setting) == 1.0);
  CHECK_THROWS_AS(bake_setting({{"share", 1.1}}, setting), Error);
  CHECK_THROWS_AS(bake_setting({{"share", std::numeric_limits<double>::quiet_NaN()}}, setting), Error);
  CHECK(bake_setting({{"count", 7}}, whole) == 7);
  CHECK_THROWS_AS(bake_setting({{"count", 7.5}}, whole), Error);
}

}  // namespace gridcull::test
