// The file, all numbers little-endian:
//   magic (8 bytes) | container version u32 | method: length u32, characters | payload version u32 | world u64 |
//   payload: length u64, bytes | CRC-32 of everything before it u32
// A CRC-32 finds every burst of up to 32 altered bits, so every altered byte; lengths are held against the file's size
// before anything is believed.
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include "gridcull/core/error.h"
#include "gridcull/core/memory_limit.h"
#include "gridcull/methods/baking.h"
#include "gridcull/methods/bytes.h"

namespace gridcull {
namespace {

namespace fs = std::filesystem;

constexpr std::array<unsigned char, 8> magic{'g', 'r', 'i', 'd', 'B', 'A', 'K', 0x1A};
constexpr std::uint32_t container_version = 1;
constexpr std::size_t checksum_size = 4;

[[noreturn]] void refuse_io(const std::string& path, const char* what) {
  throw Error(ErrorCode::io, path + ": " + what + ": " + (errno != 0 ? std::strerror(errno) : "it failed"));
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Error(ErrorCode::bad_scene, path + ": " + why);
}

std::uint32_t checksum(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// An open file that closes itself.
struct File {
  std::FILE* stream;
  explicit File(std::FILE* f) : stream(f) {}
  ~File() {
    if (stream != nullptr) std::fclose(stream);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  bool close() { return std::fclose(std::exchange(stream, nullptr)) == 0; }
};

std::vector<std::byte> read_all(const std::string& path) {
  errno = 0;
  if (fs::is_directory(path)) refuse(path, "is a folder, not a baked file");
  File file(std::fopen(path.c_str(), "rbe"));
  if (file.stream == nullptr) refuse_io(path, "cannot be opened");
  std::vector<std::byte> bytes;
  std::array<std::byte, 1u << 16> piece;
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), file.stream)) {
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(n));
  }
  if (std::ferror(file.stream) != 0) refuse_io(path, "cannot be read");
  return bytes;
}

void write_all(const std::string& path, int descriptor, std::span<const std::byte> bytes) {
  errno = 0;
  File file(descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb"));
  if (file.stream == nullptr) refuse_io(path, "cannot be written");
  const bool good = std::fwrite(bytes.data(), 1, bytes.size(), file.stream) == bytes.size();
  if (!file.close() || !good) refuse_io(path, "cannot be written");
}

/// Beside, then renamed; what is no plain file is written directly.
void replace_file(const std::string& path, std::span<const std::byte> bytes) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::is_directory(status)) throw Error(ErrorCode::io, path + ": cannot be written: it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    return write_all(path, ::open(path.c_str(), O_WRONLY | O_CLOEXEC), bytes);
  }
  const std::string beside = path + ".new" + std::to_string(::getpid());
  try {
    write_all(path, ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), bytes);
    if (std::rename(beside.c_str(), path.c_str()) != 0) refuse_io(path, "cannot be written");
  } catch (...) {
    ::unlink(beside.c_str());
    throw;
  }
}

struct Container {
  BakedHead head;
  std::span<const std::byte> payload;
};

/// Where the file begins as a baked file does and ends too early, that is what is said.
void check_magic(const std::string& path, std::span<const std::byte> bytes) {
  const std::size_t length = std::min(bytes.size(), magic.size());
  if (length == 0 || std::memcmp(bytes.data(), magic.data(), length) != 0) {
    refuse(path, "is no baked file of gridcull");
  }
  if (bytes.size() < magic.size() + 4) refuse(path, "cut short: " + std::to_string(bytes.size()) + " bytes");
}

Container parse(const std::string& path, std::span<const std::byte> bytes) {
  check_magic(path, bytes);
  ByteReader reader(bytes.subspan(magic.size()), path);
  const std::uint32_t version = reader.u32();
  if (version != container_version) {
    refuse(path, "version " + std::to_string(version) + " of baked files; this program reads version " +
                     std::to_string(container_version));
  }
  Container out;
  out.head.method = reader.text();
  out.head.version = reader.u32();
  out.head.world = reader.u64();
  out.payload = reader.block();
  const std::uint32_t stored = reader.u32();
  reader.finish();
  if (stored != checksum(bytes.first(bytes.size() - checksum_size))) {
    refuse(path, "altered: its checksum does not match");
  }
  return out;
}

}  // namespace

void write_baked(const std::string& path, const BakedHead& head, std::span<const std::byte> payload) {
  ByteWriter out;
  out.bytes(std::as_bytes(std::span(magic)));
  out.u32(container_version);
  out.text(head.method);
  out.u32(head.version);
  out.u64(head.world);
  out.block(payload);
  out.u32(checksum(out.span()));
  replace_file(path, out.span());
}

BakedHead read_baked_head(const std::string& path) { return parse(path, read_all(path)).head; }

std::vector<std::byte> read_baked(const std::string& path, const BakedHead& expected, std::uint64_t max_bytes) {
  std::error_code none;
  const std::uint64_t size = fs::is_regular_file(path, none) ? fs::file_size(path, none) : 0;
  if (!none) refuse_above(max_bytes, size, path + ":");
  const std::vector<std::byte> bytes = read_all(path);
  const Container file = parse(path, bytes);
  const BakedHead& head = file.head;
  if (head.method != expected.method) {
    refuse(path, "baked for the method " + head.method + ", expected " + expected.method);
  }
  if (head.version != expected.version) {
    refuse(path, "version " + std::to_string(head.version) + " of what " + head.method +
                     " bakes; this program reads version " + std::to_string(expected.version));
  }
  if (head.world != expected.world) {
    refuse(path, "baked from another world: its static objects are others; bake this one");
  }
  return {file.payload.begin(), file.payload.end()};
}

}  // namespace gridcull
