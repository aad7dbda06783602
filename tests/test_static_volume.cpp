// Volume files: what is written comes back, and what is no whole file of ours is refused in one line.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <unistd.h>

#include "gridcull/core/error.h"
#include "gridcull/grid/file_seal.h"
#include "gridcull/grid/openvdb_store.h"
#include "gridcull/grid/shared_cells.h"
#include "gridcull/grid/static_volume.h"
#include "random_world.h"
#include "same_cells.h"

namespace gridcull::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t plenty = std::uint64_t{1} << 30;

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("gridcull-volume-" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

StaticCells cells_of(int dimension, std::uint64_t seed) {
  const WorldScript script = random_world(dimension, seed);
  const Lattice lattice(script.dimension, script.bounds, script.cell, plenty);
  return *discretise_static(lattice, script.objects, plenty, [](double) { return true; });
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// The refusal, "" where there is none. One line that begins with the file.
std::string refusal(const std::string& path, bool head_only = false) {
  try {
    if (head_only) {
      (void)read_static_volume_head(path);
    } else {
      (void)read_static_volume(path, plenty);
    }
    return "";
  } catch (const Error& error) {
    const std::string line = error.what();
    CHECK(line.starts_with(path + ": "));
    CHECK(line.find('\n') == std::string::npos);
    return line;
  }
}

TEST_CASE("a volume file keeps everything") {
  if (!has_openvdb()) {
    MESSAGE("skipped: built without OpenVDB");
    return;
  }
  const Folder folder;
  for (const int dimension : {2, 3}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const StaticCells cells = cells_of(dimension, 4'400 + seed);
      const std::string path = folder / "world.vdb";
      write_static_volume(path, cells, plenty);
      const StaticCells back = read_static_volume(path, plenty), head = read_static_volume_head(path);
      CAPTURE(dimension);
      CAPTURE(seed);
      CHECK(same(back, cells));
      CHECK(back.fit(lattice_of(cells, plenty, Room::whole)));
      CHECK(head.fit(lattice_of(cells, plenty, Room::whole)));
      CHECK(head.world == cells.world);
    }
  }
}

TEST_CASE("a volume file's tiles are those of its cells") {
  if (!has_openvdb()) return;
  const Folder folder;
  const std::string path = folder / "world.vdb";
  for (const int dimension : {2, 3}) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      const StaticCells cells = cells_of(dimension, 4'400 + seed);
      write_static_volume(path, cells, plenty, 3);
      const auto from_file = open_static_volume_tiles(path), from_memory = tiled(cells, 3);
      REQUIRE(from_file->tiles().size() == from_memory->tiles().size());
      CHECK(from_file->head().world == cells.world);
      std::vector<MemberBrick> a, b;
      // Backwards, and twice: what was read once is still there.
      for (std::size_t i = 2 * from_file->tiles().size(); i-- > 0;) {
        const std::size_t tile = i % from_file->tiles().size();
        from_file->read(tile, a);
        from_memory->read(tile, b);
        CHECK(a.size() == b.size());
        CHECK(tile_hash(a) == from_file->tiles()[tile].hash);
        CHECK(tile_hash(b) == from_file->tiles()[tile].hash);
      }
    }
  }
}

TEST_CASE("files that are none, or not whole, are refused") {
  if (!has_openvdb()) return;
  const Folder folder;
  const std::string path = folder / "world.vdb", bad = folder / "bad.vdb";
  write_static_volume(path, cells_of(3, 4'401), plenty);
  const std::string whole = bytes_of(path);
  CHECK(refusal(folder / "none.vdb").find("no such file") != std::string::npos);
  CHECK(refusal(folder / "").find("expected a file") != std::string::npos);
  write_bytes(bad, "");
  CHECK(!refusal(bad).empty());
  write_bytes(bad, "{\"format\": \"gridcull.scene/1\"}");
  CHECK(!refusal(bad).empty());
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    text.replace(at, from.size(), to);
    write_bytes(bad, text);
    CHECK(refusal(bad).find("altered since it was written") != std::string::npos);
    write_bytes(bad, text.substr(0, text.size() - 16));
    CHECK(refusal(bad).find("expected a whole file that gridcull wrote") != std::string::npos);
    seal_file(bad);
  };
  replaced("gridcull.static/1", "gridcull.static/2");
  CHECK(refusal(bad, true).find("expected format gridcull.static/1, found gridcull.static/2") != std::string::npos);
  replaced("gridcull_format", "gridcull_farmat");
  CHECK(refusal(bad, true).find("found another .vdb") != std::string::npos);
  // Nothing is known behind a file's end: wherever it is cut, it is refused.
  std::size_t cuts = 0;
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 700, ++cuts) {
    write_bytes(bad, whole.substr(0, size));
    CAPTURE(size);
    CHECK(!refusal(bad).empty());
  }
  CHECK(cuts > 500);
  // And wherever it was altered: OpenVDB would crash on some of these.
  std::size_t altered = 0;
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 700, ++altered) {
    std::string text = whole;
    text[at] = static_cast<char>(text[at] ^ (1 + at % 255));
    write_bytes(bad, text);
    CAPTURE(at);
    CHECK(!refusal(bad, true).empty());
    CHECK_THROWS_AS((void)open_static_volume_tiles(bad), Error);
  }
  CHECK(altered > 500);
}

TEST_CASE("a file that cannot be written leaves the one that was there") {
  if (!has_openvdb()) return;
  const Folder folder;
  const std::string path = folder / "world.vdb";
  const StaticCells cells = cells_of(3, 4'401);
  write_static_volume(path, cells, plenty);
  const std::string whole = bytes_of(path);
  CHECK_THROWS_AS(write_static_volume(path, cells, 48), Error);
  CHECK(bytes_of(path) == whole);
  CHECK_THROWS_AS(write_static_volume(folder / "none/world.vdb", cells, plenty), Error);
  StaticCells wide = cells;
  wide.dimension = 2;
  wide.cells = {std::int64_t{1} << 31, 1, 1};
  wide.origin.z = 0;
  CHECK_THROWS_AS(write_static_volume(path, wide, plenty), Error);
  CHECK(bytes_of(path) == whole);
}

TEST_CASE("memory that is not allowed is not taken") {
  if (!has_openvdb()) return;
  const Folder folder;
  const std::string path = folder / "world.vdb";
  write_static_volume(path, cells_of(3, 4'401), plenty);
  CHECK_THROWS_AS((void)read_static_volume(path, 48), Error);
}

}  // namespace
}  // namespace gridcull::test
