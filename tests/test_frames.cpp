#include <limits>

#include <doctest/doctest.h>

#include "gridcull/sim/frames.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

const std::string first = "{\"format\": \"gridcull.frames/1\"}\n";
const std::string full =
    R"({"time": 600.1, "set": [{"id": 9, "position": [13.0, 7.0], "heading": 1.57}, {"id": 3, "heading": 2}, {"id": 4, "position": [1, 2]}],)"
    R"( "add": [{"id": 20, "shape": {"type": "disc", "radius": 1}, "position": [0, 0]}], "remove": [5, 6],)"
    R"( "viewers": [{"id": 1, "range": 20}, {"id": 2, "follows": 9, "offset": [1, 0], "fov_degrees": 90}], "drop_viewers": [7]})";

/// Reads a whole file of 2D frames.
std::vector<Frame> read_all(const std::string& path) {
  FrameReader reader(path, 2);
  std::vector<Frame> out;
  Frame frame;
  while (reader.next(frame)) out.push_back(frame);
  return out;
}

}  // namespace

TEST_CASE("a frame reads as it says") {
  const Frame frame = parse_frame(full, 2, "f:2");
  CHECK(frame.time == 600.1);
  REQUIRE(frame.set.size() == 3);
  CHECK(frame.set[0].position == Vec3(13, 7, 0));
  CHECK(frame.set[0].heading == 1.57);
  CHECK(frame.set[0].orientation->z == turn_about_z(1.57).z);
  CHECK_FALSE(frame.set[1].position);
  CHECK_FALSE(frame.set[2].orientation);
  CHECK(frame.add.at(0).object.id == 20);
  CHECK(frame.remove == std::vector<ObjectId>{5, 6});
  CHECK(frame.drop_viewers == std::vector<ViewerId>{7});
  REQUIRE(frame.viewers.size() == 2);
  CHECK(frame.viewers[0].range == 20.0);
  CHECK_FALSE(frame.viewers[0].follows);
  CHECK(frame.viewers[1].offset == Vec3(1, 0, 0));
  CHECK(frame.where == "f:2");
}

TEST_CASE("frames written and read back are the same") {
  const TemporaryFolder folder;
  for (const char* name : {"frames.jsonl", "frames.jsonl.gz"}) {
    const std::string path = folder.file(name);
    Frame frame = parse_frame(full, 2, "");
    FrameWriter writer(path, 2);
    for (int i = 0; i < 50; ++i) {
      frame.time = i / 30.0;
      writer.write(frame);
    }
    writer.commit();
    const std::vector<Frame> back = read_all(path);
    REQUIRE(back.size() == 50);
    for (std::size_t i = 0; i < back.size(); ++i) {
      frame.time = static_cast<double>(i) / 30.0;
      CHECK(frame_text(back[i], 2) == frame_text(frame, 2));
      CHECK(back[i].where == path + ":" + std::to_string(i + 2));
    }
  }
  CHECK(folder.entries() == 2);
}

TEST_CASE("3D moves keep their quaternion") {
  const std::string line = R"({"time": 1, "set": [{"id": 9, "orientation": [0.5, 0.5, -0.5, 0.5]}]})";
  const Frame frame = parse_frame(line, 3, "");
  CHECK(frame.set[0].orientation->y == -0.5);
  CHECK(frame_text(frame, 3) == line);
}

TEST_CASE("blank lines and Windows line ends are passed over; only a format line is no frame at all") {
  const TemporaryFolder folder;
  const std::string path =
      folder.with("f", "{\"format\": \"gridcull.frames/1\"}\r\n\r\n{\"time\": 0}\r\n\n{\"time\": 1}");
  CHECK(read_all(path).size() == 2);
  CHECK(read_all(folder.with("g", first)).empty());
}

TEST_CASE("bad frames are refused by line and pointer") {
  struct Bad {
    const char* from;
    const char* to;
    const char* said;
    ErrorCode code = ErrorCode::bad_frame;
  };
  const TemporaryFolder folder;
  for (const Bad& bad : {
           Bad{"600.1", "600.1x", "expected JSON: ", ErrorCode::bad_message},
           Bad{"600.1", "NaN", "expected JSON: ", ErrorCode::bad_message},
           Bad{"\"time\": 600.1, ", "", "missing key \"time\""},
           Bad{"600.1", "1e999", "/time: expected a finite number"},
           Bad{"600.1", "1e300", "/time: expected seconds of magnitude at most 1e12, found 1e+300"},
           Bad{"600.1", "null", "/time: expected seconds"},
           Bad{"\"set\"", "\"sets\"", "/sets: unknown key"},
           Bad{"\"time\": 600.1", "\"time\": 600.1, \"time\": 601", "/time: expected each key once"},
           Bad{"\"id\": 3", "\"id\": 9", "/set/1: expected each id once, found 9 twice"},
           Bad{"[5, 6]", "[5, 5]", "/remove/1: expected each id once, found 5 twice"},
           Bad{"[5, 6]", "[5, -6]", "/remove/1: expected an id"},
           Bad{"[7]", "[7, 8, 7]", "/drop_viewers/2: expected each id once"},
           Bad{"\"id\": 2,", "\"id\": 1,", "/viewers/1: expected each id once"},
           Bad{"[13.0, 7.0]", "[13.0, 7.0, 0]", "/set/0/position: expected 2 coordinates"},
           Bad{"\"heading\": 1.57", "\"velocity\": 1.57", "/set/0/velocity: unknown key"},
           Bad{"\"radius\": 1", "\"radius\": -1", "/add/0/shape/radius: expected a number above 0"},
           Bad{"\"range\": 20", "\"range\": -20", "/viewers/0/range: expected a number above 0"},
       }) {
    const std::string path = folder.with("f", first + "{\"time\": 0}\n" + with(full, bad.from, bad.to) + "\n");
    const std::string line = refusal(bad.code, [&] { read_all(path); });
    CAPTURE(std::string(bad.to));
    CAPTURE(line);
    CHECK(line.starts_with(path + ":3: " + bad.said));
    CHECK_FALSE(holds(line, "\n"));
  }
}

TEST_CASE("time that stands still or goes back is refused") {
  const TemporaryFolder folder;
  for (const char* time : {"5", "4.5"}) {
    const std::string path = folder.with("f", first + "{\"time\": 5}\n{\"time\": " + time + "}\n");
    const std::string line = refusal(ErrorCode::bad_frame, [&] { read_all(path); });
    CHECK(line == path + ":3: /time: expected a time after 5, found " + time);
  }
}

TEST_CASE("a frames file must begin with its format") {
  const TemporaryFolder folder;
  const auto said = [&](const std::string& text) {
    const std::string path = folder.with("f", text);
    return refusal(ErrorCode::bad_message, [&] { read_all(path); }).substr(path.size());
  };
  CHECK(said("").starts_with(": expected the first line {\"format\": \"gridcull.frames/1\"}, found nothing"));
  CHECK(said("{\"time\": 0}\n").starts_with(":1: missing key \"format\""));
  CHECK(said("{\"format\": \"gridcull.frames/2\"}\n").starts_with(":1: /format: expected \"gridcull.frames/1\""));
  CHECK(said("{\"format\": \"gridcull.frames/1\", \"x\": 1}\n").starts_with(":1: /x: unknown key"));
  CHECK(said("time,x,y\n").starts_with(":1: expected JSON: parse error at column "));
}

TEST_CASE("a writer without commit leaves nothing, and refuses numbers that are not finite") {
  const TemporaryFolder folder;
  const std::string path = folder.with("f", "precious");
  {
    FrameWriter writer(path, 2);
    Frame frame;
    writer.write(frame);
    frame.set.push_back({1, Vec3(std::numeric_limits<double>::quiet_NaN()), {}, {}});
    CHECK_THROWS_AS(writer.write(frame), Error);
  }
  CHECK(content_of(path) == "precious");
  CHECK(folder.entries() == 1);
}
