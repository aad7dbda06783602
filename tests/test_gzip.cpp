// Text files, packed and plain.
#include <filesystem>

#include <doctest/doctest.h>

#include "gridcull/sim/frames.h"
#include "gridcull/sim/pvs.h"
#include "gridcull/sim/random.h"
#include "gridcull/sim/text_file.h"
#include "gridcull/sim/world_files.h"
#include "sim_helpers.h"

using namespace gridcull;
using namespace gridcull::test;

namespace {

/// Lines of many lengths, some longer than any buffer, hard to pack.
std::string long_text() {
  Random random(3);
  std::string out;
  for (const std::size_t length : {0, 1, 80, 300'000, 5, 262'143, 262'144, 262'145, 0, 70'000}) {
    for (std::size_t i = 0; i < length; ++i) out += static_cast<char>('!' + random.below(90));
    out += '\n';
  }
  return out + "last line without an end";
}

std::vector<std::string> lines_of(const std::string& path) {
  TextReader reader(path);
  std::vector<std::string> out;
  std::string line;
  while (reader.line(line)) {
    out.push_back(line);
    CHECK(reader.line_number() == out.size());
  }
  return out;
}

}  // namespace

TEST_CASE("text written is text read, packed or not") {
  const TemporaryFolder folder;
  const std::string text = long_text();
  const std::string plain = folder.file("a.txt"), packed = folder.file("a.txt.gz");
  write_text(plain, text);
  write_text(packed, text);
  CHECK(content_of(plain) == text);
  CHECK(content_of(packed).substr(0, 2) == "\x1f\x8b");
  CHECK(content_of(packed).size() < text.size());
  CHECK(read_text(plain) == text);
  CHECK(read_text(packed) == text);
  const std::vector<std::string> lines = lines_of(packed);
  CHECK(lines == lines_of(plain));
  CHECK(lines.size() == 11);
  CHECK(lines[3].size() == 300'000);
  CHECK(lines[10] == "last line without an end");
  CHECK(folder.entries() == 2);
}

TEST_CASE("a .gz cut anywhere is refused") {
  const TemporaryFolder folder;
  write_text(folder.file("whole.gz"), long_text());
  const std::string whole = content_of(folder.file("whole.gz"));
  const std::string too_early = "the gzip data end too early";
  const std::string no_gzip = "expected a gzip file";
  for (const std::size_t size :
       {0ul, 1ul, 2ul, 9ul, 10ul, 11ul, 100ul, whole.size() / 2, whole.size() - 8, whole.size() - 1}) {
    const std::string path = folder.with("cut.gz", whole.substr(0, size));
    const std::string line = refusal(ErrorCode::io, [&] { read_text(path); });
    CAPTURE(size);
    CAPTURE(line);
    CHECK(line.starts_with(path + ": " + (size < 2 ? no_gzip : too_early)));
  }
}

TEST_CASE("a damaged .gz and a file that is none are refused") {
  const TemporaryFolder folder;
  write_text(folder.file("whole.gz"), long_text());
  std::string bytes = content_of(folder.file("whole.gz"));
  bytes[bytes.size() - 6] = static_cast<char>(bytes[bytes.size() - 6] ^ 1);  // in the checksum
  const std::string damaged = folder.with("damaged.gz", bytes);
  CHECK(refusal(ErrorCode::io, [&] { read_text(damaged); }) ==
        damaged + ": the gzip data are damaged: incorrect data check");
  const std::string plain = folder.with("plain.gz", "{\"format\": \"gridcull.frames/1\"}\n");
  CHECK(holds(refusal(ErrorCode::io, [&] { FrameReader r(plain, 2); }), "expected a gzip file, as its name says"));
  CHECK(holds(refusal(ErrorCode::io, [&] { read_text(folder.file("none.gz")); }), "cannot be opened"));
}

TEST_CASE("a truncated .gz of frames gives its whole frames, then the refusal") {
  const TemporaryFolder folder;
  FrameWriter writer(folder.file("f.jsonl.gz"), 2);
  Random random(9);
  for (int i = 0; i < 20'000; ++i) {
    Frame frame;
    frame.time = i + random.unit() * 0.5;
    writer.write(frame);
  }
  writer.commit();
  const std::string whole = content_of(folder.file("f.jsonl.gz"));
  const std::string cut = folder.with("cut.jsonl.gz", whole.substr(0, whole.size() - 20));
  FrameReader reader(cut, 2);
  Frame frame;
  const std::string line = refusal(ErrorCode::io, [&] {
    while (reader.next(frame)) {
    }
  });
  CHECK(holds(line, "the gzip data end too early"));
}

TEST_CASE("a writer replaces a file on commit only") {
  const TemporaryFolder folder;
  for (const char* name : {"a", "a.gz"}) {
    const std::string path = folder.with(name, "before");
    {
      TextWriter writer(path);
      writer.write("after");
      CHECK(content_of(path) == "before");
    }
    CHECK(content_of(path) == "before");
    TextWriter writer(path);
    writer.write("after");
    writer.commit();
    CHECK(read_text(path) == "after");
    CHECK(holds(refusal(ErrorCode::sequence, [&] { writer.write("more"); }), "written to after its end"));
    CHECK(holds(refusal(ErrorCode::sequence, [&] { writer.commit(); }), "finished twice"));
  }
  CHECK(folder.entries() == 2);
}

TEST_CASE("links are followed and devices written to, not replaced") {
  const TemporaryFolder folder;
  folder.with("real", "before");
  std::filesystem::create_symlink("real", folder.file("link"));
  write_text(folder.file("link"), "after");
  CHECK(std::filesystem::is_symlink(folder.file("link")));
  CHECK(content_of(folder.file("real")) == "after");
  write_text("/dev/null", "nothing");
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("a link to what is not there yet is followed") {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("second", folder.file("first"));
  std::filesystem::create_symlink(folder.file("target.txt"), folder.file("second"));
  write_text(folder.file("first"), "new");
  CHECK(std::filesystem::is_symlink(folder.file("first")));
  CHECK(std::filesystem::is_symlink(folder.file("second")));
  CHECK(content_of(folder.file("target.txt")) == "new");
  CHECK(folder.entries() == 3);
  std::filesystem::create_symlink("no/such", folder.file("astray"));
  CHECK(holds(refusal(ErrorCode::io, [&] { write_text(folder.file("astray"), "new"); }), "astray: cannot be written"));
  std::filesystem::create_symlink("loop", folder.file("loop"));
  CHECK(holds(refusal(ErrorCode::io, [&] { write_text(folder.file("loop"), "new"); }), "loop: cannot be written"));
  CHECK(folder.entries() == 5);
}

TEST_CASE("a full disk is refused") {
  const auto fill = [](const std::string& path) {
    return refusal(ErrorCode::io, [&] { write_text(path, std::string(1 << 20, 'x')); });
  };
  CHECK(holds(fill("/dev/full"), "/dev/full: cannot be written: No space left on device"));
}

TEST_CASE("a folder of scene and frames appears whole or not at all") {
  const TemporaryFolder folder;
  const std::string name = folder.file("world");
  { WorldFiles files(name, 2); }
  CHECK(folder.entries() == 0);
  {
    WorldFiles files(name, 2);
    files.write(Frame{});
    files.commit(Scene{});
    CHECK(read_scene(files.scene_path()).objects.empty());
    FrameReader reader(files.frames_path(), 2);
    Frame frame;
    CHECK(reader.next(frame));
    CHECK_FALSE(reader.next(frame));
  }
  const std::string before = content_of(name + "/scene.json");
  { WorldFiles files(name, 2); }
  CHECK(content_of(name + "/scene.json") == before);
  const std::string blocked = folder.with("file", "");
  CHECK(holds(refusal(ErrorCode::io, [&] { WorldFiles files(blocked, 2); }), "cannot be made a folder"));
  CHECK(holds(refusal(ErrorCode::io, [&] { WorldFiles files(blocked + "/deeper", 2); }), "cannot be made a folder"));
}

TEST_CASE("answers written are answers read") {
  const TemporaryFolder folder;
  const std::string path = folder.file("pvs.jsonl.gz");
  Answers answers;
  answers.views = {{1, {3, 9, 4294967294u}, 0, {}}, {4, {}, 0, {}}};
  PvsWriter writer(path, "voxel", "my \"town\".json");
  writer.write(0, 600.1, answers);
  writer.write(1, 600.2, answers);
  CHECK(folder.entries() == 1);
  writer.commit();
  PvsReader reader(path);
  CHECK(reader.method() == "voxel");
  CHECK(reader.scene() == "my \"town\".json");
  PvsLine line;
  for (std::uint64_t i = 0; i < 4; ++i) {
    REQUIRE(reader.next(line));
    CHECK(line.frame == i / 2);
    CHECK(line.time == (i < 2 ? 600.1 : 600.2));
    CHECK(line.viewer == answers.views[i % 2].viewer);
    CHECK(line.visible == answers.views[i % 2].visible);
  }
  CHECK_FALSE(reader.next(line));
}

TEST_CASE("bad answers are refused by line") {
  const TemporaryFolder folder;
  const std::string first = R"({"format": "gridcull.pvs/1", "method": "voxel", "scene": "s"})"
                            "\n";
  const auto said = [&](const std::string& lines) {
    const std::string path = folder.with("p", lines);
    return refusal(ErrorCode::bad_message,
                   [&] {
                     PvsReader reader(path);
                     PvsLine line;
                     while (reader.next(line)) {
                     }
                   })
        .substr(path.size());
  };
  const std::string good = R"({"frame": 0, "time": 1, "viewer": 1, "visible": [3, 9]})"
                           "\n";
  CHECK(said("").starts_with(": expected a first line"));
  CHECK(said(with(first, "pvs/1", "pvs/9")).starts_with(":1: /format: expected \"gridcull.pvs/1\""));
  CHECK(said(first + with(good, "3, 9", "9, 3")).starts_with(":2: /visible/1: expected ids that ascend"));
  CHECK(said(first + with(good, "\"viewer\": 1", "\"viewer\": -1")).starts_with(":2: /viewer: expected an id"));
  CHECK(said(first + with(good, "\"frame\": 0", "\"frame\": 0.5")).starts_with(":2: /frame: expected an integer"));
  CHECK(said(first + good + good).starts_with(":3: expected lines in the order of frame, then viewer"));
}
