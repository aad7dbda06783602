#include "gridcull/grid/file_seal.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <vector>

#include <zlib.h>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr std::string_view seal_name = "gc-seal1";
constexpr std::size_t seal_size = seal_name.size() + 8;  // and the sum's hexadecimal digits

/// The seal of the file's first `size` bytes.
std::string seal_of(std::ifstream& in, std::uint64_t size) {
  uLong sum = crc32(0, nullptr, 0);
  std::vector<char> buffer(std::size_t{1} << 20);
  for (std::uint64_t left = size; left > 0 && in;) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, buffer.size()));
    in.read(buffer.data(), static_cast<std::streamsize>(count));
    sum = crc32(sum, reinterpret_cast<const Bytef*>(buffer.data()), static_cast<uInt>(count));
    left -= count;
  }
  char text[seal_size + 1];
  std::snprintf(text, sizeof text, "%s%08lx", seal_name.data(), sum & 0xFFFF'FFFFul);
  return text;
}

}  // namespace

void seal_file(const std::string& path) {
  std::error_code fault;
  const std::uint64_t size = std::filesystem::file_size(path, fault);
  std::ifstream in(path, std::ios::binary);
  const std::string seal = fault ? "" : seal_of(in, size);
  std::ofstream out(path, std::ios::binary | std::ios::app);
  out << seal;
  out.close();
  if (!in || !out || fault) throw Error(ErrorCode::io, path + ": cannot be written");
}

void check_seal(const std::string& path) {
  std::error_code fault;
  const std::uint64_t size = std::filesystem::file_size(path, fault);
  std::ifstream in(path, std::ios::binary);
  if (!in || fault) throw Error(ErrorCode::io, path + ": cannot be read");
  std::string seal(seal_size, '\0');
  if (size >= seal_size) {
    in.seekg(static_cast<std::streamoff>(size - seal_size));
    in.read(seal.data(), static_cast<std::streamsize>(seal_size));
    in.seekg(0);
  }
  if (!seal.starts_with(seal_name)) {
    throw Error(ErrorCode::bad_scene, path + ": expected a whole file that gridcull wrote, found another");
  }
  if (seal_of(in, size - seal_size) != seal) {
    throw Error(ErrorCode::bad_scene, path + ": was altered since it was written");
  }
}

}  // namespace gridcull
