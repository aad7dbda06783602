#include "gridcull/grid/vdb_layout.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "gridcull/core/error.h"

namespace gridcull {
namespace {

constexpr std::int64_t magic = 0x56444220;  // "VDB "
/// 222: node masks are compressed, grids say how; 224: the last that is known here.
constexpr std::uint32_t first_version = 222, last_version = 224;

class Reader {
 public:
  Reader(std::ifstream& in, const std::string& path, std::uint64_t size) : in_(in), path_(path), size_(size) {}

  template <class T>
  T number() {
    need(sizeof(T));
    T value{};
    in_.read(reinterpret_cast<char*>(&value), sizeof value);
    at_ += sizeof value;
    return value;
  }
  void skip(std::uint64_t bytes) {
    need(bytes);
    go_to(at_ + bytes);
  }
  /// A length and that many bytes; the length.
  std::uint32_t skip_text() {
    const auto length = number<std::uint32_t>();
    skip(length);
    return length;
  }
  void go_to(std::uint64_t place) {
    at_ = place;
    in_.seekg(static_cast<std::streamoff>(place));
  }
  std::uint64_t at() const { return at_; }
  std::uint64_t size() const { return size_; }

  void need(std::uint64_t bytes) const {
    if (bytes > size_ - at_)
      refuse("cut short: expected " + std::to_string(bytes) + " more bytes at " + std::to_string(at_) + ", found " +
             std::to_string(size_ - at_));
  }
  [[noreturn]] void refuse(const std::string& what) const { throw Error(ErrorCode::bad_scene, path_ + ": " + what); }

 private:
  std::ifstream& in_;
  const std::string& path_;
  std::uint64_t size_;
  std::uint64_t at_ = 0;
};

void check_head(Reader& reader) {
  if (reader.size() < sizeof magic || reader.number<std::int64_t>() != magic) {
    reader.refuse("cannot be read as a .vdb file: it does not begin as one");
  }
  const auto version = reader.number<std::uint32_t>();
  if (version < first_version || version > last_version) {
    reader.refuse("expected a .vdb file of version " + std::to_string(first_version) + " to " +
                  std::to_string(last_version) + ", found " + std::to_string(version));
  }
  reader.skip(2 * sizeof(std::uint32_t));  // of the library that wrote it
  if (reader.number<std::uint8_t>() == 0) {
    reader.refuse("expected a .vdb file that says where its grids end, found one written as a stream");
  }
  constexpr std::uint64_t uuid = 36;
  reader.skip(uuid);
}

void check_metadata(Reader& reader) {
  const auto count = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {
    reader.skip_text();  // name
    reader.skip_text();  // type
    reader.skip_text();  // value, its length first
  }
}

/// A grid from its descriptor to its end. Its own metadata are checked too: they are lengths that OpenVDB believes.
void check_grid(Reader& reader) {
  reader.skip_text();  // name
  reader.skip_text();  // type
  const bool shares_tree = reader.skip_text() > 0;
  const auto begin = reader.number<std::int64_t>(), blocks = reader.number<std::int64_t>(),
             end = reader.number<std::int64_t>();
  const auto here = static_cast<std::int64_t>(reader.at()), size = static_cast<std::int64_t>(reader.size());
  const bool in_order = shares_tree ? begin <= end : begin <= blocks && blocks <= end;
  if (begin < here || !in_order || end > size) {
    reader.refuse("cut short: expected a grid up to byte " + std::to_string(end) + ", found " + std::to_string(size));
  }
  reader.go_to(static_cast<std::uint64_t>(begin));
  (void)reader.number<std::uint32_t>();  // compression
  check_metadata(reader);
  reader.go_to(static_cast<std::uint64_t>(end));
}

}  // namespace

void check_vdb_layout(const std::string& path) {
  std::error_code fault;
  const auto status = std::filesystem::status(path, fault);
  if (!std::filesystem::exists(status)) throw Error(ErrorCode::io, path + ": there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw Error(ErrorCode::io, path + ": expected a file");
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(path, fault);
  if (!in || fault) throw Error(ErrorCode::io, path + ": cannot be read");
  Reader reader(in, path, size);
  check_head(reader);
  check_metadata(reader);
  const auto grids = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < grids; ++i) check_grid(reader);
}

}  // namespace gridcull
